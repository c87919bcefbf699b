// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/elements.hpp"
#include "report/group_numbers.hpp"
#include "report/lines.hpp"
#include "report/text.hpp"
#include "strake/clash/identity.hpp"
#include "strake/core/number.hpp"
#include "strake/core/severity.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {
namespace {

using clash::Findings;
using clash::Pair;
using clash::Report;

constexpr std::string_view kSchemaVersion = "2";

void key(std::string& out, std::string_view name) {
  append_json(out, name);
  out += ": ";
}

void tolerances(std::string& out, const clash::Tolerances& t) {
  out += "\"clearance_mm\": ";
  append_mm(out, t.clearance_mm);
  out += ", \"touch_gap_mm\": ";
  append_mm(out, t.touch_gap_mm);
  out += ", \"touch_overlap_mm\": ";
  append_mm(out, t.touch_overlap_mm);
  out += ", \"thickness_cap\": ";
  out += t.thickness_cap == clash::ThicknessCap::on ? "true" : "false";
}

void settings(std::string& out, const Report& report) {
  out += "\"settings\": {";
  tolerances(out, clash::tolerances_of(report.options));
  out += ", \"contact_distance_mm\": ";
  append_mm(out, report.contact_distance_mm);
  out += ", \"curves\": ";
  out += report.options.curves == clash::Curves::on ? "true}" : "false}";
}

void files(std::string& out, const model::Model& model) {
  out += "\"files\": [";
  for (std::size_t i = 0; i < model.files.size(); ++i) {
    const model::SourceFile& file = model.files[i];
    out += i == 0 ? "{" : ", {";
    key(out, "label");
    append_json(out, file.label);
    out += ", ";
    key(out, "format");
    append_json(out, file.format);
    out += ", ";
    key(out, "unit");
    append_json(out, file.unit);
    out += "}";
  }
  out += "]";
}

void counts(std::string& out, std::uint64_t hit, std::uint64_t contact, std::uint64_t clearance,
            std::uint64_t allowed) {
  out += "\"counts\": {\"HIT\": " + std::to_string(hit) +
         ", \"CONTACT\": " + std::to_string(contact) +
         ", \"CLEARANCE_VIOLATION\": " + std::to_string(clearance) +
         ", \"ALLOWED\": " + std::to_string(allowed) + "}";
}

void objects(std::string& out, const Report& report) {
  out += "\"objects\": {\"a\": " + std::to_string(report.objects_a) +
         ", \"b\": " + std::to_string(report.objects_b) + "}";
}

void allowed(std::string& out, const Report& report) {
  out += "\"allowed\": [";
  for (std::size_t i = 0; i < report.allowed.size(); ++i) {
    const clash::AllowedCount& rule = report.allowed[i];
    out += i == 0 ? "{\"rule\": " : ", {\"rule\": ";
    append_json(out, rule.rule);
    out += ", \"candidates\": " + std::to_string(rule.candidates) +
           ", \"pairs\": " + std::to_string(rule.pairs) + "}";
  }
  out += "]";
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
  counts(out, cell.hit, cell.contact, cell.clearance_violation, cell.allowed);
  out += "}";
}

void matrix(std::string& out, const Report& report) {
  out += "\"matrix\": {\"disciplines\": [";
  for (std::size_t i = 0; i < report.disciplines.size(); ++i) {
    out += i == 0 ? "{\"name\": " : ", {\"name\": ";
    append_json(out, report.disciplines[i].name);
    out += ", \"objects\": " + std::to_string(report.disciplines[i].objects) + "}";
  }
  out += "], \"cells\": [";
  for (std::size_t i = 0; i < report.cells.size(); ++i) {
    out += i == 0 ? "\n    " : ",\n    ";
    cell(out, report, report.cells[i]);
  }
  out += "]}";
}

void exempted(std::string& out, const Report& report) {
  out += "\"exempted\": [";
  for (std::size_t i = 0; i < report.exempted.size(); ++i) {
    out += i == 0 ? "{\"rule\": " : ", {\"rule\": ";
    append_json(out, report.exempted[i].rule);
    out += ", \"pairs\": " + std::to_string(report.exempted[i].pairs) + "}";
  }
  out += "]";
}

/// Who was set against whom, so that a later run can tell what is gone from what was not looked at.
void tested(std::string& out, const Report& report, const Elements& elements) {
  out += "\"tested\": {\"a\": \"";
  elements.append_members(out, report.in_a);
  out += "\", \"b\": \"";
  elements.append_members(out, report.in_b);
  out += "\", \"within_files\": ";
  out += report.within_files ? "true}" : "false}";
}

void test(std::string& out, const Report& report, const Elements& elements) {
  out += "{\"name\": ";
  append_json(out, report.name);
  out += ", ";
  settings(out, report);
  out += ", \"sets\": {\"a\": ";
  append_json(out, report.set_a);
  out += ", \"b\": ";
  append_json(out, report.set_b);
  out += "}, ";
  objects(out, report);
  out += ", ";
  counts(out, report.count_hit, report.count_contact, report.count_clearance, report.count_allowed);
  out += ", ";
  exempted(out, report);
  out += ", ";
  allowed(out, report);
  if (!report.disciplines.empty()) {
    out += ", ";
    matrix(out, report);
  }
  out += ", ";
  tested(out, report, elements);
  out += ", \"hash\": ";
  append_json(out, report.hash);
  out += "}";
}

void tests(std::string& out, const Findings& findings, const Elements& elements) {
  out += "\"tests\": [";
  for (std::size_t i = 0; i < findings.tests.size(); ++i) {
    out += i == 0 ? "\n  " : ",\n  ";
    test(out, findings.tests[i], elements);
  }
  out += "]";
}

void diagnostics(std::string& out, const Diagnostics& all) {
  out += "\"diagnostics\": [";
  bool first = true;
  for (const Diagnostics::Count& c : all.counts()) {
    out += first ? "\n  {" : ",\n  {";
    first = false;
    key(out, "code");
    append_json(out, c.code);
    out += ", ";
    key(out, "severity");
    append_json(out, severity_name(c.severity));
    out += ", \"count\": " + std::to_string(c.count) + "}";
  }
  out += "]";
}

void messages(std::string& out, const Diagnostics& all) {
  out += "\"messages\": [";
  bool first = true;
  for (const Diagnostic& d : all.kept()) {
    out += first ? "\n  {" : ",\n  {";
    first = false;
    key(out, "code");
    append_json(out, d.code);
    out += ", ";
    key(out, "severity");
    append_json(out, severity_name(d.severity));
    out += ", ";
    key(out, "where");
    append_json(out, d.where);
    out += ", ";
    key(out, "message");
    append_json(out, d.message);
    out += "}";
  }
  out += "]";
}

void object(std::string& out, const model::Model& model, model::ObjectId id) {
  const model::Object& o = model.object(id);
  out += "{\"id\": ";
  append_json(out, o.id);
  out += ", \"name\": ";
  append_json(out, o.name);
  out += ", \"file\": ";
  append_json(out, model.files[o.file].label);
}

void point(std::string& out, std::string_view name, const geometry::Vec3d& p) {
  out += ", ";
  key(out, name);
  out += '[';
  append_point(out, p, ", ");
  out += ']';
}

/// Where the separation is measured: two closest points, or the way from the deepest one out.
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

void side(std::string& out, const model::Model& model, const Report& report, model::ObjectId id,
          std::uint32_t part, clash::Level level) {
  object(out, model, id);
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

/// Millimetres rounded outward, so that the points lie in it.
void box(std::string& out, const geometry::Box3d& b) {
  out += "[[";
  for (int k = 0; k < 3; ++k) {
    if (k > 0) out += ", ";
    append_mm_down(out, b.lo[k]);
  }
  out += "], [";
  for (int k = 0; k < 3; ++k) {
    if (k > 0) out += ", ";
    append_mm_up(out, b.hi[k]);
  }
  out += "]]";
}

void group(std::string& out, const clash::Group& g) {
  out += "{\"id\": \"" + g.id + "\", \"name\": ";
  append_json(out, g.name);
  out += ", \"results\": " + std::to_string(g.results.size()) + ", \"class\": \"";
  out += name(g.worst);
  out += "\", \"d_mm\": ";
  append_mm(out, g.d_mm);
  out += ", \"counts\": {\"HIT\": " + std::to_string(g.count_hit) +
         ", \"CONTACT\": " + std::to_string(g.count_contact) +
         ", \"CLEARANCE_VIOLATION\": " + std::to_string(g.count_clearance) + "}";
  if (g.volume_mm3) {
    out += ", \"volume_mm3\": ";
    append_mm(out, *g.volume_mm3);
  }
  out += ", \"box_mm\": ";
  box(out, g.box_mm);
  out += "}";
}

void groups(Buffered& buffer, const clash::Grouping& grouping) {
  std::string& out = buffer.text();
  out += "\"groups\": {\"by\": \"";
  out += name(grouping.rules.by);
  out += "\"";
  if (grouping.rules.by == clash::GroupBy::proximity) {
    out += ", \"distance_mm\": ";
    append_mm(out, grouping.rules.distance_mm);
  }
  out += ", \"list\": [";
  for (std::size_t g = 0; g < grouping.groups.size(); ++g) {
    out += g == 0 ? "\n  " : ",\n  ";
    group(out, grouping.groups[g]);
    buffer.done();
  }
  out += "]},\n";
}

/// The d of a result or of one of its regions.
template <class Found>
void measured(std::string& out, const Found& found) {
  out += ", \"d_mm\": ";
  append_mm(out, found.d_mm);
  out += ", \"d_range_mm\": [";
  append_range(out, found.d_lower_mm, found.d_upper_mm, ", ");
  out += ']';
}

/// How many separate places the two meet in, and the worst of several.
void regions(std::string& out, const Report& test, const Pair& p) {
  out += ", \"region_count\": ";
  out += p.regions == 0 ? "null" : std::to_string(p.regions);
  const std::uint32_t listed = p.regions_listed(test.options);
  if (listed == 0) return;
  out += ", \"regions\": [";
  for (std::uint32_t i = 0; i < listed; ++i) {
    const clash::Region& r = test.regions[p.first_region + i];
    out += i == 0 ? "{\"class\": \"" : ", {\"class\": \"";
    out += name(r.cls);
    out += '"';
    measured(out, r);
    point(out, "point_mm", r.point_mm);
    out += ", \"box_mm\": ";
    box(out, r.box_mm);
    out += ", \"part_a\": " + std::to_string(r.part_a) +
           ", \"part_b\": " + std::to_string(r.part_b) + ", \"flags\": [";
    append_flags(out, r.flags, ", ", "\"");
    out += "]}";
  }
  out += "]";
}

/// A result and the number of its group, if there are groups.
struct Numbered {
  std::size_t test = 0;
  const Pair& pair;
  std::optional<std::uint32_t> group;
};

void result(std::string& out, const ClashContents& contents, const Numbered& numbered) {
  const model::Model& model = contents.model;
  const Report& test = contents.findings.tests[numbered.test];
  const Pair& p = numbered.pair;
  out += "{\"key\": \"" + clash::pair_key(test.name, model, p.a, p.b) +
         "\", \"test\": " + std::to_string(numbered.test);
  if (numbered.group) out += ", \"group\": " + std::to_string(*numbered.group);
  out += ", \"a\": ";
  side(out, model, test, p.a, p.part_a, p.level_a);
  out += ", \"b\": ";
  side(out, model, test, p.b, p.part_b, p.level_b);
  out += ", \"class\": \"";
  out += name(p.cls);
  if (p.allowed >= 0) {
    out += "\", \"allowed\": ";
    append_json(out, test.allowed[static_cast<std::size_t>(p.allowed)].rule);
    out += ", \"relation\": \"";
  } else {
    out += "\", \"relation\": \"";
  }
  out += name(p.relation);
  out += '"';
  measured(out, p);
  witness(out, p);
  if (p.cls == clash::Class::hit && test.options.volumes == clash::Volumes::on) {
    out += ", \"volume_mm3\": ";
    if (p.volume_mm3)
      append_mm(out, *p.volume_mm3);
    else
      out += "null";
  }
  if (test.options.most_regions > 0) regions(out, test, p);
  out += ", \"flags\": [";
  append_flags(out, p.flags, ", ", "\"");
  out += "]}";
}

void exempted_pair(std::string& out, const model::Model& model, const Report& report,
                   std::size_t test, const clash::ExemptedPair& pair) {
  out += "{\"test\": " + std::to_string(test) + ", \"rule\": ";
  append_json(out, report.exempted[pair.rule].rule);
  out += ", \"a\": ";
  object(out, model, pair.a);
  out += "}, \"b\": ";
  object(out, model, pair.b);
  out += "}}";
}

void not_compared(std::string& out, const model::Model& model, std::size_t test,
                  const clash::NotCompared& what) {
  out += "{\"test\": " + std::to_string(test) + ", \"code\": ";
  append_json(out, what.code);
  out += ", \"a\": ";
  object(out, model, what.a);
  out += '}';
  if (what.b) {
    out += ", \"b\": ";
    object(out, model, *what.b);
    out += '}';
  }
  out += '}';
}

/// The list `name` of what items(test) are, one a line: write(text, number of the test, number of
/// the item in it, item).
template <class Items, class Write>
Status list(Buffered& buffer, std::string_view name, const Findings& findings,
            const parallel::Context& context, Items&& items, Write&& write) {
  key(buffer.text(), name);
  buffer.text() += '[';
  bool first = true;
  for (std::size_t t = 0; t < findings.tests.size(); ++t) {
    const auto& of_test = items(findings.tests[t]);
    const Status status =
        write_lines(context, of_test.size(), buffer, [&](std::size_t i, std::string& out) {
          out += first && i == 0 ? "\n" : ",\n";
          write(out, t, i, of_test[i]);
        });
    if (!status) return status;
    first = first && of_test.empty();
  }
  buffer.text() += "\n]";
  return {};
}

Status results(Buffered& buffer, const ClashContents& contents, const parallel::Context& context) {
  const GroupNumbers numbers(contents);
  return list(
      buffer, "results", contents.findings, context,
      [](const Report& test) -> const auto& { return test.pairs; },
      [&](std::string& out, std::size_t test, std::size_t p, const Pair& pair) {
        result(out, contents, {test, pair, numbers.of(test, p)});
      });
}

Status not_compared(Buffered& buffer, const ClashContents& contents,
                    const parallel::Context& context) {
  return list(
      buffer, "not_compared", contents.findings, context,
      [](const Report& test) -> const auto& { return test.not_compared; },
      [&](std::string& out, std::size_t test, std::size_t, const clash::NotCompared& what) {
        not_compared(out, contents.model, test, what);
      });
}

Status exempted_pairs(Buffered& buffer, const ClashContents& contents,
                      const parallel::Context& context) {
  const Findings& findings = contents.findings;
  if (std::ranges::none_of(findings.tests, &Report::lists_exempted)) return {};
  buffer.text() += ",\n";
  return list(
      buffer, "exempted", findings, context,
      [](const Report& test) -> const auto& { return test.exempted_pairs; },
      [&](std::string& out, std::size_t test, std::size_t, const clash::ExemptedPair& pair) {
        exempted_pair(out, contents.model, findings.tests[test], test, pair);
      });
}

}  // namespace

Status write_clash_json(const ClashContents& contents, Sink sink,
                        const parallel::Context& context) {
  const Findings& findings = contents.findings;
  Buffered buffer(sink);
  std::string& out = buffer.text();
  out += "{\n\"schema_version\": ";
  out += kSchemaVersion;
  out += ",\n";
  files(out, contents.model);
  out += ",\n";
  if (contents.rules != nullptr) {
    key(out, "rules");
    out += "{\"file\": ";
    append_json(out, contents.rules->file);
    out += ", \"hash\": \"" + contents.rules->hash.text() + "\"},\n";
  }
  const Elements elements(contents.model);
  out += "\"elements\": \"";
  elements.append_list(out);
  out += "\",\n";
  tests(out, findings, elements);
  out += ",\n\"hash\": ";
  append_json(out, hash_of(findings));
  out += ",\n";
  Diagnostics all;
  if (contents.loading != nullptr) all = *contents.loading;
  all.append(findings.all_diagnostics());
  diagnostics(out, all);
  out += ",\n";
  messages(out, all);
  out += ",\n";
  if (const Status s = not_compared(buffer, contents, context); !s) return s;
  out += ",\n";
  if (contents.grouping != nullptr) groups(buffer, *contents.grouping);
  if (const Status s = results(buffer, contents, context); !s) return s;
  if (const Status s = exempted_pairs(buffer, contents, context); !s) return s;
  out += "\n}\n";
  return {};
}

}  // namespace strake::report
