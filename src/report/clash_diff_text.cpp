// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "report/text.hpp"
#include "strake/clash/identity.hpp"
#include "strake/core/number.hpp"
#include "strake/core/text.hpp"
#include "strake/report/clash_diff.hpp"

namespace strake::report {
namespace {

constexpr std::string_view kSchemaVersion = "1";

void object(std::string& out, const DocumentObject& o) {
  out += "{\"id\": ";
  append_json(out, o.id);
  out += ", \"name\": ";
  append_json(out, o.name);
  out += ", \"file\": ";
  append_json(out, o.file);
  out += "}";
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
  if (r.regions > 0) out += ", \"region_count\": " + std::to_string(r.regions);
}

void entry(std::string& out, const ClashDiff& diff, const DiffEntry& e) {
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
    measured(out, *diff.before, *e.before);
    out += "}";
  }
  if (!e.why.empty()) {
    out += ", \"why\": ";
    append_json(out, e.why);
  }
  out += "}";
}

void entries(Buffered& buffer, const ClashDiff& diff, std::string_view name,
             const std::vector<DiffEntry>& list) {
  std::string& out = buffer.text();
  out += ",\n";
  append_json(out, name);
  out += ": [";
  for (std::size_t i = 0; i < list.size(); ++i) {
    out += i == 0 ? "\n  " : ",\n  ";
    entry(out, diff, list[i]);
    buffer.done();
  }
  out += "]";
}

void strings(std::string& out, std::string_view name, const std::vector<std::string>& list) {
  out += ",\n";
  append_json(out, name);
  out += ": [";
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) out += ", ";
    append_json(out, list[i]);
  }
  out += "]";
}

void run(std::string& out, std::string_view name, const ClashDocument& document) {
  out += ",\n";
  append_json(out, name);
  out += ": {\"file\": ";
  append_json(out, document.name);
  out += ", \"hash\": ";
  append_json(out, document.hash);
  if (!document.made_by.file.empty()) {
    out += ", \"rules\": {\"file\": ";
    append_json(out, document.made_by.file);
    out += ", \"hash\": ";
    append_json(out, document.made_by.hash);
    out += "}";
  }
  out += ", \"results\": " + std::to_string(document.results.size()) + "}";
}

void settings(std::string& out, const ClashDiff& diff) {
  out += ",\n\"settings_changed\": [";
  for (std::size_t i = 0; i < diff.settings.size(); ++i) {
    const SettingChange& s = diff.settings[i];
    out += i == 0 ? "\n  {\"test\": " : ",\n  {\"test\": ";
    append_json(out, s.test);
    out += ", \"setting\": ";
    append_json(out, s.setting);
    // Values are JSON already.
    out += ", \"old\": " + (s.before.empty() ? "null" : s.before);
    out += ", \"new\": " + (s.after.empty() ? "null" : s.after) + "}";
  }
  out += "]";
}

void counts(std::string& out, const ClashDiff& diff) {
  out += ",\n\"counts\": {\"new\": " + std::to_string(diff.added.size()) +
         ", \"changed\": " + std::to_string(diff.changed.size()) +
         ", \"same\": " + std::to_string(diff.same.size()) +
         ", \"gone\": " + std::to_string(diff.gone.size()) +
         ", \"cannot_tell\": " + std::to_string(diff.cannot_tell.size()) + "}";
}

std::string_view short_name(clash::Class cls) {
  return cls == clash::Class::clearance_violation ? std::string_view("CLEARANCE")
                                                  : clash::name(cls);
}

std::string told(const ClashDocument& run, const DocumentResult& r, bool with_places) {
  std::string out = std::string(short_name(r.cls)) + " " + fixed(r.d_mm, 3);
  if (with_places)
    out += " at " + std::to_string(r.regions) + (r.regions == 1 ? " place" : " places");
  if (const std::string& rule = run.allowed(r); !rule.empty())
    out += ", allowed by " + printable(rule);
  return out;
}

/// "HIT -12.000", "HIT -12.000 (was CONTACT 0.000)"; with the number of places where that changed.
std::string change(const ClashDiff& diff, const DiffEntry& e) {
  const bool both = e.before != nullptr && e.after != nullptr;
  const bool places = both && more_places(*e.before, *e.after) != 0;
  const std::string is = told(diff.run_of(e), e.either(), places);
  return both ? is + " (was " + told(*diff.before, *e.before, places) + ")" : is;
}

std::string_view label(const DocumentObject& o) { return o.name.empty() ? o.id : o.name; }

std::string block(std::string_view title, const ClashDiff& diff, const std::vector<DiffEntry>& list,
                  const TableOptions& options) {
  if (list.empty()) return {};
  constexpr std::size_t kLeast = 8, kChange = 34;
  const std::size_t room = options.width > kChange + 6 ? (options.width - kChange - 6) / 2 : kLeast;
  const std::size_t names = std::max(kLeast, room);
  std::string out = std::string(title) + " (" + std::to_string(list.size()) + ")\n";
  const std::size_t shown = std::min(options.rows, list.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const ClashDocument& run = diff.run_of(list[i]);
    const DocumentResult& r = list[i].either();
    out += "  " + fitted(label(run.a(r)), names) + "  " + fitted(label(run.b(r)), names) + "  " +
           change(diff, list[i]) + "\n";
    const bool told = i > 0 && list[i].why == list[i - 1].why;
    if (!list[i].why.empty() && !told) out += "      " + printable(list[i].why) + "\n";
  }
  if (shown < list.size()) out += "  … and " + std::to_string(list.size() - shown) + " more\n";
  return out + "\n";
}

std::string in_test(const std::string& name) {
  return name.empty() ? std::string() : " of test '" + printable(name) + "'";
}

/// Where the two runs were not made by the same rules.
std::string rules_text(const DocumentRules& before, const DocumentRules& after) {
  if (before == after) return {};
  const auto name = [](const DocumentRules& rules) {
    return rules.file.empty() ? std::string("none") : printable(rules.file);
  };
  if (before.file == after.file) return "rules file " + name(after) + " is not what it was\n";
  return "rules file: was " + name(before) + ", is " + name(after) + "\n";
}

std::string settings_text(const ClashDiff& diff) {
  std::string out = rules_text(diff.before->made_by, diff.after->made_by);
  for (const SettingChange& s : diff.settings)
    out += "setting " + printable(s.setting) + in_test(s.test) + ": was " +
           (s.before.empty() ? "absent" : printable(s.before)) + ", is " +
           (s.after.empty() ? "absent" : printable(s.after)) + "\n";
  for (const std::string& name : diff.tests_gone)
    out += "test '" + printable(name) + "' is only in the old run\n";
  for (const std::string& name : diff.tests_added)
    out += "test '" + printable(name) + "' is only in the new run\n";
  return out.empty() ? out : out + "\n";
}

}  // namespace

void write_clash_diff_json(const ClashDiff& diff, Sink sink) {
  Buffered buffer(sink);
  std::string& out = buffer.text();
  out += "{\n\"schema_version\": ";
  out += kSchemaVersion;
  run(out, "old", *diff.before);
  run(out, "new", *diff.after);
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

std::string clash_diff_table(const ClashDiff& diff, const TableOptions& options) {
  const std::string out =
      settings_text(diff) + block("new", diff, diff.added, options) +
      block("still there, changed", diff, diff.changed, options) +
      block("gone", diff, diff.gone, options) +
      block("cannot tell: not looked at again", diff, diff.cannot_tell, options);
  return out + std::to_string(diff.added.size()) + " new, " + std::to_string(diff.changed.size()) +
         " changed, " + std::to_string(diff.same.size()) + " unchanged, " +
         std::to_string(diff.gone.size()) + " gone, " + std::to_string(diff.cannot_tell.size()) +
         " cannot tell\n";
}

}  // namespace strake::report
