// SPDX-License-Identifier: Apache-2.0
#include "tiles/test_codec.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "project/codec/blob.hpp"
#include "project/stored_report/report_codec.hpp"
#include "project/stored_report/report_head.hpp"

namespace strake::tiles {
namespace {

using project::BlobReader;
using project::BlobWriter;

/// Returns the report that a test begins with: its codec has options, sets and the names of rules.
/// The tolerances of the matrix stand in cells.
clash::Report begun(const rules::PlannedTest& test) {
  clash::Report report;
  report.name = test.name;
  report.options = test.options;
  report.set_a = test.sets.name_a;
  report.set_b = test.sets.name_b;
  report.in_a = test.sets.in_a;
  report.in_b = test.sets.in_b;
  report.lists_exempted = test.policy.list_exempted;
  report.levels = test.policy.levels.has_value();
  for (const clash::Exemption& e : test.policy.exemptions) report.exempted.push_back({e.rule, 0});
  for (const clash::Allowed& a : test.policy.allowed) report.allowed.push_back({a.rule});
  if (!test.policy.matrix) return report;
  for (const std::string& name : test.policy.matrix->disciplines)
    report.disciplines.push_back({name, 0});
  report.discipline = test.policy.matrix->discipline;
  for (const clash::Tolerances& t : test.policy.tolerances)
    report.cells.emplace_back().tolerances = t;
  return report;
}

void take(clash::Report& report, rules::PlannedTest& test) {
  test.name = std::move(report.name);
  test.options = report.options;
  test.sets.name_a = std::move(report.set_a);
  test.sets.name_b = std::move(report.set_b);
  test.sets.in_a = std::move(report.in_a);
  test.sets.in_b = std::move(report.in_b);
  test.policy.list_exempted = report.lists_exempted;
  if (report.levels) test.policy.levels.emplace();
  for (const clash::Exempted& e : report.exempted) test.policy.exemptions.push_back({e.rule, {}});
  for (const clash::AllowedCount& a : report.allowed) {
    clash::Allowed& rule = test.policy.allowed.emplace_back();
    rule.rule = a.rule;
  }
  for (const clash::CellReport& cell : report.cells)
    test.policy.tolerances.push_back(cell.tolerances);
}

void write(BlobWriter& out, const std::vector<std::uint32_t>& values) {
  out.column(std::span(values));
}

void write(BlobWriter& out, const geometry::Vec3d& v) {
  for (int k = 0; k < 3; ++k) out.real(v[k]);
}

geometry::Vec3d read_vector(BlobReader& in) {
  geometry::Vec3d v;
  for (int k = 0; k < 3; ++k) v[k] = in.real();
  return v;
}

void write(BlobWriter& out, const std::optional<double>& value) {
  out.number(value ? 1 : 0);
  if (value) out.real(*value);
}

std::optional<double> read_optional(BlobReader& in) {
  return in.number() == 0 ? std::nullopt : std::optional(in.real());
}

/// The kinds of exemptions have numbers by their place in the variant.
struct ExemptionWriter {
  BlobWriter& out;

  void operator()(const clash::SameLabel& test) const { write(out, test.label); }
  void operator()(const clash::Linked& test) const {
    for (const clash::Linked::Lists* const lists : {&test.answers_to, &test.refers_to}) {
      write(out, lists->first);
      write(out, lists->numbers);
    }
  }
  void operator()(const clash::Between& test) const {
    out.flags(test.a);
    out.flags(test.b);
  }
};

clash::Linked::Lists read_lists(BlobReader& in) {
  clash::Linked::Lists lists;
  lists.first = in.column<std::uint32_t>();
  lists.numbers = in.column<std::uint32_t>();
  for (std::size_t i = 0; i + 1 < lists.first.size(); ++i)
    if (lists.first[i] > lists.first[i + 1]) in.refuse("lists are not in order");
  return lists;
}

decltype(clash::Exemption::test) read_exemption(BlobReader& in) {
  switch (in.number()) {
    case 0:
      return clash::SameLabel{in.column<std::uint32_t>(), {}};
    case 1: {
      clash::Linked linked;
      linked.answers_to = read_lists(in);
      linked.refers_to = read_lists(in);
      return linked;
    }
    case 2: {
      clash::Between between;
      between.a = in.flags();
      between.b = in.flags();
      return between;
    }
    default:
      in.refuse("an exemption is of no kind");
      return {};
  }
}

void write_levels(BlobWriter& out, const clash::Levels& levels) {
  std::vector<std::uint8_t> of_object;
  for (const clash::Level level : levels.object)
    of_object.push_back(static_cast<std::uint8_t>(level));
  out.column<std::uint8_t>(of_object);
  out.number(static_cast<std::uint64_t>(levels.obstruction_bodies));
  out.text(levels.no_obstruction_rule);
  for (const auto& row : levels.left_out)
    for (const std::string& rule : row) out.text(rule);
}

clash::Level read_level(BlobReader& in, std::uint64_t value) {
  if (value > static_cast<std::uint64_t>(clash::Level::none)) in.refuse("a level is none");
  return static_cast<clash::Level>(value);
}

void read_levels(BlobReader& in, clash::Levels& levels) {
  for (const std::uint8_t level : in.column<std::uint8_t>())
    levels.object.push_back(read_level(in, level));
  levels.obstruction_bodies = read_level(in, in.number());
  levels.no_obstruction_rule = in.text();
  for (auto& row : levels.left_out)
    for (std::string& rule : row) rule = in.text();
}

/// Neither this nor read_allowed() compiles where the rule has a member more. Its name is written
/// with those of the other rules.
void write_allowed(BlobWriter& out, const clash::Allowed& rule) {
  const auto& [name, a, b, region, cavity, max_depth, relations, max_volume] = rule;
  out.flags(a);
  out.flags(b);
  out.number(region ? 1 : 0);
  if (region) {
    write(out, region->lo);
    write(out, region->hi);
  }
  out.number(cavity.size());
  for (const clash::HalfSpace& side : cavity) {
    write(out, side.point_mm);
    write(out, side.normal);
  }
  write(out, max_depth);
  std::uint64_t bits = 0;
  for (const clash::Relation r : clash::kRelations)
    if (relations.contains(r)) bits |= std::uint64_t{1} << static_cast<unsigned>(r);
  out.number(bits);
  write(out, max_volume);
}

void read_allowed(BlobReader& in, clash::Allowed& rule) {
  auto& [name, a, b, region, cavity, max_depth, relations, max_volume] = rule;
  a = in.flags();
  b = in.flags();
  if (in.number() != 0) {
    region.emplace();
    region->lo = read_vector(in);
    region->hi = read_vector(in);
  }
  for (std::uint64_t n = in.number(); n > 0 && !in.failed(); --n) {
    clash::HalfSpace& side = cavity.emplace_back();
    side.point_mm = read_vector(in);
    side.normal = read_vector(in);
  }
  max_depth = read_optional(in);
  const std::uint64_t bits = in.number();
  for (const clash::Relation r : clash::kRelations)
    if ((bits >> static_cast<unsigned>(r) & 1U) != 0) relations.add(r);
  max_volume = read_optional(in);
}

}  // namespace

Result<std::vector<std::byte>> encode_test(const rules::PlannedTest& test) {
  const auto head = project::encode_head(begun(test));
  if (!head) return head.error();
  BlobWriter out;
  out.column(std::span<const std::byte>(*head));
  write(out, test.sets.group);
  const clash::Policy& policy = test.policy;
  out.number(policy.matrix ? 1 : 0);
  if (policy.matrix) {
    out.text(policy.matrix->rule);
    write(out, policy.matrix->cells);
  }
  for (const clash::Exemption& e : policy.exemptions) {
    out.number(e.test.index());
    std::visit(ExemptionWriter{out}, e.test);
  }
  if (policy.levels) write_levels(out, *policy.levels);
  for (const clash::Allowed& rule : policy.allowed) write_allowed(out, rule);
  return out.finish();
}

Result<rules::PlannedTest> decode_test(std::span<const std::byte> bytes, std::size_t objects,
                                       const std::string& what) {
  Result<BlobReader> in = BlobReader::open(bytes, what);
  if (!in) return in.error();
  const std::vector<std::byte> head = in->column<std::byte>();
  if (in->failed()) return in->finish().error();
  Result<clash::Report> report = project::decode_head(head, objects, what);
  if (!report) return report.error();
  rules::PlannedTest test;
  take(*report, test);
  test.sets.group = in->column<std::uint32_t>();
  clash::Policy& policy = test.policy;
  if (in->number() != 0) {
    policy.matrix.emplace();
    policy.matrix->rule = in->text();
    policy.matrix->cells = in->column<std::uint32_t>();
    for (const clash::DisciplineCount& d : report->disciplines)
      policy.matrix->disciplines.push_back(d.name);
    policy.matrix->discipline = std::move(report->discipline);
  }
  for (clash::Exemption& e : policy.exemptions) e.test = read_exemption(*in);
  if (policy.levels) read_levels(*in, *policy.levels);
  for (clash::Allowed& rule : policy.allowed) read_allowed(*in, rule);
  if (const Status status = in->finish(); !status) return status.error();
  return test;
}

}  // namespace strake::tiles
