// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "report/csv.hpp"
#include "report/lines.hpp"
#include "report/text.hpp"
#include "strake/clash/identity.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {
namespace {

void number(std::string& out, std::uint64_t value) {
  out += ',';
  out += std::to_string(value);
}

void line(std::string& out, const ClashContents& contents, const clash::Report& test,
          const clash::LoggedPair& p) {
  append_csv(out, test.name);
  out += ',';
  append_csv_identity(out, contents.model, p.a);
  append_csv_identity(out, contents.model, p.b);
  out += p.may_be_allowed ? "1," : "0,";
  out += name(p.cls);
  number(out, p.cost());
  for (const std::uint64_t n : {p.part_pairs, p.repeated_part_pairs, p.node_pairs, p.triangle_pairs,
                                p.exact_fallbacks, p.depth_cells})
    number(out, n);
  out += "\r\n";
}

}  // namespace

Status write_pair_log(const ClashContents& contents, Sink sink, const parallel::Context& context) {
  Buffered buffer(sink);
  buffer.text() =
      "test,a_id,a_name,a_file,b_id,b_name,b_file,may_be_allowed,class,cost,part_pairs,"
      "repeated_part_pairs,node_pairs,triangle_pairs,exact_fallbacks,depth_cells\r\n";
  for (const clash::Report& test : contents.findings.tests) {
    const Status status = write_lines(
        context, test.log.size(), buffer,
        [&](std::size_t p, std::string& out) { line(out, contents, test, test.log[p]); });
    if (!status) return status;
  }
  return {};
}

}  // namespace strake::report
