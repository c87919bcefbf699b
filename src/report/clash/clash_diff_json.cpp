// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "report/files/file_match_output.hpp"
#include "report/json/json_writer.hpp"
#include "report/text/formatting.hpp"
#include "strake/report/clash_diff.hpp"

namespace strake::report {
namespace {

constexpr std::string_view kClashDiffVersion = "1";

void object(std::string& out, const DocumentObject& o) {
  out += '{';
  append_identity(out, o.id, o.name, o.file);
  out += '}';
}

void measured(std::string& out, const ClashDocument& run, const DocumentResult& r) {
  out += "\"class\": ";
  append_json(out, clash::name(r.cls));
  if (!run.allowed(r).empty()) {
    out += ", \"allowed\": ";
    append_json(out, run.allowed(r));
  }
  out += ", \"d_mm\": ";
  append_mm(out, r.d_mm);
  if (!r.depth_complete) out += ", \"depth_complete\": false";
  if (r.regions > 0) out += ", \"region_count\": " + std::to_string(r.regions);
  if (r.allowed_regions > 0)
    out += ", \"allowed_region_count\": " + std::to_string(r.allowed_regions);
}

void entry(std::string& out, const ClashDiff& diff, const std::vector<DiffEntry>& list,
           const DiffEntry& e) {
  const DocumentResult& r = e.either();
  const ClashDocument& run = diff.run_of(e);
  out += "{\"key\": \"" + clash::key_text(r.key) + "\", \"test\": ";
  append_json(out, run.tests[r.test].name);
  out += ", \"a\": ";
  object(out, run.a(r));
  out += ", \"b\": ";
  object(out, run.b(r));
  out += ", ";
  measured(out, run, r);
  if (e.before != nullptr && e.after != nullptr) {
    out += ", \"was\": {";
    if (e.before->key != r.key) out += "\"key\": \"" + clash::key_text(e.before->key) + "\", ";
    measured(out, *diff.before, *e.before);
    out += "}";
  } else if (&list == &diff.cannot_tell) {
    out += e.after != nullptr ? ", \"run\": \"new\"" : ", \"run\": \"old\"";
  }
  if (!e.why.empty()) {
    out += ", \"why\": ";
    append_json(out, e.why);
  }
  out += "}";
}

void entries(BufferedWriter& buffer, const ClashDiff& diff, std::string_view name,
             const std::vector<DiffEntry>& list) {
  std::string& out = buffer.text();
  out += ",\n";
  append_list(
      out, name, list,
      [&](const DiffEntry& e) {
        entry(out, diff, list, e);
        buffer.done();
      },
      "\n  ");
}

void strings(std::string& out, std::string_view name, const std::vector<std::string>& list) {
  out += ",\n";
  append_list(out, name, list, [&](const std::string& text) { append_json(out, text); });
}

void run(std::string& out, std::string_view name, const ClashDocument& document) {
  out += ",\n";
  append_key(out, name);
  out += "{\"file\": ";
  append_json(out, document.name);
  out += ", \"hash\": ";
  append_json(out, document.hash);
  if (!document.made_by.file.empty()) {
    out += ", \"rules\": {\"file\": ";
    append_json(out, document.made_by.file);
    out += ", \"hash\": ";
    append_json(out, document.made_by.hash);
    if (!document.made_by.profile.empty()) {
      out += ", \"profile\": ";
      append_json(out, document.made_by.profile);
    }
    out += "}";
  }
  out += ", \"results\": " + std::to_string(document.results.size()) + "}";
}

void settings(std::string& out, const ClashDiff& diff) {
  out += ",\n";
  append_list(
      out, "settings_changed", diff.settings,
      [&](const SettingChange& s) {
        out += "{\"test\": ";
        append_json(out, s.test);
        out += ", \"setting\": ";
        append_json(out, s.setting);
        // Values are JSON already.
        out += ", \"old\": " + (s.before.empty() ? "null" : s.before);
        out += ", \"new\": " + (s.after.empty() ? "null" : s.after) + "}";
      },
      "\n  ");
}

void counts(std::string& out, const ClashDiff& diff) {
  out += ",\n\"counts\": {\"new\": " + std::to_string(diff.added.size()) +
         ", \"changed\": " + std::to_string(diff.changed.size()) +
         ", \"same\": " + std::to_string(diff.same.size()) +
         ", \"gone\": " + std::to_string(diff.gone.size()) +
         ", \"cannot_tell\": " + std::to_string(diff.cannot_tell.size()) + "}";
}

}  // namespace

void write_clash_diff_json(const ClashDiff& diff, Sink sink) {
  BufferedWriter buffer(sink);
  std::string& out = buffer.text();
  out += "{\n\"schema_version\": ";
  out += kClashDiffVersion;
  run(out, "old", *diff.before);
  run(out, "new", *diff.after);
  append_file_matches(out, diff.files);
  settings(out, diff);
  strings(out, "tests_added", diff.tests_added);
  strings(out, "tests_gone", diff.tests_gone);
  counts(out, diff);
  const std::array<std::pair<std::string_view, const std::vector<DiffEntry>*>, 5> lists{
      {{"added", &diff.added},
       {"changed", &diff.changed},
       {"gone", &diff.gone},
       {"cannot_tell", &diff.cannot_tell},
       {"same", &diff.same}}};
  for (const auto& [name, list] : lists) entries(buffer, diff, name, *list);
  out += "\n}\n";
}

}  // namespace strake::report
