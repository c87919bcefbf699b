// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "serve/http/message.hpp"

namespace strake::serve {

/// The header that carries the token.
inline constexpr std::string_view kTokenHeader = "Strake-Token";
/// The path of the page. Its cookie opens nothing else.
inline constexpr std::string_view kPagePath = "/";

/// Decides whom the server answers.
///
/// The token, which stands in the address that is printed, opens everything. The page that this
/// address leads to sets a cookie, which opens the page again and nothing else: cookies go to
/// whatever listens on any port of the same machine, so that one is worth a look and no change
/// (decision 0101).
class Gate {
 public:
  /// Both secrets are of make_secret().
  Gate(std::uint16_t port, std::string token, std::string cookie);

  /// Returns the answer that turns a request away: of another host or origin, without the token,
  /// with headers twice that must be there once.
  [[nodiscard]] std::optional<Answer> refuse(const Request& request) const;
  /// Returns the address that opens the page, with the token in it.
  [[nodiscard]] std::string address() const;
  /// Returns the value of Set-Cookie that the page comes with.
  [[nodiscard]] std::string set_cookie() const;

 private:
  [[nodiscard]] bool is_host(std::string_view host) const;
  [[nodiscard]] bool has_token(const Request& request) const;
  [[nodiscard]] bool has_cookie(const Request& request) const;

  std::uint16_t port_;
  std::string token_, cookie_, cookie_name_;
};

}  // namespace strake::serve
