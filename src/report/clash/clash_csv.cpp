// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "clash/results/clash_key.hpp"
#include "report/clash/group_numbers.hpp"
#include "report/text/csv.hpp"
#include "report/text/formatting.hpp"
#include "report/text/ordered_lines.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {
namespace {

void discipline(std::string& out, const clash::Report& test, model::ObjectId id) {
  out += ',';
  if (test.disciplines.empty()) return;
  const std::uint32_t d = test.discipline[index(id)];
  if (d != clash::kNoLabel) append_csv(out, test.disciplines[d].name);
}

void level(std::string& out, const clash::Report& test, clash::Level of_part) {
  out += ',';
  if (test.levels) out += name(of_part);
}

void line(std::string& out, const model::Model& model, const clash::Report& test,
          const clash::Pair& p, std::string_view group) {
  append_csv_identity(out, model, p.a);
  append_csv_identity(out, model, p.b);
  out += name(p.cls);
  out += ',';
  out += name(p.relation);
  out += ',';
  append_mm(out, p.d_mm);
  out += ',';
  append_range(out, p.d_lower_mm, p.d_upper_mm, ",");
  out += ',';
  append_point(out, p.point_mm, ",");
  out += ',';
  append_flags(out, p.flags, " ", "");
  out += ',';
  append_csv(out, test.name);
  out += ',';
  out += clash::pair_key(test.name, model, p.a, p.b);
  out += ',';
  if (p.volume_mm3) append_mm(out, *p.volume_mm3);
  for (const geometry::Vec3d& v : {p.on_a_mm, p.on_b_mm, p.away}) {
    out += ',';
    append_point(out, v, ",");
  }
  out += ',';
  if (p.allowed >= 0) append_csv(out, test.allowed[static_cast<std::size_t>(p.allowed)].rule);
  out += ',';
  level(out, test, p.level_a);
  level(out, test, p.level_b);
  discipline(out, test, p.a);
  discipline(out, test, p.b);
  out += ',';
  out += group;
  out += ',';
  if (p.regions > 0) out += std::to_string(p.regions);
  out += ',';
  if (p.allowed_regions > 0) out += std::to_string(p.allowed_regions);
  out += p.depth_complete ? "," : ",false";
  out += "\r\n";
}

/// Appends a pair that was left out: of the class EXEMPTED, with nothing measured.
void exempted_line(std::string& out, const model::Model& model, const clash::Report& test,
                   const clash::ExemptedPair& p) {
  append_csv_identity(out, model, p.a);
  append_csv_identity(out, model, p.b);
  out += "EXEMPTED,,,,,,,,,";
  append_csv(out, test.name);
  out += ",,,,,,,,,,,,,";
  append_csv(out, test.exempted[p.rule].rule);
  out += ",,";
  discipline(out, test, p.a);
  discipline(out, test, p.b);
  out += ",,,,\r\n";
}

}  // namespace

Status write_clash_csv(const ClashContents& contents, Sink sink, const parallel::Context& context) {
  const GroupNumbers numbers(contents);
  BufferedWriter buffer(sink);
  buffer.text() =
      "a_id,a_name,a_file,b_id,b_name,b_file,class,relation,d_mm,d_lower_mm,d_upper_mm,x_mm,y_mm,"
      "z_mm,flags,test,key,volume_mm3,on_a_x_mm,on_a_y_mm,on_a_z_mm,on_b_x_mm,on_b_y_mm,on_b_z_mm,"
      "away_x,away_y,away_z,allowed_by,exempted_by,a_level,b_level,a_discipline,b_discipline,"
      "group,regions,allowed_regions,depth_complete\r\n";
  for (std::size_t t = 0; t < contents.findings.tests.size(); ++t) {
    const clash::Report& test = contents.findings.tests[t];
    const Status pairs =
        write_lines(context, test.pairs.size(), buffer, [&](std::size_t p, std::string& out) {
          const auto group = numbers.of(t, p);
          line(out, contents.model, test, test.pairs[p],
               group ? contents.grouping->groups[*group].id : std::string_view());
        });
    if (!pairs) return pairs;
    const Status exempted = write_lines(
        context, test.exempted_pairs.size(), buffer, [&](std::size_t p, std::string& out) {
          exempted_line(out, contents.model, test, test.exempted_pairs[p]);
        });
    if (!exempted) return exempted;
  }
  return {};
}

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
  BufferedWriter buffer(sink);
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
