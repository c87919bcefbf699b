// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "model/selection/query.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/detail/function_ref.hpp"

/// The tokens and the parser of the selection language.
namespace strake::model::selection {

enum class TokenKind : std::uint8_t { word, quoted, attribute, symbol, end };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;        ///< a symbol, or the text without its quotes or '@'
  std::size_t column = 1;  ///< in bytes, counted from 1

  [[nodiscard]] bool is(std::string_view symbol) const {
    return kind == TokenKind::symbol && text == symbol;
  }
  [[nodiscard]] bool is_keyword(std::string_view word) const {
    return kind == TokenKind::word && text == word;
  }
  /// Whether the token can be a value.
  [[nodiscard]] bool is_value() const {
    return kind == TokenKind::word || kind == TokenKind::quoted;
  }
};

/// Returns an error at a column of a selection.
[[nodiscard]] Error fault_at(std::size_t column, std::string message, std::string mend);

/// Splits a selection into tokens, the last one `end`.
[[nodiscard]] Result<std::vector<Token>> tokens_of(std::string_view text);

/// A function that returns what set(NAME) stands for; the caller adds the place to an error.
using SetLookup =
    parallel::FunctionRef<Result<std::shared_ptr<const SelectionQuery>>(std::string_view name)>;

/// Parses a selection by recursive descent over the grammar
///
///     either := both ("or" both)*
///     both   := one ("and" one)*
///     one    := "not" one | "(" either ")" | "inside" box | "touches" box
///             | "set" "(" name ")" | property [operator value] | pattern
///     box    := "(" xmin "," ymin "," zmin "," xmax "," ymax "," zmax ")"
[[nodiscard]] Result<SelectionQuery> parse_query(std::string_view text, SetLookup lookup);

}  // namespace strake::model::selection
