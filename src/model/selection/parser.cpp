// SPDX-License-Identifier: Apache-2.0
#include "model/selection/parser.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/number.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::model::selection {
namespace {

constexpr std::string_view kTokenBlanks = " \t\r\n";
/// The symbols, longer ones first, so that "<=" is not read as "<" and "=".
constexpr std::array<std::string_view, 11> kSymbols{"!=", "!~", "<=", ">=", "=", "~",
                                                    "<",  ">",  "(",  ")",  ","};

class SelectionTokenizer {
 public:
  explicit SelectionTokenizer(std::string_view text) : text_(text) {}

  Result<std::vector<Token>> run() {
    std::vector<Token> tokens;
    while (true) {
      const std::size_t next = text_.find_first_not_of(kTokenBlanks, at_);
      at_ = next == std::string_view::npos ? text_.size() : next;
      Result<Token> token = one();
      if (!token) return token.error();
      tokens.push_back(std::move(*token));
      if (tokens.back().kind == TokenKind::end) return tokens;
    }
  }

 private:
  Result<Token> one() {
    const std::size_t column = at_ + 1;
    if (at_ == text_.size()) return Token{TokenKind::end, {}, column};
    if (const auto symbol = symbol_at(at_)) {
      at_ += symbol->size();
      return Token{TokenKind::symbol, std::string(*symbol), column};
    }
    const bool attribute = text_[at_] == '@';
    if (attribute) ++at_;
    const bool quotes = at_ < text_.size() && (text_[at_] == '"' || text_[at_] == '\'');
    Result<std::string> text = quotes ? quoted() : word();
    if (!text) return text.error();
    if (attribute && text->empty())
      return fault_at(column, "'@' without the name of an attribute",
                      "write @NAME or @\"a name with blanks\"");
    const TokenKind plain = quotes ? TokenKind::quoted : TokenKind::word;
    return Token{attribute ? TokenKind::attribute : plain, std::move(*text), column};
  }

  /// Returns the symbol at a place. '!' alone is none: it belongs to patterns.
  [[nodiscard]] std::optional<std::string_view> symbol_at(std::size_t at) const {
    for (const std::string_view symbol : kSymbols)
      if (text_.substr(at).starts_with(symbol)) return symbol;
    return std::nullopt;
  }

  /// Reads up to the quote of the same kind; a doubled one stands for itself.
  Result<std::string> quoted() {
    const std::size_t column = at_ + 1;
    const char quote = text_[at_++];
    std::string out;
    while (at_ < text_.size()) {
      const char c = text_[at_++];
      if (c != quote) {
        out += c;
      } else if (at_ < text_.size() && text_[at_] == quote) {
        out += text_[at_++];
      } else {
        return out;
      }
    }
    return fault_at(column, "a quote that is never closed",
                    std::string("end the text with ") + quote);
  }

  Result<std::string> word() {
    const std::size_t first = at_;
    while (at_ < text_.size() && kTokenBlanks.find(text_[at_]) == std::string_view::npos &&
           text_[at_] != '"' && text_[at_] != '\'' && !symbol_at(at_))
      ++at_;
    return std::string(text_.substr(first, at_ - first));
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

Error fault_at(std::size_t column, std::string message, std::string mend) {
  return {ErrorCode::usage, std::move(message), "selection, column " + std::to_string(column),
          std::move(mend)};
}

Result<std::vector<Token>> tokens_of(std::string_view text) {
  return SelectionTokenizer(text).run();
}

namespace {

/// The deepest nesting, more than any person writes; a hostile text must not exhaust the stack.
constexpr int kDeepest = 200;
/// The largest weight: sets that name each other twice over and over grow beyond any model.
constexpr std::uint64_t kHeaviest = 100'000;

constexpr std::array<std::pair<std::string_view, PropertyField>, 7> kFields{{
    {"name", PropertyField::name},
    {"id", PropertyField::id},
    {"path", PropertyField::path},
    {"file", PropertyField::file},
    {"type", PropertyField::type},
    {"category", PropertyField::category},
    {"color", PropertyField::color},
}};

struct OperatorName {
  std::string_view symbol;
  Operator op;
  bool negated;
};
constexpr std::array<OperatorName, 8> kOperators{{
    {"=", Operator::equal, false},
    {"!=", Operator::equal, true},
    {"~", Operator::match, false},
    {"!~", Operator::match, true},
    {"<", Operator::less, false},
    {"<=", Operator::less_equal, false},
    {">", Operator::more, false},
    {">=", Operator::more_equal, false},
}};

std::optional<PropertyField> field_of(const Token& token) {
  if (token.kind == TokenKind::attribute) return PropertyField::attribute;
  if (token.kind != TokenKind::word) return std::nullopt;
  for (const auto& [name, field] : kFields)
    if (token.text == name) return field;
  return std::nullopt;
}

bool orders(Operator op) {
  return op == Operator::less || op == Operator::less_equal || op == Operator::more ||
         op == Operator::more_equal;
}

std::string shown(const Token& token) {
  return token.kind == TokenKind::end ? "the end" : "'" + token.text + "'";
}

class SelectionParser {
 public:
  SelectionParser(std::string_view text, std::vector<Token> tokens, SetLookup lookup)
      : tokens_(std::move(tokens)), lookup_(lookup) {
    query_.text = text;
  }

  Result<SelectionQuery> run() {
    if (now().kind == TokenKind::end)
      return fault("an empty selection", "write a pattern, as 'PIPE*', or a test, as type = box");
    const Result<std::uint32_t> root = either();
    if (!root) return root.error();
    if (now().kind != TokenKind::end)
      return fault(shown(now()) + " is one thing too many",
                   "join tests with and, or; quote a text that has blanks in it");
    query_.root = *root;
    query_.weight += query_.nodes.size();
    return std::move(query_);
  }

 private:
  using NodeResult = Result<std::uint32_t>;

  NodeResult either() { return chain("or", QueryNodeKind::disjunction, &SelectionParser::both); }
  NodeResult both() { return chain("and", QueryNodeKind::conjunction, &SelectionParser::one); }

  NodeResult chain(std::string_view keyword, QueryNodeKind kind,
                   NodeResult (SelectionParser::*operand)()) {
    std::vector<std::uint32_t> operands;
    while (true) {
      const NodeResult next = (this->*operand)();
      if (!next) return next;
      operands.push_back(*next);
      if (!now().is_keyword(keyword)) break;
      ++at_;
    }
    return operands.size() == 1 ? operands.front() : add_inner(kind, operands);
  }

  NodeResult one() {
    if (++depth_ > kDeepest)
      return fault("nested too deeply", "name part of it as a set of its own");
    NodeResult node = now().is_keyword("not") ? negation() : plain();
    --depth_;
    return node;
  }

  NodeResult negation() {
    ++at_;
    const NodeResult inner = one();
    if (!inner) return inner;
    return add_inner(QueryNodeKind::negation, std::array{*inner});
  }

  NodeResult plain() {
    const Token& token = now();
    const Token& next = tokens_[std::min(at_ + 1, tokens_.size() - 1)];
    if (token.is("(")) return bracketed();
    if ((token.is_keyword("inside") || token.is_keyword("touches")) && next.is("(")) return box();
    if (token.is_keyword("set") && next.is("(")) return named_set();
    if (token.kind == TokenKind::attribute) return comparison(PropertyField::attribute);
    if (operator_of(next) != nullptr) {
      if (const auto field = field_of(token)) return comparison(*field);
      return fault("no property is called " + shown(token),
                   "properties are name, id, path, file, type, category, color and @ATTRIBUTE");
    }
    if (!token.is_value())
      return fault("a test or a pattern is missing before " + shown(token),
                   "write a pattern, as 'PIPE*', or a test, as type = box");
    ++at_;
    PropertyTest test;
    test.text = token.text;
    return add_test(std::move(test));
  }

  NodeResult bracketed() {
    ++at_;
    NodeResult inner = either();
    if (!inner) return inner;
    if (!now().is(")"))
      return fault("a '(' that is never closed before " + shown(now()), "add a ')'");
    ++at_;
    return inner;
  }

  NodeResult comparison(PropertyField field) {
    PropertyTest test;
    test.field = field;
    if (field == PropertyField::attribute) test.attribute = now().text;
    ++at_;
    const OperatorName* const found = operator_of(now());
    if (found == nullptr) {
      test.op = Operator::exists;
      return add_test(std::move(test));
    }
    test.op = found->op;
    ++at_;
    const Status read = read_value(test);
    if (!read) return read.error();
    const std::uint32_t leaf = add_test(std::move(test));
    return found->negated ? add_inner(QueryNodeKind::negation, std::array{leaf}) : leaf;
  }

  Status read_value(PropertyTest& test) {
    const Token& value = now();
    if (!value.is_value())
      return fault("a value is missing before " + shown(value),
                   "quote a value that has signs in it");
    test.text = value.text;
    test.quantity = parse_quantity(value.text);
    if (orders(test.op) && test.field != PropertyField::attribute)
      return fault("only attributes can be more or less than a number", "write @NAME >= 150mm");
    if (orders(test.op) && !test.quantity)
      return fault("no number: " + shown(value),
                   "write a number, with a unit or without, as 150mm");
    if (test.op == Operator::match) {
      const RE2::Options options(RE2::Quiet);
      auto regex = std::make_shared<RE2>(value.text, options);
      if (!regex->ok())
        return fault("no regular expression: " + regex->error(),
                     "RE2 syntax; quote it, and write \\ before a sign that is meant as it is");
      test.regex = std::move(regex);
    }
    ++at_;
    return {};
  }

  NodeResult named_set() {
    at_ += 2;
    const Token name = now();
    if (!name.is_value())
      return fault("the name of a set is missing before " + shown(name), "write set(NAME)");
    ++at_;
    if (!now().is(")"))
      return fault("')' is missing before " + shown(now()), "write set(NAME), with one name");
    ++at_;
    Result<std::shared_ptr<const SelectionQuery>> found = lookup_(name.text);
    if (!found) {
      Error error = fault_at(name.column, found.error().message, found.error().mend);
      if (!found.error().where.empty()) error.where = found.error().where;
      return error;
    }
    query_.weight += (*found)->weight;
    if (query_.weight > kHeaviest)
      return fault_at(name.column, "the sets named here hold too many tests, one within another",
                      "name fewer of them");
    query_.sets.push_back(std::move(*found));
    return add({QueryNodeKind::set, static_cast<std::uint32_t>(query_.sets.size() - 1), 0});
  }

  NodeResult box() {
    BoxTest test;
    test.whole = now().is_keyword("inside");
    const std::size_t first = at_;
    at_ += 2;
    std::array<std::int64_t, 6> sides{};
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const Result<std::int64_t> side = length();
      if (!side) return side.error();
      sides[i] = *side;
      const std::string_view wanted = i + 1 < sides.size() ? "," : ")";
      if (!now().is(wanted))
        return fault("'" + std::string(wanted) + "' is missing before " + shown(now()),
                     "a box is (xmin, ymin, zmin, xmax, ymax, zmax)");
      ++at_;
    }
    test.box = {{sides[0], sides[1], sides[2]}, {sides[3], sides[4], sides[5]}};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (sides[axis] > sides[axis + 3])
        return fault_at(tokens_[first].column, "the box ends before it begins",
                        "a box is (xmin, ymin, zmin, xmax, ymax, zmax)");
    query_.boxes.push_back(test);
    return add({QueryNodeKind::box, static_cast<std::uint32_t>(query_.boxes.size() - 1), 0});
  }

  /// Reads a length of a box, in grid units; without a unit it is in millimetres.
  Result<std::int64_t> length() {
    const Token& token = now();
    if (!token.is_value())
      return fault(shown(token) + " is not a coordinate", "write millimetres or a unit, as 9m");
    const Result<double> mm = parse_coordinate_mm(token.text);
    if (!mm) return fault(mm.error().message, mm.error().mend);
    ++at_;
    // A length beyond the grid leaves that side of the box open.
    return *geometry::snap(std::clamp(*mm, -geometry::kMaxGridMm, geometry::kMaxGridMm));
  }

  static const OperatorName* operator_of(const Token& token) {
    for (const OperatorName& name : kOperators)
      if (token.is(name.symbol)) return &name;
    return nullptr;
  }

  std::uint32_t add_test(PropertyTest test) {
    query_.tests.push_back(std::move(test));
    return add({QueryNodeKind::test, static_cast<std::uint32_t>(query_.tests.size() - 1), 0});
  }

  std::uint32_t add_inner(QueryNodeKind kind, std::span<const std::uint32_t> operands) {
    const auto first = static_cast<std::uint32_t>(query_.operands.size());
    query_.operands.insert(query_.operands.end(), operands.begin(), operands.end());
    return add({kind, first, static_cast<std::uint32_t>(operands.size())});
  }

  std::uint32_t add(QueryNode node) {
    query_.nodes.push_back(node);
    return static_cast<std::uint32_t>(query_.nodes.size() - 1);
  }

  [[nodiscard]] const Token& now() const { return tokens_[at_]; }
  [[nodiscard]] Error fault(std::string message, std::string mend) const {
    return fault_at(now().column, std::move(message), std::move(mend));
  }

  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  SetLookup lookup_;
  int depth_ = 0;
  SelectionQuery query_;
};

}  // namespace

Result<SelectionQuery> parse_query(std::string_view text, SetLookup lookup) {
  Result<std::vector<Token>> tokens = tokens_of(text);
  if (!tokens) return tokens.error();
  return SelectionParser(text, std::move(*tokens), lookup).run();
}

}  // namespace strake::model::selection
