// SPDX-License-Identifier: Apache-2.0
// Boxes in a row, and what a decision file says of their clashes.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"
#include "support/clash_model.hpp"

namespace strake::test {

/// Three boxes in a row, each 20 mm in the next.
inline ClashModel three_boxes(double depth_mm = 20) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100});
  m.box("b", {100 - depth_mm, 0, 0}, {200, 100, 100});
  m.box("c", {180, 0, 0}, {300, 100, 100});
  return m;
}

inline clash::Findings findings_of(const ClashModel& m) { return {{m.detect()}, {}}; }

inline std::string key_of(const ClashModel& m, std::uint32_t a, std::uint32_t b) {
  return clash::pair_key("", m.model, model::ObjectId{a}, model::ObjectId{b});
}

inline report::DecisionFile parsed(const std::string& text) {
  Result<report::DecisionFile> file = report::parse_decisions(text, "d.csv");
  EXPECT_TRUE(file) << file.error().text();
  return std::move(file).value();
}

inline std::string error_of(const std::string& text) {
  const Result<report::DecisionFile> file = report::parse_decisions(text, "d.csv");
  return file ? "no error" : file.error().text();
}

/// A model, what was found in it and what was decided about it.
struct Decided {
  ClashModel m;
  clash::Findings findings;
  report::DecisionFile file;
  report::DecidedResults results;

  Decided(ClashModel model, const std::string& csv, const report::DecisionRules& rules = {})
      : m(std::move(model)),
        findings(findings_of(m)),
        file(csv.empty() ? report::DecisionFile{"d.csv", {}, {}} : parsed(csv)),
        results(report::decide(findings, m.model, file, rules).value()) {}
  Decided(const Decided&) = delete;
  Decided& operator=(const Decided&) = delete;

  [[nodiscard]] report::ClashContents contents() const {
    report::ClashContents all{findings, m.model};
    all.decided = &results;
    return all;
  }
  [[nodiscard]] std::string updated() const { return report::update_decisions(contents()).text; }
  [[nodiscard]] std::string table() const { return report::clash_table(contents(), {}); }
  [[nodiscard]] report::Reopened reopened(std::size_t pair) const {
    const report::DecidedResult* const r = results.of(0, findings.tests[0].pairs[pair]);
    return r == nullptr ? report::Reopened::no : r->reopened;
  }
};

inline std::string row(const std::string& key, const std::string& rest) {
  return key + "," + rest + "\n";
}

}  // namespace strake::test
