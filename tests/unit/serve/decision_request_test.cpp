// SPDX-License-Identifier: Apache-2.0
#include "serve/site/decision_request.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace strake::serve {
namespace {

constexpr const char* kWhole =
    R"({"run": 3, "event": 12, "keys": ["k1", "k2"], "status": "approved", "assignee": "", "comment": "as \"agreed\""})";

std::string fault_of(const std::string& text) {
  const Result<DecisionRequest> read = read_decision_request(text);
  return read ? std::string() : read.error().message;
}

TEST(DecisionRequest, states_what_is_decided_about_what) {
  const Result<DecisionRequest> read = read_decision_request(kWhole);
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->keys, (std::vector<std::string>{"k1", "k2"}));
  EXPECT_EQ(read->known, (project::KnownState{3, 12}));
  EXPECT_EQ(read->decision.status, report::DecisionStatus::approved);
  EXPECT_EQ(read->decision.assignee, "");
  EXPECT_EQ(read->decision.comment, "as \"agreed\"");
}

TEST(DecisionRequest, what_is_left_out_stays_as_it_is) {
  const auto read = read_decision_request(R"({"run":0,"event":0,"keys":["k"],"comment":"x"})");
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_FALSE(read->decision.status);
  EXPECT_FALSE(read->decision.assignee);
}

TEST(DecisionRequest, whatever_makes_no_sense_is_reported) {
  EXPECT_EQ(fault_of(""), "the request is no JSON");
  EXPECT_EQ(fault_of("[]"), "the request is no object");
  EXPECT_EQ(fault_of("{} x"), "the request is no JSON");
  EXPECT_EQ(fault_of(R"({"event":0,"keys":["k"],"status":"new"})"), "the request has no run");
  EXPECT_EQ(fault_of(R"({"run":0,"event":0,"keys":[],"status":"new"})"), "no clash is named");
  EXPECT_EQ(fault_of(R"({"run":0,"event":0,"keys":["k"]})"), "there is nothing to set");
  EXPECT_EQ(fault_of(R"({"run":0,"event":0,"keys":["k"],"status":"settled"})"),
            "no status is called 'settled'");
  EXPECT_EQ(fault_of(R"({"run":0,"event":0,"keys":["k"],"status":7})"), "status is no text");
  EXPECT_EQ(fault_of(R"({"run":-1,"event":0,"keys":["k"],"status":"new"})"),
            "run is no number of a row");
  EXPECT_EQ(fault_of(R"({"run":1e300,"event":0,"keys":["k"],"status":"new"})"),
            "run is no number of a row");
  EXPECT_EQ(fault_of(R"({"run":0,"event":0.5,"keys":["k"],"status":"new"})"),
            "event is no number of a row");
  EXPECT_EQ(fault_of(R"({"run":0,"event":0,"keys":"k","status":"new"})"), "keys is no list");
  EXPECT_EQ(fault_of(R"({"run":0,"event":0,"keys":[{}],"status":"new"})"), "a key is no text");
  EXPECT_EQ(fault_of(R"({"run":0,"event":0,"keys":["k"],"status":"new","by":"eve"})"),
            "the request has a member that has no meaning");
  EXPECT_EQ(fault_of(R"({"run":0,"event":0,"keys":["k"],"keys":["l"],"status":"new"})"),
            "the request has a member twice");
  EXPECT_EQ(fault_of("{\"run\":0,\"event\":0,\"keys\":[\"k\"],\"comment\":\"\xff\"}"),
            "the request is no JSON");
}

TEST(DecisionRequest, a_text_that_each_clash_would_have_is_not_endless) {
  const auto request = [](const char* name, std::size_t bytes) {
    return std::string(R"({"run":0,"event":0,"keys":["k"],")") + name + "\":\"" +
           std::string(bytes, 'x') + "\"}";
  };
  constexpr std::size_t kMax = 65536;
  EXPECT_EQ(fault_of(request("comment", kMax)), "");
  EXPECT_EQ(fault_of(request("comment", kMax + 1)), "the comment is longer than 64 KiB");
  EXPECT_EQ(fault_of(request("assignee", kMax + 1)), "the assignee is longer than 64 KiB");
}

TEST(DecisionRequest, deep_nesting_is_no_way_in) {
  EXPECT_EQ(fault_of(std::string(1000000, '[')), "the request is no object");
  EXPECT_EQ(fault_of("{\"x\":" + std::string(1000000, '[')), "the request is no JSON");
}

TEST(DecisionRequest, damaged_ones_are_refused_or_read_and_nothing_else) {
  const std::string whole = kWhole;
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_NE(fault_of(whole.substr(0, length)), "") << length;
  constexpr unsigned kSeed = 7;
  std::mt19937 random(kSeed);
  for (int round = 0; round < 3000; ++round) {
    std::string damaged = whole;
    for (int change = 0; change < 3; ++change)
      damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    const Result<DecisionRequest> read = read_decision_request(damaged);
    if (read) {
      EXPECT_FALSE(read->keys.empty());
    }
  }
}

}  // namespace
}  // namespace strake::serve
