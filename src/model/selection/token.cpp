// SPDX-License-Identifier: Apache-2.0
#include "model/selection/token.hpp"

#include <array>
#include <optional>
#include <utility>

namespace strake::model::selection {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
/// Longer ones first, so that "<=" is not read as "<" and "=".
constexpr std::array<std::string_view, 11> kSymbols{"!=", "!~", "<=", ">=", "=", "~",
                                                    "<",  ">",  "(",  ")",  ","};

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  Result<std::vector<Token>> run() {
    std::vector<Token> tokens;
    while (true) {
      const std::size_t next = text_.find_first_not_of(kBlanks, at_);
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

  /// The symbol that stands at a place. '!' alone is none: it belongs to patterns.
  [[nodiscard]] std::optional<std::string_view> symbol_at(std::size_t at) const {
    for (const std::string_view symbol : kSymbols)
      if (text_.substr(at).starts_with(symbol)) return symbol;
    return std::nullopt;
  }

  /// Up to the quote of the same kind; a doubled one stands for itself.
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
    while (at_ < text_.size() && kBlanks.find(text_[at_]) == std::string_view::npos &&
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

Result<std::vector<Token>> tokens_of(std::string_view text) { return Scanner(text).run(); }

}  // namespace strake::model::selection
