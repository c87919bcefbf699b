// SPDX-License-Identifier: Apache-2.0
#include "sheets/placeholders.hpp"

namespace strake::sheets {

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

}  // namespace

Result<std::vector<Piece>> split_placeholders(std::string_view text) {
  std::vector<Piece> pieces;
  for (;;) {
    const std::size_t open = text.find("{{");
    if (open == std::string_view::npos) break;
    const std::size_t close = text.find("}}", open);
    if (close == std::string_view::npos)
      return Error{ErrorCode::usage, "a '{{' is not closed", {}, "write {{name}}"};
    const std::string_view name = trimmed(text.substr(open + 2, close - open - 2));
    if (name.empty() || name.find('{') != std::string_view::npos)
      return Error{ErrorCode::usage, "'{{ }}' names nothing", {}, "write {{name}}"};
    pieces.push_back({std::string(text.substr(0, open)), std::string(name)});
    text.remove_prefix(close + 2);
  }
  pieces.push_back({std::string(text), {}});
  return pieces;
}

std::string filled(const std::vector<Piece>& pieces, Lookup lookup) {
  std::string text;
  for (const Piece& piece : pieces) {
    text += piece.text;
    if (!piece.name.empty()) text += lookup(piece.name);
  }
  return text;
}

}  // namespace strake::sheets
