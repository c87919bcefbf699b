// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "strake/report/clash_diff.hpp"
#include "strake/report/clash_document.hpp"
#include "support/clash_model.hpp"
#include "support/io_seeds.hpp"

namespace strake::test {

/// Documents of a small run, before and after something moved.
[[nodiscard]] inline std::vector<Seed> clash_document_seeds() {
  const auto written = [](double from) {
    ClashModel m;
    m.box("a", {0, 0, 0}, {100, 100, 100}).box("b", {90, 0, 0}, {200, 100, 100});
    m.box("c", {from, 10, 10}, {300, 90, 90});
    std::string text;
    const clash::Findings findings{{m.detect({.tolerances = {.clearance_mm = 25}})}, {}};
    const Status status = report::write_clash_json({findings, m.model},
                                                   [&](std::string_view piece) { text += piece; });
    if (!status) std::abort();
    return text;
  };
  return {{"before.json", written(180)}, {"after.json", written(210)}};
}

/// Any bytes as a result: an error that names the file, or a document that compares with any other
/// and is no different from itself.
inline void feed_clash_document(const std::string& bytes) {
  static const report::ClashDocument other = [] {
    std::istringstream in(clash_document_seeds()[0].bytes);
    return report::parse_clash_document(in, "before.json").value();
  }();
  const auto stop = [](const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
  };
  std::istringstream in(bytes);
  const auto document = report::parse_clash_document(in, "fuzz.json");
  if (!document) {
    if (document.error().where.find("fuzz.json") == std::string::npos)
      stop("an error without a file");
    return;
  }
  const report::ClashDiff self = report::compare(*document, *document);
  if (self.has_new(false) || self.has_worse()) stop("a document is worse than itself");
  const auto matched = [](const report::ClashDocument& before, const report::ClashDocument& after) {
    return report::compare(before, after, report::match_files(before, after).value());
  };
  for (const report::ClashDiff& diff :
       {self, report::compare(*document, other), report::compare(other, *document),
        matched(*document, other), matched(other, *document)}) {
    std::size_t size = 0;
    report::write_clash_diff_json(diff, [&](std::string_view piece) { size += piece.size(); });
    if (size == 0) stop("a comparison without a document");
    (void)report::clash_diff_table(diff, {});
  }
}

}  // namespace strake::test
