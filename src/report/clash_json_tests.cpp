// SPDX-License-Identifier: Apache-2.0
#include "report/clash_json_tests.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "report/elements.hpp"
#include "report/json_fields.hpp"
#include "report/text.hpp"

namespace strake::report {
namespace {

using clash::Report;

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
  if (report.weld_mm >= 0) {
    out += ", \"weld_mm\": ";
    append_mm(out, report.weld_mm);
  }
  out += ", \"curves\": ";
  out += report.options.curves == clash::Curves::on ? "true}" : "false}";
}

void sets(std::string& out, const Report& report) {
  out += "\"sets\": {\"a\": ";
  append_json(out, report.set_a);
  out += ", \"b\": ";
  append_json(out, report.set_b);
  out += "}, \"objects\": {\"a\": " + std::to_string(report.objects_a) +
         ", \"b\": " + std::to_string(report.objects_b) + "}";
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
           ", \"places\": " + std::to_string(rule.places) + "}";
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

/// Who was set against whom, so that a later run can tell what is gone from what was not looked at.
void tested(std::string& out, const Report& report, const Elements& elements) {
  out += "\"tested\": {\"a\": \"";
  elements.append_members(out, report.in_a);
  out += "\", \"b\": \"";
  elements.append_members(out, report.in_b);
  out += "\", \"within_files\": ";
  out += report.within_files ? "true}" : "false}";
}

/// What Report::sheets of any test says of each object: each knows those of its own sets.
std::vector<std::uint8_t> sheets(const clash::Findings& findings) {
  std::vector<std::uint8_t> all;
  for (const Report& test : findings.tests) {
    all.resize(std::max(all.size(), test.sheets.size()), 0);
    for (std::size_t o = 0; o < test.sheets.size(); ++o) all[o] = std::max(all[o], test.sheets[o]);
  }
  return all;
}

/// Which objects have such ids; empty: none.
std::vector<bool> positional_ids(const model::Model& model) {
  const auto positional = [](const model::Object& o) { return o.positional_id; };
  if (std::ranges::none_of(model.objects, positional)) return {};
  std::vector<bool> ids;
  ids.reserve(model.objects.size());
  for (const model::Object& o : model.objects) ids.push_back(positional(o));
  return ids;
}

void test(std::string& out, const Report& report, const Elements& elements) {
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

}  // namespace

void append_tests(std::string& out, const clash::Findings& findings, const model::Model& model) {
  const Elements elements(model);
  out += "\"elements\": \"";
  elements.append_list(out);
  out += "\",\n\"sheets\": \"";
  elements.append_bytes(out, sheets(findings));
  out += "\",\n";
  if (const std::vector<bool> ids = positional_ids(model); !ids.empty()) {
    out += "\"positional_ids\": \"";
    elements.append_members(out, ids);
    out += "\",\n";
  }
  append_list(
      out, "tests", findings.tests, [&](const Report& report) { test(out, report, elements); },
      "\n  ");
}

}  // namespace strake::report
