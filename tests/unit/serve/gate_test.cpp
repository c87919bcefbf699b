// SPDX-License-Identifier: Apache-2.0
#include "serve/gate/gate.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "serve/gate/secret.hpp"

namespace strake::serve {
namespace {

const std::string kToken(40, 'a'), kCookie(40, 'b');
constexpr std::uint16_t kPort = 8123;

Gate gate_here() { return {kPort, kToken, kCookie}; }

Request request_of(const std::string& method, const std::string& path, Fields headers) {
  Request request{
      .method = method, .path = path, .arguments = {}, .headers = std::move(headers), .body = {}};
  return request;
}

/// The code of the refusal; 200 where there is none.
unsigned code_of(const Request& request) {
  const auto refusal = gate_here().refuse(request);
  return refusal ? static_cast<unsigned>(refusal->status) : 200U;
}

const std::pair<std::string, std::string> kHost{"Host", "127.0.0.1:8123"};
const std::pair<std::string, std::string> kOrigin{"Origin", "http://127.0.0.1:8123"};
const std::pair<std::string, std::string> kKey{"strake-token", kToken};

TEST(Gate, the_token_opens_everything_and_nothing_opens_without) {
  EXPECT_EQ(code_of(request_of("GET", "/", {kHost})), 403U);
  EXPECT_EQ(code_of(request_of("GET", "/", {kHost, kKey})), 200U);
  EXPECT_EQ(code_of(request_of("GET", "/api/state", {kHost, kKey})), 200U);
  EXPECT_EQ(code_of(request_of("POST", "/api/decide", {kHost, kOrigin, kKey})), 200U);
  for (const std::string& wrong : {std::string(), std::string(39, 'a'), std::string(41, 'a'),
                                   std::string(39, 'a') + "b", kCookie})
    EXPECT_EQ(code_of(request_of("GET", "/api/state", {kHost, {"Strake-Token", wrong}})), 403U)
        << wrong;
}

TEST(Gate, the_address_opens_the_page_and_nothing_else) {
  Request page = request_of("GET", "/", {kHost});
  page.arguments = {{"token", kToken}};
  EXPECT_EQ(code_of(page), 200U);
  page.arguments.emplace_back("token", kToken);
  EXPECT_EQ(code_of(page), 403U) << "twice";
  Request state = request_of("GET", "/api/state", {kHost});
  state.arguments = {{"token", kToken}};
  EXPECT_EQ(code_of(state), 403U);
  EXPECT_EQ(gate_here().address(), "http://127.0.0.1:8123/?token=" + kToken);
}

TEST(Gate, the_cookie_opens_the_page_and_nothing_else) {
  const std::pair<std::string, std::string> cookie{"Cookie",
                                                   "x=1; strake-8123=" + kCookie + ";y=2"};
  EXPECT_EQ(code_of(request_of("GET", "/", {kHost, cookie})), 200U);
  EXPECT_EQ(code_of(request_of("GET", "/api/state", {kHost, cookie})), 403U);
  EXPECT_EQ(code_of(request_of("POST", "/", {kHost, kOrigin, cookie})), 403U);
  EXPECT_EQ(code_of(request_of("GET", "/", {kHost, {"Cookie", "strake-8124=" + kCookie}})), 403U);
  EXPECT_EQ(code_of(request_of("GET", "/", {kHost, {"Cookie", "strake-8123=" + kToken}})), 403U);
  EXPECT_EQ(code_of(request_of("GET", "/", {kHost, {"Cookie", ";;=;" + std::string(10000, ';')}})),
            403U);
  EXPECT_EQ(gate_here().set_cookie(),
            "strake-8123=" + kCookie + "; Path=/; HttpOnly; SameSite=Strict");
}

TEST(Gate, other_names_of_the_host_are_turned_away) {
  EXPECT_EQ(code_of(request_of("GET", "/", {{"Host", "localhost:8123"}, kKey})), 200U);
  for (const char* const host :
       {"evil.example:8123", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:8123.",
        "localhost.evil.example:8123", "", "[::1]:8123", "127.1:8123"})
    EXPECT_EQ(code_of(request_of("GET", "/", {{"Host", host}, kKey})), 403U) << host;
  EXPECT_EQ(code_of(request_of("GET", "/", {kKey})), 403U) << "none";
}

TEST(Gate, pages_of_others_are_turned_away) {
  for (const char* const origin : {"http://evil.example", "null", "http://127.0.0.1:8124", "",
                                   "https://127.0.0.1:8123", "http://localhost:8123"})
    EXPECT_EQ(code_of(request_of("POST", "/api/decide", {kHost, kKey, {"Origin", origin}})), 403U)
        << origin;
  EXPECT_EQ(code_of(request_of("POST", "/api/decide", {kHost, kKey})), 403U)
      << "a write says who asks";
  EXPECT_EQ(
      code_of(request_of("GET", "/api/state", {kHost, kKey, {"Sec-Fetch-Site", "cross-site"}})),
      403U);
  EXPECT_EQ(
      code_of(request_of("GET", "/api/state", {kHost, kKey, {"Sec-Fetch-Site", "same-origin"}})),
      200U);
}

TEST(Gate, headers_that_stand_there_twice_are_refused) {
  for (const auto& twice : {kHost, kOrigin, kKey})
    EXPECT_EQ(code_of(request_of("POST", "/api/decide", {kHost, kOrigin, kKey, twice})), 400U)
        << twice.first;
}

TEST(Secret, is_another_one_each_time) {
  std::set<std::string> secrets;
  for (int i = 0; i < 100; ++i) {
    const std::string secret = make_secret().value();
    EXPECT_EQ(secret.size(), 40U);
    EXPECT_EQ(secret.find_first_not_of("0123456789abcdef"), std::string::npos);
    secrets.insert(secret);
  }
  EXPECT_EQ(secrets.size(), 100U);
}

}  // namespace
}  // namespace strake::serve
