// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "report/clash/group_numbers.hpp"
#include "report/exchange/clash_row.hpp"
#include "report/text/csv.hpp"
#include "report/text/formatting.hpp"
#include "report/text/ordered_lines.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {
namespace {

constexpr std::array kLogColumns{
    "test",       "a_id",           "a_name",          "a_file",
    "b_id",       "b_name",         "b_file",          "may_be_allowed",
    "class",      "cost",           "part_pairs",      "repeated_part_pairs",
    "node_pairs", "triangle_pairs", "exact_fallbacks", "depth_cells"};

}  // namespace

Status write_clash_csv(const ClashContents& contents, Sink sink, const parallel::Context& context) {
  const GroupNumbers numbers(contents);
  BufferedWriter buffer(sink);
  std::vector<const char*> columns(kResultColumns.begin(), kResultColumns.end());
  const bool decided = contents.decided != nullptr;
  if (decided) columns.insert(columns.end(), kDecidedColumns.begin(), kDecidedColumns.end());
  begin_csv(buffer.text(), contents.csv, columns, contents.columns);
  for (std::size_t t = 0; t < contents.findings.tests.size(); ++t) {
    const clash::Report& test = contents.findings.tests[t];
    const Status pairs =
        write_lines(context, test.pairs.size(), buffer, [&](std::size_t p, std::string& out) {
          const auto group = numbers.of(t, p);
          CsvRow row(out, contents.csv);
          append_result_cells(row, contents, t, test.pairs[p],
                              group ? contents.grouping->groups[*group].id : std::string_view(),
                              decided);
          row.end();
        });
    if (!pairs) return pairs;
    const Status exempted = write_lines(
        context, test.exempted_pairs.size(), buffer, [&](std::size_t p, std::string& out) {
          CsvRow row(out, contents.csv);
          append_exempted_cells(row, contents, test, test.exempted_pairs[p], decided);
          row.end();
        });
    if (!exempted) return exempted;
  }
  return {};
}

namespace {

void line(std::string& out, const ClashContents& contents, const clash::Report& test,
          const clash::LoggedPair& p) {
  CsvRow row(out, contents.csv);
  row.text(test.name);
  append_identity(row, contents.model, p.a);
  append_identity(row, contents.model, p.b);
  row.word(p.may_be_allowed ? "1" : "0").word(name(p.cls)).count(p.cost());
  for (const std::uint64_t n : {p.part_pairs, p.repeated_part_pairs, p.node_pairs, p.triangle_pairs,
                                p.exact_fallbacks, p.depth_cells})
    row.count(n);
  row.end();
}

}  // namespace

Status write_pair_log(const ClashContents& contents, Sink sink, const parallel::Context& context) {
  BufferedWriter buffer(sink);
  begin_csv(buffer.text(), contents.csv, kLogColumns, {});
  for (const clash::Report& test : contents.findings.tests) {
    const Status status = write_lines(
        context, test.log.size(), buffer,
        [&](std::size_t p, std::string& out) { line(out, contents, test, test.log[p]); });
    if (!status) return status;
  }
  return {};
}

}  // namespace strake::report
