// SPDX-License-Identifier: Apache-2.0
#include "serve/gate/gate.hpp"

#include <array>
#include <utility>

#include "core/text_encoding.hpp"
#include "serve/gate/secret.hpp"

namespace strake::serve {
namespace {

constexpr std::string_view kScheme = "http://";
constexpr std::uint16_t kPlainPort = 80;
/// Names of this machine that no name server decides about.
constexpr std::array<std::string_view, 2> kLoopbackNames{"127.0.0.1", "localhost"};

Answer forbidden(std::string why) { return text_answer(HttpStatus::forbidden, std::move(why)); }

/// Whether a browser says that its own page asks, or a person ("none"). Older ones say nothing.
bool is_of_this_page(const Request& request) {
  const auto site = request.header("Sec-Fetch-Site");
  return !site || *site == "same-origin" || *site == "none";
}

}  // namespace

Gate::Gate(std::uint16_t port, std::string token, std::string cookie)
    : port_(port),
      token_(std::move(token)),
      cookie_(std::move(cookie)),
      cookie_name_("strake-" + std::to_string(port)) {}

std::optional<Answer> Gate::refuse(const Request& request) const {
  for (const std::string_view once :
       {std::string_view("Host"), std::string_view("Origin"), std::string_view("Cookie"),
        std::string_view("Content-Length"), std::string_view("Content-Type"),
        std::string_view("Sec-Fetch-Site"), kTokenHeader})
    if (request.count(once) > 1)
      return text_answer(HttpStatus::bad_request, std::string(once) + " is there twice");
  const auto host = request.header("Host");
  if (!host || !is_host(*host)) return forbidden("this is no name of this server");
  const auto origin = request.header("Origin");
  if (origin && *origin != std::string(kScheme) + std::string(*host))
    return forbidden("pages of others may ask nothing here");
  if (request.method != "GET" && !origin) return forbidden("it is not said which page asks");
  const bool is_page = request.path == kPagePath;
  if (!is_page && !is_of_this_page(request))
    return forbidden("pages of others may ask nothing here");
  if (has_token(request) || (is_page && request.method == "GET" && has_cookie(request))) return {};
  return forbidden(
      "open the address that 'strake view' printed: it has a token, without which nothing is "
      "answered");
}

bool Gate::is_host(std::string_view host) const {
  for (const std::string_view name : kLoopbackNames)
    if (host == std::string(name) + ":" + std::to_string(port_) ||
        (port_ == kPlainPort && host == name))
      return true;
  return false;
}

bool Gate::has_token(const Request& request) const {
  if (const auto given = request.header(kTokenHeader)) return is_secret(*given, token_);
  const auto given = request.argument("token");
  return request.path == kPagePath && request.method == "GET" && given && is_secret(*given, token_);
}

bool Gate::has_cookie(const Request& request) const {
  const auto header = request.header("Cookie");
  std::string_view rest = header.value_or(std::string_view());
  while (!rest.empty()) {
    const std::size_t end = rest.find(';');
    const std::string_view pair = trimmed(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (const std::size_t sign = pair.find('='); sign != std::string_view::npos &&
                                                 pair.substr(0, sign) == cookie_name_ &&
                                                 is_secret(pair.substr(sign + 1), cookie_))
      return true;
  }
  return false;
}

std::string Gate::address() const {
  return std::string(kScheme) + std::string(kLoopbackNames[0]) + ":" + std::to_string(port_) +
         std::string(kPagePath) + "?token=" + token_;
}

std::string Gate::set_cookie() const {
  return cookie_name_ + "=" + cookie_ + "; Path=/; HttpOnly; SameSite=Strict";
}

}  // namespace strake::serve
