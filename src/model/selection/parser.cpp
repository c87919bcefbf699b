// SPDX-License-Identifier: Apache-2.0
#include "model/selection/parser.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/selection/token.hpp"
#include "strake/core/number.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::model::selection {
namespace {

/// Deeper nesting than any person writes; a hostile text must not exhaust the stack.
constexpr int kDeepest = 200;
/// Sets that name each other twice over and over grow beyond any model.
constexpr std::uint64_t kHeaviest = 100'000;

constexpr std::array<std::pair<std::string_view, Field>, 7> kFields{{
    {"name", Field::name},
    {"id", Field::id},
    {"path", Field::path},
    {"file", Field::file},
    {"type", Field::type},
    {"category", Field::category},
    {"color", Field::color},
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

std::optional<Field> field_of(const Token& token) {
  if (token.kind == TokenKind::attribute) return Field::attribute;
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

class Parser {
 public:
  Parser(std::string_view text, std::vector<Token> tokens, SetLookup lookup)
      : tokens_(std::move(tokens)), lookup_(lookup) {
    query_.text = text;
  }

  Result<Query> run() {
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

  NodeResult either() { return chain("or", NodeKind::disjunction, &Parser::both); }
  NodeResult both() { return chain("and", NodeKind::conjunction, &Parser::one); }

  NodeResult chain(std::string_view keyword, NodeKind kind, NodeResult (Parser::*operand)()) {
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
    return add_inner(NodeKind::negation, std::array{*inner});
  }

  NodeResult plain() {
    const Token& token = now();
    const Token& next = tokens_[std::min(at_ + 1, tokens_.size() - 1)];
    if (token.is("(")) return bracketed();
    if ((token.is_keyword("inside") || token.is_keyword("touches")) && next.is("(")) return box();
    if (token.is_keyword("set") && next.is("(")) return named_set();
    if (token.kind == TokenKind::attribute) return comparison(Field::attribute);
    if (operator_of(next) != nullptr) {
      if (const auto field = field_of(token)) return comparison(*field);
      return fault("no property is called " + shown(token),
                   "properties are name, id, path, file, type, category, color and @ATTRIBUTE");
    }
    if (!token.is_value())
      return fault("a test or a pattern is missing before " + shown(token),
                   "write a pattern, as 'PIPE*', or a test, as type = box");
    ++at_;
    Test test;
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

  NodeResult comparison(Field field) {
    Test test;
    test.field = field;
    if (field == Field::attribute) test.attribute = now().text;
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
    return found->negated ? add_inner(NodeKind::negation, std::array{leaf}) : leaf;
  }

  Status read_value(Test& test) {
    const Token& value = now();
    if (!value.is_value())
      return fault("a value is missing before " + shown(value),
                   "quote a value that has signs in it");
    test.text = value.text;
    test.quantity = parse_quantity(value.text);
    if (orders(test.op) && test.field != Field::attribute)
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
    Result<std::shared_ptr<const Query>> found = lookup_(name.text);
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
    return add({NodeKind::set, static_cast<std::uint32_t>(query_.sets.size() - 1), 0});
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
    return add({NodeKind::box, static_cast<std::uint32_t>(query_.boxes.size() - 1), 0});
  }

  /// A length of a box, in grid units; without a unit it is in millimetres.
  Result<std::int64_t> length() {
    const Token& token = now();
    const auto quantity = token.is_value() ? parse_quantity(token.text) : std::nullopt;
    const auto unit = quantity && quantity->unit.empty() ? std::optional(1.0)
                      : quantity                         ? unit_mm(quantity->unit)
                                                         : std::nullopt;
    if (!unit) return fault("no length: " + shown(token), "write millimetres or a unit, as 9m");
    const double mm = quantity->number * *unit;
    ++at_;
    // Beyond the grid is an open side of the box.
    return *geometry::snap(std::clamp(mm, -geometry::kMaxGridMm, geometry::kMaxGridMm));
  }

  static const OperatorName* operator_of(const Token& token) {
    for (const OperatorName& name : kOperators)
      if (token.is(name.symbol)) return &name;
    return nullptr;
  }

  std::uint32_t add_test(Test test) {
    query_.tests.push_back(std::move(test));
    return add({NodeKind::test, static_cast<std::uint32_t>(query_.tests.size() - 1), 0});
  }

  std::uint32_t add_inner(NodeKind kind, std::span<const std::uint32_t> operands) {
    const auto first = static_cast<std::uint32_t>(query_.operands.size());
    query_.operands.insert(query_.operands.end(), operands.begin(), operands.end());
    return add({kind, first, static_cast<std::uint32_t>(operands.size())});
  }

  std::uint32_t add(Node node) {
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
  Query query_;
};

}  // namespace

Result<Query> parse_query(std::string_view text, SetLookup lookup) {
  Result<std::vector<Token>> tokens = tokens_of(text);
  if (!tokens) return tokens.error();
  return Parser(text, std::move(*tokens), lookup).run();
}

}  // namespace strake::model::selection
