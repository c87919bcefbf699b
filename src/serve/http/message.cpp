// SPDX-License-Identifier: Apache-2.0
#include "serve/http/message.hpp"

#include "core/text_encoding.hpp"

namespace strake::serve {

std::optional<std::string_view> Request::header(std::string_view name) const {
  std::optional<std::string_view> found;
  for (const auto& [key, value] : headers) {
    if (lowered(key) != lowered(name)) continue;
    if (found) return std::nullopt;
    found = value;
  }
  return found;
}

std::size_t Request::count(std::string_view name) const {
  std::size_t count = 0;
  for (const auto& [key, value] : headers) count += lowered(key) == lowered(name) ? 1U : 0U;
  return count;
}

std::optional<std::string_view> Request::argument(std::string_view name) const {
  std::optional<std::string_view> found;
  for (const auto& [key, value] : arguments) {
    if (key != name) continue;
    if (found) return std::nullopt;
    found = value;
  }
  return found;
}

Answer text_answer(HttpStatus status, std::string text) {
  return {status, "text/plain; charset=utf-8",
          std::make_shared<const std::string>(std::move(text) + "\n")};
}

}  // namespace strake::serve
