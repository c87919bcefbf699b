// SPDX-License-Identifier: Apache-2.0
#include "report/clash_json_results.hpp"

#include <cstddef>
#include <span>
#include <string_view>

#include "report/json_fields.hpp"
#include "report/text.hpp"
#include "strake/clash/identity.hpp"

namespace strake::report {
namespace {

using clash::Pair;
using clash::Report;

/// The beginning of an object, which what is told of it may follow.
void begin_object(std::string& out, const model::Model& model, model::ObjectId id) {
  const model::Object& o = model.object(id);
  out += '{';
  append_identity(out, o.id, o.name, model.files[o.file].label);
  if (o.positional_id) out += ", \"positional_id\": true";
}

void object(std::string& out, const model::Model& model, model::ObjectId id) {
  begin_object(out, model, id);
  out += '}';
}

void point(std::string& out, std::string_view name, const geometry::Vec3d& p) {
  out += ", ";
  append_key(out, name);
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
  begin_object(out, model, id);
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

/// The d of a result or of one of its regions.
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

/// How many separate places the two meet in, and the worst of several; those apart that a rule
/// allows.
void regions(std::string& out, const Report& test, const Pair& p) {
  if (test.options.most_regions > 0) {
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

void volume(std::string& out, const Pair& p) {
  out += ", \"volume_mm3\": ";
  if (p.volume_mm3)
    append_mm(out, *p.volume_mm3);
  else
    out += "null";
}

}  // namespace

void append_result(std::string& out, const ClashContents& contents, std::size_t test, const Pair& p,
                   std::optional<std::uint32_t> group) {
  const model::Model& model = contents.model;
  const Report& report = contents.findings.tests[test];
  out += "{\"key\": \"" + clash::pair_key(report.name, model, p.a, p.b) +
         "\", \"test\": " + std::to_string(test);
  if (group) out += ", \"group\": " + std::to_string(*group);
  out += ", \"a\": ";
  side(out, model, report, p.a, p.part_a, p.level_a);
  out += ", \"b\": ";
  side(out, model, report, p.b, p.part_b, p.level_b);
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
  witness(out, p);
  if (p.cls == clash::Class::hit && report.options.volumes == clash::Volumes::on) volume(out, p);
  regions(out, report, p);
  flags(out, p.flags);
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
  object(out, contents.model, pair.a);
  out += ", \"b\": ";
  object(out, contents.model, pair.b);
  out += '}';
}

void append_not_compared(std::string& out, const ClashContents& contents, std::size_t test,
                         const clash::NotCompared& what) {
  out += "{\"test\": " + std::to_string(test) + ", \"code\": ";
  append_json(out, what.code);
  out += ", \"a\": ";
  object(out, contents.model, what.a);
  if (what.b) {
    out += ", \"b\": ";
    object(out, contents.model, *what.b);
  }
  out += '}';
}

}  // namespace strake::report
