// SPDX-License-Identifier: Apache-2.0
#include "serve/site/site.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "serve/site/project_answer.hpp"
#include "support/clash_rows.hpp"
#include "unit/serve/http_client.hpp"

namespace strake::serve {
namespace {

using nlohmann::json;
using strake::test::add_run;
using strake::test::clash_key;
using strake::test::project_with_clashes;

constexpr std::uint16_t kSitePort = 8123;
const std::string kSiteToken(40, 'a'), kSiteCookie(40, 'b');

class SiteTest : public ::testing::Test {
 protected:
  Site site() {
    return {Gate(kSitePort, kSiteToken, kSiteCookie),
            {*database_,
             [this]() -> Result<ServedPage> {
               ++made_;
               if (fails_) return Error{ErrorCode::input, "is damaged", "ship.strake", "mend it"};
               return ServedPage{std::make_shared<const std::string>("<p>page"),
                                 "default-src 'none'", project::current_state(*database_).value()};
             },
             "ann", [] { return std::string("2026-01-02T03:04:05Z"); }}};
  }
  static Request request(const std::string& method, const std::string& path) {
    return {.method = method,
            .path = path,
            .arguments = {},
            .headers = {{"Host", "127.0.0.1:8123"},
                        {"Origin", "http://127.0.0.1:8123"},
                        {"Content-Type", "application/json"},
                        {"Strake-Token", kSiteToken}},
            .body = {}};
  }
  static unsigned refusal(Site& site, const Request& sent) {
    const auto refused = site.refuse(sent);
    return refused ? static_cast<unsigned>(refused->status) : 200U;
  }
  json decide(Site& site, const json& body, HttpStatus expected) {
    Request sent = request("POST", "/api/decide");
    sent.body = body.dump();
    EXPECT_EQ(refusal(site, sent), 200U);
    const Answer answer = site.answer(sent);
    EXPECT_EQ(answer.status, expected) << *answer.body;
    return json::parse(*answer.body);
  }
  json state(Site& site, std::int64_t event) {
    Request sent = request("GET", "/api/state");
    sent.arguments = {{"event", std::to_string(event)}};
    return json::parse(*site.answer(sent).body);
  }
  std::unique_ptr<project::Database> database_ = project_with_clashes(3);
  int made_ = 0;
  bool fails_ = false;
};

std::string header_of(const Answer& answer, const std::string& name) {
  for (const auto& [key, value] : answer.headers)
    if (key == name) return value;
  return {};
}

TEST_F(SiteTest, the_page_is_made_once_for_each_run) {
  Site here = site();
  const Request page = request("GET", "/");
  const Answer first = here.answer(page);
  EXPECT_EQ(*first.body, "<p>page");
  EXPECT_EQ(header_of(first, "Content-Security-Policy"), "default-src 'none'");
  EXPECT_NE(header_of(first, "Set-Cookie").find(kSiteCookie), std::string::npos);
  EXPECT_EQ(header_of(first, "Set-Cookie").find(kSiteToken), std::string::npos);
  (void)here.answer(page);
  EXPECT_EQ(made_, 1);
  decide(here, {{"run", 1}, {"event", 0}, {"keys", {clash_key(0)}}, {"status", "approved"}},
         HttpStatus::ok);
  (void)here.answer(page);
  EXPECT_EQ(made_, 1) << "decisions are asked for by the page";
  add_run(*database_, 2);
  (void)here.answer(page);
  EXPECT_EQ(made_, 2);
}

TEST_F(SiteTest, what_is_wrong_with_the_project_is_stated_in_words) {
  Site here = site();
  fails_ = true;
  const Answer answer = here.answer(request("GET", "/"));
  EXPECT_EQ(answer.status, HttpStatus::fault);
  EXPECT_EQ(*answer.body, "ship.strake: is damaged (mend it)\n");
  EXPECT_EQ(answer.type, "text/plain; charset=utf-8");
}

TEST_F(SiteTest, other_paths_methods_and_types_are_turned_away) {
  Site here = site();
  for (const char* const path :
       {"/index.html", "//", "/api/", "/api/state/", "/../", "/%2e", "/favicon.ico"})
    EXPECT_EQ(refusal(here, request("GET", path)), 404U) << path;
  EXPECT_EQ(refusal(here, request("POST", "/")), 405U);
  EXPECT_EQ(refusal(here, request("GET", "/api/decide")), 405U);
  for (const char* const method : {"PUT", "DELETE", "OPTIONS", "HEAD", "TRACE", "get"})
    EXPECT_EQ(refusal(here, request(method, "/api/state")), 405U) << method;
  Request typed = request("POST", "/api/decide");
  for (const char* const type : {"text/plain", "application/x-www-form-urlencoded", ""}) {
    typed.headers[2].second = type;
    EXPECT_EQ(refusal(here, typed), 415U) << type;
  }
  typed.headers[2].second = "Application/JSON; charset=utf-8";
  EXPECT_EQ(refusal(here, typed), 200U);
}

TEST_F(SiteTest, every_answer_states_that_it_is_not_to_be_kept_and_nobody_elses) {
  Site here = site();
  Request strange = request("GET", "/");
  strange.headers.clear();
  for (const Answer& answer :
       {here.answer(request("GET", "/")), here.answer(request("GET", "/api/state")),
        *here.refuse(strange), *here.refuse(request("GET", "/no")),
        *here.refuse(request("PUT", "/"))}) {
    EXPECT_EQ(header_of(answer, "Cache-Control"), "no-store");
    EXPECT_EQ(header_of(answer, "X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(header_of(answer, "Referrer-Policy"), "no-referrer");
    EXPECT_EQ(header_of(answer, "Access-Control-Allow-Origin"), "");
    EXPECT_NE(header_of(answer, "Content-Security-Policy").find("default-src 'none'"),
              std::string::npos);
  }
}

TEST_F(SiteTest, a_decision_is_taken_and_reported) {
  Site here = site();
  const json done = decide(here,
                           {{"run", 1},
                            {"event", 0},
                            {"keys", {clash_key(0), clash_key(1)}},
                            {"status", "approved"},
                            {"comment", "<b>\u202e\" " + std::string(10000, 'x')}},
                           HttpStatus::ok);
  EXPECT_EQ(done["changed"], 2);
  EXPECT_EQ(done["refused"], json::array());
  EXPECT_EQ(done["event"], 2);
  ASSERT_EQ(done["clashes"].size(), 2U);
  const json& clash = done["clashes"][0];
  EXPECT_EQ(clash["key"], clash_key(0));
  EXPECT_EQ(clash["status"], "approved");
  EXPECT_EQ(clash["by"], "ann");
  EXPECT_EQ(clash["on"], "2026-01-02");
  EXPECT_EQ(clash["comment"], "<b>\u202e\" " + std::string(10000, 'x'));
  EXPECT_EQ(state(here, 0)["clashes"], done["clashes"]);
  EXPECT_EQ(state(here, 2)["clashes"], json::array());
}

TEST_F(SiteTest, what_changed_meanwhile_is_a_conflict_and_the_rest_stands) {
  Site here = site();
  decide(here, {{"run", 1}, {"event", 0}, {"keys", {clash_key(0)}}, {"status", "reviewed"}},
         HttpStatus::ok);
  const json done = decide(here,
                           {{"run", 1},
                            {"event", 0},
                            {"keys", {clash_key(0), clash_key(1), "none"}},
                            {"status", "approved"}},
                           HttpStatus::conflict);
  EXPECT_EQ(done["changed"], 1);
  ASSERT_EQ(done["refused"].size(), 2U);
  EXPECT_EQ(done["refused"][0]["key"], clash_key(0));
  EXPECT_EQ(done["refused"][0]["why"], "ann made it reviewed meanwhile");
  EXPECT_EQ(done["refused"][1]["key"], "none");
  ASSERT_EQ(done["clashes"].size(), 2U);
  EXPECT_EQ(done["clashes"][0]["status"], "reviewed");
  EXPECT_EQ(done["clashes"][1]["status"], "approved");
}

TEST_F(SiteTest, a_run_that_came_in_between_is_reported) {
  Site here = site();
  add_run(*database_, 2);
  EXPECT_EQ(state(here, 0)["run"], 2);
  const json done =
      decide(here, {{"run", 1}, {"event", 0}, {"keys", {clash_key(1)}}, {"status", "approved"}},
             HttpStatus::ok);
  EXPECT_EQ(done["run"], 2) << "it still stands, and the page is told of the run";
}

TEST_F(SiteTest, what_the_page_decides_itself_is_never_too_much_to_be_reported) {
  const int most = static_cast<int>(kMaxChanges);
  database_ = project_with_clashes(most + 2);
  Site here = site();
  json keys = json::array();
  for (int i = 0; i <= most; ++i) keys.push_back(clash_key(i));
  const json own = decide(here, {{"run", 1}, {"event", 0}, {"keys", keys}, {"status", "reviewed"}},
                          HttpStatus::ok);
  EXPECT_EQ(own["too_many"], false);
  EXPECT_EQ(own["clashes"].size(), kMaxChanges + 1);
  // To whom it is not their own it is, whatever they decide besides.
  EXPECT_EQ(state(here, 0)["too_many"], true);
  const json other =
      decide(here, {{"run", 1}, {"event", 0}, {"keys", {clash_key(most + 1)}}, {"comment", "mine"}},
             HttpStatus::ok);
  EXPECT_EQ(other["too_many"], true);
  ASSERT_EQ(other["clashes"].size(), 1U);
  EXPECT_EQ(other["clashes"][0]["comment"], "mine");
}

TEST_F(SiteTest, what_makes_no_sense_changes_nothing) {
  Site here = site();
  Request sent = request("POST", "/api/decide");
  for (const char* const body : {"", "null", "[1]", "{\"run\":1}",
                                 "{\"run\":1,\"event\":0,\"keys\":[\"k\"],\"status\":\"?\"}"}) {
    sent.body = body;
    const Answer answer = here.answer(sent);
    EXPECT_EQ(answer.status, HttpStatus::bad_request) << body;
    EXPECT_FALSE(json::parse(*answer.body)["error"].get<std::string>().empty());
  }
  for (const char* const event : {"", "-1", "x", "1 ", "99999999999999999999"}) {
    Request state = request("GET", "/api/state");
    state.arguments = {{"event", event}};
    EXPECT_EQ(here.answer(state).status, HttpStatus::bad_request) << event;
  }
  EXPECT_EQ(project::current_state(*database_)->event, 0);
}

TEST_F(SiteTest, many_clients_of_a_server_see_what_one_of_them_decides) {
  Site here(Gate(kSitePort, kSiteToken, kSiteCookie),
            {*database_, {}, "ann", [] { return std::string("2026-01-02T03:04:05Z"); }});
  // The port of a test is chosen by the system; the gate knows the one that requests state.
  test::Served served(Server::listen(0).value(), here);
  const std::string head = "Host: 127.0.0.1:8123\r\nStrake-Token: " + kSiteToken + "\r\n";
  const std::string body =
      R"({"run":1,"event":0,"keys":[")" + clash_key(2) + R"("],"status":"approved"})";
  const std::string answer =
      test::Client(served.port())
          .exchange("POST /api/decide HTTP/1.1\r\n" + head +
                    "Origin: http://127.0.0.1:8123\r\nContent-Type: application/json\r\n" +
                    "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
  EXPECT_EQ(test::code_of(answer), 200) << answer;
  std::vector<std::string> found(8);
  std::vector<std::jthread> readers;
  for (std::string& state : found)
    readers.emplace_back([&] {
      for (int i = 0; i < 20; ++i)
        state = test::body_of(test::Client(served.port())
                                  .exchange("GET /api/state?event=0 HTTP/1.1\r\n" + head + "\r\n"));
    });
  readers.clear();
  for (const std::string& state : found) {
    const json parsed = json::parse(state);
    EXPECT_EQ(parsed["clashes"].size(), 1U);
    EXPECT_EQ(parsed["clashes"][0]["status"], "approved");
  }
  const std::string without =
      test::Client(served.port())
          .exchange("GET /api/state?event=0 HTTP/1.1\r\nHost: 127.0.0.1:8123\r\n\r\n");
  EXPECT_EQ(test::code_of(without), 403);
  EXPECT_NE(without.find("Cache-Control: no-store"), std::string::npos);
  EXPECT_TRUE(served.stop());
}

}  // namespace
}  // namespace strake::serve
