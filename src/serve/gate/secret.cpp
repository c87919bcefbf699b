// SPDX-License-Identifier: Apache-2.0
#include "serve/gate/secret.hpp"

#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <span>

namespace strake::serve {

Result<std::string> make_secret() {
  std::array<unsigned char, 20> bytes{};
  for (std::span<unsigned char> rest(bytes); !rest.empty();) {
    const ssize_t got = ::getrandom(rest.data(), rest.size(), 0);
    if (got > 0)
      rest = rest.subspan(static_cast<std::size_t>(got));
    else if (errno != EINTR)
      return Error{ErrorCode::internal, "the system gives no random numbers", {}, {}};
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

bool is_secret(std::string_view given, std::string_view secret) {
  if (given.size() != secret.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < given.size(); ++i)
    difference |= static_cast<unsigned>(static_cast<unsigned char>(given[i])) ^
                  static_cast<unsigned>(static_cast<unsigned char>(secret[i]));
  return difference == 0;
}

}  // namespace strake::serve
