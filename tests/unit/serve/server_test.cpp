// SPDX-License-Identifier: Apache-2.0
// The server over real sockets: what it takes, what it turns away, and that nobody keeps others
// waiting.
#include "serve/http/server.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "unit/serve/http_client.hpp"

namespace strake::serve {
namespace {

using namespace std::chrono_literals;
using test::body_of;
using test::Client;
using test::code_of;
using test::Served;

/// Says what it was asked; the path /no is refused before its body comes, /large is 8 MB.
class Echo final : public RequestHandler {
 public:
  std::optional<Answer> refuse(const Request& request) override {
    if (request.path == "/no") return text_answer(HttpStatus::forbidden, "no");
    return std::nullopt;
  }
  Answer answer(const Request& request) override {
    if (request.path == "/large")
      return text_answer(HttpStatus::ok, std::string(std::size_t{8} << 20U, 'x'));
    std::string shown = request.method + " " + request.path;
    for (const auto& [name, value] : request.arguments) shown += " " + name + "=" + value;
    return text_answer(HttpStatus::ok, shown + " " + request.body);
  }
};

/// Lets /wait wait for as long as it is told to; all else it answers at once.
class Patient final : public RequestHandler {
 public:
  std::optional<Answer> refuse(const Request& /*request*/) override { return std::nullopt; }
  Answer answer(const Request& request) override {
    return text_answer(HttpStatus::ok, request.path);
  }
  std::optional<Answer> answer_or_wait(const Request& request,
                                       std::chrono::milliseconds waited) override {
    longest_ = std::max(longest_.load(), waited.count());
    if (request.path == "/wait" && !done_) return std::nullopt;
    return answer(request);
  }
  void end_waiting() { done_ = true; }
  [[nodiscard]] std::chrono::milliseconds longest() const {
    return std::chrono::milliseconds(longest_);
  }

 private:
  std::atomic<bool> done_{false};
  std::atomic<std::chrono::milliseconds::rep> longest_{0};
};

ServerLimits small_limits() {
  ServerLimits limits;
  limits.body_bytes = 1000;
  limits.silence = 2s;
  limits.sending = 2s;
  return limits;
}

class ServerTest : public ::testing::Test {
 protected:
  void SetUp() override { start({}); }
  void start(const ServerLimits& limits) {
    served_.reset();
    served_ = std::make_unique<Served>(Server::listen(0, limits).value(), echo_);
  }
  std::string exchange(const std::string& text) { return Client(served_->port()).exchange(text); }
  static std::string get(const std::string& target) {
    return "GET " + target + " HTTP/1.1\r\nHost: x\r\n\r\n";
  }
  Echo echo_;
  std::unique_ptr<Served> served_;
};

TEST_F(ServerTest, answers_what_is_requested_and_decodes_nothing) {
  const std::string answer = exchange(get("/a%2fb%00?event=%31&x"));
  EXPECT_EQ(code_of(answer), 200);
  EXPECT_EQ(body_of(answer), "GET /a%2fb%00 event=%31 x= \n");
  EXPECT_EQ(body_of(exchange("POST /p HTTP/1.1\r\nHost: x\r\nContent-Length: 5\r\n\r\nhello")),
            "POST /p hello\n");
  EXPECT_EQ(body_of(exchange(get("/../../etc/passwd"))), "GET /../../etc/passwd \n");
}

TEST_F(ServerTest, one_connection_takes_several_requests) {
  Client client(served_->port());
  for (int i = 0; i < 3; ++i) EXPECT_EQ(code_of(client.exchange(get("/a"))), 200);
}

TEST_F(ServerTest, a_port_is_had_once) {
  const Result<Server> second = Server::listen(served_->port());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::output);
  EXPECT_NE(second.error().text().find("in use"), std::string::npos) << second.error().text();
  const std::uint16_t port = served_->port();
  EXPECT_TRUE(served_->stop());
  served_.reset();
  EXPECT_TRUE(Server::listen(port)) << "it is free again at once";
}

TEST_F(ServerTest, bodies_are_limited_before_they_come) {
  start(small_limits());
  EXPECT_EQ(code_of(exchange("POST /p HTTP/1.1\r\nHost: x\r\nContent-Length: 1001\r\n\r\n")), 413);
  EXPECT_EQ(code_of(exchange("POST /p HTTP/1.1\r\nHost: x\r\nContent-Length: "
                             "99999999999999999999999999\r\n\r\n")) /
                100,
            4);
  EXPECT_EQ(code_of(exchange("POST /p HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n")),
            411);
  EXPECT_EQ(code_of(exchange("POST /p HTTP/1.1\r\nHost: x\r\n\r\n")), 411);
  EXPECT_EQ(code_of(exchange("POST /no HTTP/1.1\r\nHost: x\r\nContent-Length: 900\r\n\r\n")), 403);
  const std::string whole = exchange("POST /p HTTP/1.1\r\nHost: x\r\nContent-Length: 1000\r\n\r\n" +
                                     std::string(1000, 'b'));
  EXPECT_EQ(code_of(whole), 200);
}

TEST_F(ServerTest, huge_heads_are_turned_away) {
  for (const std::string& head :
       {"GET /" + std::string(200000, 'a') + " HTTP/1.1\r\nHost: x\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: x\r\nX: " + std::string(200000, 'a') + "\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: x\r\n" +
            [] {
              std::string many;
              for (int i = 0; i < 20000; ++i) many += "X-" + std::to_string(i) + ": y\r\n";
              return many;
            }() +
            "\r\n"}) {
    const int code = code_of(exchange(head));
    EXPECT_TRUE(code == 0 || code / 100 == 4) << code;
  }
  EXPECT_EQ(code_of(exchange(get("/a"))), 200) << "it goes on";
}

TEST_F(ServerTest, what_is_no_request_does_no_harm) {
  constexpr unsigned kSeed = 11;
  std::mt19937 random(kSeed);
  const std::string whole = "POST /p?a=b HTTP/1.1\r\nHost: x\r\nContent-Length: 5\r\n\r\nhello";
  start(small_limits());
  for (int round = 0; round < 300; ++round) {
    std::string damaged = whole.substr(0, 1 + random() % whole.size());
    for (int change = 0; change < 4; ++change)
      damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    const Client client(served_->port());
    client.send(damaged);
  }
  for (const std::string& strange :
       {std::string("\0\0\0\0", 4), std::string(100000, '\n'), std::string("GET\r\n\r\n"),
        std::string("GET / HTTP/9.9\r\nHost: x\r\n\r\n"),
        std::string("\x16\x03\x01\x02\x00\x01", 6),
        std::string("GET / HTTP/1.1\r\nHost: x\r\nContent-Length: -1\r\n\r\n"),
        std::string("GET / HTTP/1.1\r\n: x\r\n\r\n")})
    EXPECT_NE(code_of(Client(served_->port(), 5).exchange(strange)), 500);
  EXPECT_EQ(code_of(exchange(get("/a"))), 200);
}

TEST_F(ServerTest, slow_clients_keep_nobody_waiting_and_are_ended) {
  start(small_limits());
  std::vector<std::unique_ptr<Client>> slow;
  for (int i = 0; i < 40; ++i) {
    slow.push_back(std::make_unique<Client>(served_->port()));
    slow.back()->send("GET / HTTP/1.1\r\nHost: x\r\nX-Slow: ");
  }
  EXPECT_EQ(code_of(exchange(get("/a"))), 200);
  // A byte now and then is no silence, and no request either.
  bool ended = false;
  for (int i = 0; i < 40 && !ended; ++i) {
    std::this_thread::sleep_for(250ms);
    ended = !slow.front()->send("y");
  }
  EXPECT_TRUE(ended);
  EXPECT_EQ(code_of(exchange(get("/a"))), 200);
}

TEST_F(ServerTest, many_read_at_once_and_one_that_stops_reading_stops_none) {
  const Client stuck(served_->port());
  stuck.send(get("/large"));
  std::vector<std::jthread> readers;
  std::vector<std::size_t> sizes(8, 0);
  for (std::size_t i = 0; i < sizes.size(); ++i)
    readers.emplace_back(
        [&, i] { sizes[i] = body_of(Client(served_->port()).exchange(get("/large"))).size(); });
  readers.clear();
  for (const std::size_t size : sizes) EXPECT_EQ(size, (std::size_t{8} << 20U) + 1);
}

TEST_F(ServerTest, who_waits_keeps_nobody_waiting) {
  Patient patient;
  // It waits longer than a client may take to send a request.
  ServerLimits limits = small_limits();
  limits.sending = limits.silence = 1s;
  const Served served(Server::listen(0, limits).value(), patient);
  Client waiting(served.port()), also(served.port());
  waiting.send("POST /wait HTTP/1.1\r\nHost: x\r\nContent-Length: 2\r\n\r\nhi");
  also.send(get("/wait"));
  for (int i = 0; i < 3; ++i) {
    std::this_thread::sleep_for(500ms);
    EXPECT_EQ(body_of(Client(served.port()).exchange(get("/a"))), "/a\n");
  }
  EXPECT_GE(patient.longest(), 1s);
  patient.end_waiting();
  EXPECT_EQ(body_of(waiting.receive()), "/wait\n");
  EXPECT_EQ(body_of(also.receive()), "/wait\n");
  EXPECT_EQ(body_of(waiting.exchange(get("/b"))), "/b\n") << "the connection goes on";
}

TEST_F(ServerTest, a_stop_ends_it_while_some_wait_and_some_of_them_went_away) {
  Patient patient;
  Served served(Server::listen(0).value(), patient);
  const Client waiting(served.port());
  waiting.send(get("/wait"));
  for (int i = 0; i < 5; ++i) Client(served.port()).send(get("/wait"));
  EXPECT_EQ(code_of(Client(served.port()).exchange(get("/a"))), 200);
  std::this_thread::sleep_for(200ms);
  EXPECT_TRUE(served.stop());
}

TEST_F(ServerTest, clients_that_go_away_end_nothing) {
  for (int i = 0; i < 20; ++i) Client(served_->port()).send(get("/large"));
  EXPECT_EQ(code_of(exchange(get("/a"))), 200);
}

TEST_F(ServerTest, a_stop_ends_it_at_once_with_clients_on_it) {
  const Client silent(served_->port());
  silent.send("GET /");
  Client idle(served_->port());
  idle.exchange(get("/a"));
  const auto before = std::chrono::steady_clock::now();
  EXPECT_TRUE(served_->stop());
  EXPECT_LT(std::chrono::steady_clock::now() - before, 900ms) << "it waits for a second at most";
}

}  // namespace
}  // namespace strake::serve
