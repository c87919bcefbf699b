// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>

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

void settings(std::string& out, const Report& report) {
  const clash::Options& o = report.options;
  out += "\"settings\": {\"clearance_mm\": ";
  append_mm(out, o.clearance_mm);
  out += ", \"touch_gap_mm\": ";
  append_mm(out, o.touch_gap_mm);
  out += ", \"touch_overlap_mm\": ";
  append_mm(out, o.touch_overlap_mm);
  out += ", \"thickness_cap\": ";
  out += o.thickness_cap == clash::ThicknessCap::on ? "true" : "false";
  out += ", \"contact_distance_mm\": ";
  append_mm(out, report.contact_distance_mm);
  out += "}";
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

void counts(std::string& out, const Report& report) {
  out += "\"objects\": {\"a\": " + std::to_string(report.objects_a) +
         ", \"b\": " + std::to_string(report.objects_b) +
         "}, \"counts\": {\"HIT\": " + std::to_string(report.count_hit) +
         ", \"CONTACT\": " + std::to_string(report.count_contact) +
         ", \"CLEARANCE_VIOLATION\": " + std::to_string(report.count_clearance) +
         ", \"ALLOWED\": " + std::to_string(report.count_allowed) + "}";
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

void test(std::string& out, const Report& report) {
  out += "{\"name\": ";
  append_json(out, report.name);
  out += ", ";
  settings(out, report);
  out += ", \"sets\": {\"a\": ";
  append_json(out, report.set_a);
  out += ", \"b\": ";
  append_json(out, report.set_b);
  out += "}, ";
  counts(out, report);
  out += ", ";
  exempted(out, report);
  out += ", \"hash\": ";
  append_json(out, report.hash);
  out += "}";
}

void tests(std::string& out, const Findings& findings) {
  out += "\"tests\": [";
  for (std::size_t i = 0; i < findings.tests.size(); ++i) {
    out += i == 0 ? "\n  " : ",\n  ";
    test(out, findings.tests[i]);
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

void result(std::string& out, const model::Model& model, std::size_t number, const Report& test,
            const Pair& p) {
  out += "{\"key\": \"" + clash::pair_key(test.name, model, p.a, p.b) +
         "\", \"test\": " + std::to_string(number) + ", \"a\": ";
  object(out, model, p.a);
  out += ", \"part\": " + std::to_string(p.part_a) + "}, \"b\": ";
  object(out, model, p.b);
  out += ", \"part\": " + std::to_string(p.part_b) + "}, \"class\": \"";
  out += name(p.cls);
  out += "\", \"relation\": \"";
  out += name(p.relation);
  out += "\", \"d_mm\": ";
  append_mm(out, p.d_mm);
  out += ", \"d_range_mm\": [";
  append_range(out, p, ", ");
  out += "]";
  witness(out, p);
  if (p.cls == clash::Class::hit && test.options.volumes == clash::Volumes::on) {
    out += ", \"volume_mm3\": ";
    if (p.volume_mm3)
      append_mm(out, *p.volume_mm3);
    else
      out += "null";
  }
  out += ", \"flags\": [";
  append_flags(out, p, ", ", "\"");
  out += "]}";
}

}  // namespace

void write_clash_json(const Findings& findings, const model::Model& model, Sink sink) {
  Buffered buffer(sink);
  std::string& out = buffer.text();
  out += "{\n\"schema_version\": ";
  out += kSchemaVersion;
  out += ",\n";
  files(out, model);
  out += ",\n";
  tests(out, findings);
  out += ",\n\"hash\": ";
  append_json(out, hash_of(findings));
  out += ",\n";
  const Diagnostics all = findings.all_diagnostics();
  diagnostics(out, all);
  out += ",\n";
  messages(out, all);
  out += ",\n\"results\": [";
  bool first = true;
  for (std::size_t t = 0; t < findings.tests.size(); ++t)
    for (const Pair& pair : findings.tests[t].pairs) {
      out += first ? "\n" : ",\n";
      first = false;
      result(out, model, t, findings.tests[t], pair);
      buffer.done();
    }
  out += "\n]\n}\n";
}

}  // namespace strake::report
