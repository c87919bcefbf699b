// SPDX-License-Identifier: Apache-2.0
#include "report/clash/clash_json_members.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "clash/results/required_clearance.hpp"
#include "clash/rules/tolerance_lengths.hpp"
#include "core/text_encoding.hpp"
#include "report/clash/contents.hpp"
#include "report/json/element_hashes.hpp"
#include "report/json/json_writer.hpp"
#include "report/text/formatting.hpp"
#include "strake/parallel/find.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::report {

namespace {

using clash::Pair;
using clash::Report;

/// Appends the attributes that are requested and that the object states.
void attributes(std::string& out, const ClashContents& contents, model::ObjectId id) {
  out += ", \"attributes\": {";
  bool first = true;
  for (const std::string& attribute : contents.columns) {
    const std::optional<std::string> value = stated_text(contents.model, id, attribute);
    if (!value) continue;
    out += first ? "" : ", ";
    first = false;
    append_json(out, attribute);
    out += ": ";
    append_json(out, *value);
  }
  out += '}';
}

/// Appends the beginning of an object, which further members may follow.
void begin_object(std::string& out, const ClashContents& contents, model::ObjectId id) {
  const model::Object& o = contents.model.object(id);
  out += '{';
  append_identity(out, o.id, o.name, contents.model.files[o.file].label);
  if (o.positional_id) out += ", \"positional_id\": true";
  if (!contents.columns.empty()) attributes(out, contents, id);
}

void object(std::string& out, const ClashContents& contents, model::ObjectId id) {
  begin_object(out, contents, id);
  out += '}';
}

void point(std::string& out, std::string_view name, const geometry::Vec3d& p) {
  out += ", ";
  append_key(out, name);
  out += '[';
  append_point(out, p, ", ");
  out += ']';
}

/// Appends where the separation is measured: two closest points, or the way from the deepest one
/// out.
void witness(std::string& out, const Pair& p) {
  point(out, "point_mm", p.point_mm);
  if (p.d_mm >= 0) {
    point(out, "on_a_mm", p.on_a_mm);
    point(out, "on_b_mm", p.on_b_mm);
  } else if (p.away == geometry::Vec3d{}) {
    out += ", \"surface_mm\": null, \"push_out\": null";
  } else {
    point(out, "surface_mm", p.surface_mm());
    point(out, "push_out", p.away);
  }
}

void side(std::string& out, const ClashContents& contents, const Report& report, model::ObjectId id,
          std::uint32_t part, clash::Level level) {
  begin_object(out, contents, id);
  out += ", \"part\": " + std::to_string(part);
  if (report.levels) {
    out += ", \"level\": \"";
    out += name(level);
    out += '"';
  }
  if (!report.disciplines.empty()) {
    const std::uint32_t d = report.discipline[index(id)];
    out += ", \"discipline\": ";
    append_json(out, d == clash::kNoLabel ? std::string_view() : report.disciplines[d].name);
  }
  out += "}";
}

/// Appends a box in millimetres rounded outward, so that the points lie in it.
void box(std::string& out, const geometry::Box3d& b) {
  out += "[[";
  for (int k = 0; k < 3; ++k) {
    if (k > 0) out += ", ";
    append_mm_floor(out, b.lo[k]);
  }
  out += "], [";
  for (int k = 0; k < 3; ++k) {
    if (k > 0) out += ", ";
    append_mm_ceil(out, b.hi[k]);
  }
  out += "]]";
}

/// Appends the d of a result or of one of its regions.
template <class Found>
void measured(std::string& out, const Found& found) {
  out += ", \"d_mm\": ";
  append_mm(out, found.d_mm);
  out += ", \"d_range_mm\": [";
  append_range(out, found.d_lower_mm, found.d_upper_mm, ", ");
  out += ']';
  if (!found.depth_complete) out += ", \"depth_complete\": false";
}

void flags(std::string& out, std::uint16_t of_found) {
  out += ", \"flags\": [";
  append_flags(out, of_found, ", ", "\"");
  out += ']';
}

void allowed(std::string& out, const Report& test, std::int32_t rule) {
  if (rule < 0) return;
  out += ", \"allowed\": ";
  append_json(out, test.allowed[static_cast<std::size_t>(rule)].rule);
}

void region(std::string& out, const Report& test, const clash::Region& r) {
  out += "{\"class\": \"";
  out += name(r.cls);
  out += '"';
  allowed(out, test, r.allowed);
  measured(out, r);
  point(out, "point_mm", r.point_mm);
  out += ", \"box_mm\": ";
  box(out, r.box_mm);
  out += ", \"part_a\": " + std::to_string(r.part_a) + ", \"part_b\": " + std::to_string(r.part_b);
  flags(out, r.flags);
  out += '}';
}

void region_list(std::string& out, const Report& test, std::string_view name, std::size_t first,
                 std::size_t listed) {
  if (listed == 0) return;
  out += ", ";
  append_list(out, name, std::span(test.regions).subspan(first, listed),
              [&](const clash::Region& r) { region(out, test, r); });
}

/// Appends how many separate regions the two meet in, and the worst of several; those that a rule
/// allows apart.
void regions(std::string& out, const Report& test, const Pair& p) {
  if (test.options.engine.max_regions > 0) {
    out += ", \"region_count\": ";
    out += p.regions == 0 ? "null" : std::to_string(p.regions);
  }
  if (p.allowed_regions > 0)
    out += ", \"allowed_region_count\": " + std::to_string(p.allowed_regions);
  const std::uint32_t listed = p.regions_listed(test.options);
  region_list(out, test, "regions", p.first_region, listed);
  region_list(out, test, "allowed_regions", p.first_region + listed,
              p.allowed_regions_listed(test.options));
}

/// Appends the clearance that the pair has to keep, where its objects have a say in it.
void required_clearance(std::string& out, const Report& report, const Pair& p) {
  const std::optional<double> mm = clash::required_clearance_mm(report, p);
  if (!mm) return;
  out += ", \"clearance_mm\": ";
  append_mm(out, *mm);
}

void volume(std::string& out, const Pair& p) {
  out += ", \"volume_mm3\": ";
  if (p.volume_mm3)
    append_mm(out, *p.volume_mm3);
  else
    out += "null";
}

/// Appends a member that has a text, if it has one.
void stated(std::string& out, std::string_view key, std::string_view text) {
  if (text.empty()) return;
  out += ", ";
  append_key(out, key);
  append_json(out, text);
}

void decision(std::string& out, const ClashContents& contents, std::size_t test, const Pair& p) {
  if (contents.decided == nullptr) return;
  const DecidedResult* const decided = contents.decided->of(test, p);
  if (decided == nullptr && p.allowed >= 0) return;
  out += ", \"decision\": {\"status\": ";
  append_json(out,
              name(decided == nullptr ? DecisionStatus::undecided : decided->decision->status));
  if (decided != nullptr) {
    append_decided(out, *decided->decision);
    stated(out, "reopened", name(decided->reopened));
  }
  out += '}';
}

}  // namespace

void append_decided(std::string& out, const Decision& decision) {
  stated(out, "by", decision.by);
  stated(out, "date", decision.date);
  stated(out, "comment", decision.comment);
}

void append_result(std::string& out, const ClashContents& contents, std::size_t test, const Pair& p,
                   std::optional<std::uint32_t> group) {
  const model::Model& model = contents.model;
  const Report& report = contents.findings.tests[test];
  out += "{\"key\": \"" + clash::pair_key(report.name, model, p.a, p.b) +
         "\", \"test\": " + std::to_string(test);
  if (group) out += ", \"group\": " + std::to_string(*group);
  out += ", \"a\": ";
  side(out, contents, report, p.a, p.part_a, p.level_a);
  out += ", \"b\": ";
  side(out, contents, report, p.b, p.part_b, p.level_b);
  out += ", \"class\": \"";
  out += name(p.cls);
  out += '"';
  allowed(out, report, p.allowed);
  if (p.severest > (p.allowed < 0 ? p.cls : clash::Class::no_hit)) {
    out += ", \"may_be\": \"";
    out += name(p.severest);
    out += '"';
  }
  out += ", \"relation\": \"";
  out += name(p.relation);
  out += '"';
  measured(out, p);
  required_clearance(out, report, p);
  witness(out, p);
  if (p.cls == clash::Class::hit && report.options.engine.volumes == clash::Volumes::on)
    volume(out, p);
  regions(out, report, p);
  flags(out, p.flags);
  decision(out, contents, test, p);
  out += '}';
}

void append_group(std::string& out, const clash::Group& g) {
  out += "{\"id\": \"" + g.id + "\", \"name\": ";
  append_json(out, g.name);
  out += ", \"results\": " + std::to_string(g.results.size()) + ", \"class\": \"";
  out += name(g.worst);
  out += "\", \"d_mm\": ";
  append_mm(out, g.d_mm);
  out += ", ";
  append_counts(out, g.count_hit, g.count_contact, g.count_clearance);
  if (g.volume_mm3) {
    out += ", \"volume_mm3\": ";
    append_mm(out, *g.volume_mm3);
  }
  out += ", \"box_mm\": ";
  box(out, g.box_mm);
  out += "}";
}

void append_exempted_pair(std::string& out, const ClashContents& contents, std::size_t test,
                          const clash::ExemptedPair& pair) {
  out += "{\"test\": " + std::to_string(test) + ", \"rule\": ";
  append_json(out, contents.findings.tests[test].exempted[pair.rule].rule);
  out += ", \"a\": ";
  object(out, contents, pair.a);
  out += ", \"b\": ";
  object(out, contents, pair.b);
  out += '}';
}

void append_not_compared(std::string& out, const ClashContents& contents, std::size_t test,
                         const clash::NotCompared& what) {
  out += "{\"test\": " + std::to_string(test) + ", \"code\": ";
  append_json(out, what.code);
  out += ", \"a\": ";
  object(out, contents, what.a);
  if (what.b) {
    out += ", \"b\": ";
    object(out, contents, *what.b);
  }
  out += '}';
}

namespace {

void tolerances(std::string& out, const clash::Tolerances& t) {
  for (const clash::ToleranceLength& length : clash::kToleranceLengths) {
    out.append("\"").append(length.name).append("_mm\": ");
    append_mm(out, t.*length.value_mm);
    out += ", ";
  }
  out += "\"thickness_cap\": ";
  out += t.thickness_cap == clash::ThicknessCap::on ? "true" : "false";
  if (!t.object_clearances) return;
  out += ", \"clearance_attribute\": ";
  append_json(out, t.object_clearances->attribute);
}

/// Appends which results the test reports, if not all.
void reporting(std::string& out, const clash::Reporting& reporting) {
  if (!reporting.relations.empty()) {
    std::string names;
    for (const clash::Relation relation : clash::kRelations)
      if (reporting.relations.contains(relation))
        names.append(names.empty() ? "\"" : ", \"").append(name(relation)).append("\"");
    out += ", \"relations\": [" + names + "]";
  }
  if (reporting.min_volume_mm3 > 0) {
    out += ", \"min_volume_mm3\": ";
    append_mm(out, reporting.min_volume_mm3);
  }
}

void settings(std::string& out, const Report& report) {
  out += "\"settings\": {";
  tolerances(out, report.options.tolerances);
  out += ", \"contact_distance_mm\": ";
  append_mm(out, report.contact_distance_mm);
  if (report.weld_mm >= 0) {
    out += ", \"weld_mm\": ";
    append_mm(out, report.weld_mm);
  }
  out += ", \"curves\": ";
  out += report.options.engine.curves == clash::Curves::on ? "true" : "false";
  reporting(out, report.options.reporting);
  out += '}';
}

void sets(std::string& out, const Report& report) {
  out += "\"sets\": {\"a\": ";
  append_json(out, report.set_a);
  out += ", \"b\": ";
  append_json(out, report.set_b);
  out += "}, \"objects\": {\"a\": " + std::to_string(report.objects_a) +
         ", \"b\": " + std::to_string(report.objects_b) + "}";
}

/// Appends the contacts that are only counted, if they are.
void unlisted(std::string& out, const Report& report) {
  if (report.options.engine.contacts != clash::Contacts::count) return;
  out += "\"unlisted\": {\"CONTACT\": " + std::to_string(report.unlisted.contacts) +
         ", \"ALLOWED\": " + std::to_string(report.unlisted.allowed) + "}, ";
}

/// Appends the results that the test does not report, if it leaves some out.
void not_reported(std::string& out, const Report& report) {
  if (!report.options.reporting.leaves_out()) return;
  const std::array<std::pair<const char*, clash::NotReported::Counts>, 2> reasons{
      {{"relation", report.not_reported.by_relation}, {"volume", report.not_reported.by_volume}}};
  append_list(out, "not_reported", reasons, [&](const auto& reason) {
    out.append("{\"by\": \"").append(reason.first).append("\", ");
    const clash::NotReported::Counts& counts = reason.second;
    append_counts(out, counts.hit, counts.contact, counts.clearance_violation, counts.allowed);
    out += '}';
  });
  out += ", ";
}

void exempted(std::string& out, const Report& report) {
  append_list(out, "exempted", report.exempted, [&](const clash::Exempted& rule) {
    out += "{\"rule\": ";
    append_json(out, rule.rule);
    out += ", \"pairs\": " + std::to_string(rule.pairs) + "}";
  });
}

void allowed(std::string& out, const Report& report) {
  append_list(out, "allowed", report.allowed, [&](const clash::AllowedCount& rule) {
    out += "{\"rule\": ";
    append_json(out, rule.rule);
    out += ", \"candidates\": " + std::to_string(rule.candidates) +
           ", \"pairs\": " + std::to_string(rule.pairs) +
           ", \"places\": " + std::to_string(rule.regions) + "}";
  });
}

void cell(std::string& out, const Report& report, const clash::CellReport& cell) {
  out += "{\"a\": ";
  append_json(out, report.disciplines[cell.a].name);
  out += ", \"b\": ";
  append_json(out, report.disciplines[cell.b].name);
  out += ", \"checked\": ";
  if (!cell.checked) {
    out += "false}";
    return;
  }
  out += "true, \"settings\": {";
  tolerances(out, cell.tolerances);
  out += "}, ";
  append_counts(out, cell.hit, cell.contact, cell.clearance_violation, cell.allowed);
  out += "}";
}

void matrix(std::string& out, const Report& report) {
  out += "\"matrix\": {";
  append_list(out, "disciplines", report.disciplines, [&](const clash::DisciplineCount& d) {
    out += "{\"name\": ";
    append_json(out, d.name);
    out += ", \"objects\": " + std::to_string(d.objects) + "}";
  });
  out += ", ";
  append_list(
      out, "cells", report.cells, [&](const clash::CellReport& c) { cell(out, report, c); },
      "\n    ");
  out += "}";
}

/// Appends which objects were compared with which, so that a later run can tell what is gone from
/// what was not checked.
Status tested(std::string& out, const Report& report, const ElementHashes& elements,
              const parallel::Context& context) {
  out += "\"tested\": {\"a\": \"";
  if (Status s = elements.append_members(out, report.in_a, context); !s) return s;
  out += "\", \"b\": \"";
  if (Status s = elements.append_members(out, report.in_b, context); !s) return s;
  out += "\", \"within_files\": ";
  out += report.within_files ? "true}" : "false}";
  return {};
}

/// Returns what Report::sheets of any test says of each object: each has those of its own sets.
std::vector<std::uint8_t> sheets(const clash::Findings& findings) {
  std::vector<std::uint8_t> all;
  for (const Report& test : findings.tests) {
    all.resize(std::max(all.size(), test.sheets.size()), 0);
    for (std::size_t o = 0; o < test.sheets.size(); ++o) all[o] = std::max(all[o], test.sheets[o]);
  }
  return all;
}

/// Returns which objects have positional ids; empty if none has.
Result<std::vector<bool>> positional_ids(const model::Model& model,
                                         const parallel::Context& context) {
  // Blocks have whole words of bits to themselves.
  const parallel::Region objects{
      .name = "positional ids", .n = model.objects.size(), .grain = 16384};
  const auto any = parallel::find_first(
      context, objects, [&](std::size_t i) { return model.objects[i].positional_id; });
  if (!any) return any.error();
  std::vector<bool> ids;
  if (!*any) return ids;
  ids.resize(model.objects.size());
  const Status status = parallel::for_each(
      context, objects, [&](std::size_t i) { ids[i] = model.objects[i].positional_id; });
  if (!status) return status.error();
  return ids;
}

/// What tests name objects by, where they do.
struct NamedElements {
  const ElementHashes& hashes;
  const parallel::Context& context;
};

/// `elements` is null where the test is told without what was compared with what.
Status test(std::string& out, const Report& report, const NamedElements* elements) {
  out += "{\"name\": ";
  append_json(out, report.name);
  out += ", ";
  settings(out, report);
  out += ", ";
  sets(out, report);
  out += ", ";
  append_counts(out, report.count_hit, report.count_contact, report.count_clearance,
                report.count_allowed);
  out += ", ";
  unlisted(out, report);
  not_reported(out, report);
  exempted(out, report);
  out += ", ";
  allowed(out, report);
  if (!report.disciplines.empty()) {
    out += ", ";
    matrix(out, report);
  }
  if (elements != nullptr) {
    out += ", ";
    if (Status s = tested(out, report, elements->hashes, elements->context); !s) return s;
  }
  out += ", \"hash\": ";
  append_json(out, report.hash);
  out += "}";
  return {};
}

/// Appends the member `tests`.
Status test_list(std::string& out, const clash::Findings& findings, const NamedElements* elements) {
  Status all;
  append_list(
      out, "tests", findings.tests,
      [&](const Report& report) {
        Status status = all ? test(out, report, elements) : Status{};
        if (!status) all = std::move(status);
      },
      "\n  ");
  return all;
}

}  // namespace

Status append_tests(std::string& out, const clash::Findings& findings, const model::Model& model,
                    const parallel::Context& context) {
  const Result<ElementHashes> elements = ElementHashes::of(model, context);
  if (!elements) return elements.error();
  out += "\"elements\": \"";
  if (Status s = elements->append_list(out, context); !s) return s;
  out += "\",\n\"sheets\": \"";
  if (Status s = elements->append_bytes(out, sheets(findings), context); !s) return s;
  out += "\",\n";
  const Result<std::vector<bool>> ids = positional_ids(model, context);
  if (!ids) return ids.error();
  if (!ids->empty()) {
    out += "\"positional_ids\": \"";
    if (Status s = elements->append_members(out, *ids, context); !s) return s;
    out += "\",\n";
  }
  const NamedElements named{*elements, context};
  return test_list(out, findings, &named);
}

Status append_test_list(std::string& out, const clash::Findings& findings) {
  return test_list(out, findings, nullptr);
}

}  // namespace strake::report
