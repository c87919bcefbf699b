// SPDX-License-Identifier: Apache-2.0
#include "project/changes/change_writers.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "report/files/file_match_output.hpp"
#include "report/json/json_writer.hpp"
#include "report/text/csv.hpp"
#include "report/text/formatting.hpp"

namespace strake::project {
namespace {

constexpr std::array kChangeWriters{
    ChangeWriter{{".json", " as {}"}, write_changes_json},
    ChangeWriter{{".csv", " or {}"}, write_changes_csv},
};

/// Returns the kinds of a change, in their order.
std::vector<ChangeKind> kinds_in(const ObjectChange& change) {
  std::vector<ChangeKind> kinds;
  for (std::size_t k = 0; k < kChangeKinds; ++k)
    if (const auto kind = static_cast<ChangeKind>(k); change.is(kind)) kinds.push_back(kind);
  return kinds;
}

/// Whether an object that is in both models was called otherwise.
bool had_another_name(const ObjectChange& change) {
  return change.then != ObjectChange::kNone && change.now != ObjectChange::kNone &&
         change.before != change.after;
}

void append_change_counts(std::string& out, const Changes& changes) {
  out += "  \"counts\": {";
  for (std::size_t k = 0; k < kChangeKinds; ++k) {
    report::append_key(out, change_name(static_cast<ChangeKind>(k)));
    out += std::to_string(changes.counts[k]) + ", ";
  }
  out += "\"unchanged\": " + std::to_string(changes.unchanged) + "}";
}

void append_labels(std::string& out, std::string_view name,
                   const std::vector<std::string>& labels) {
  out += ",\n  ";
  report::append_list(out, name, labels,
                      [&](const std::string& label) { report::append_json(out, label); });
}

void append_change(std::string& out, const ObjectChange& change) {
  const ObjectChange::Name& name = change.name();
  out += '{';
  report::append_list(out, "kinds", kinds_in(change),
                      [&](ChangeKind kind) { report::append_json(out, change_name(kind)); });
  out += ", ";
  report::append_identity(out, name.id, name.name, name.file);
  if (had_another_name(change)) {
    out += ", \"was\": {";
    report::append_identity(out, change.before.id, change.before.name, change.before.file);
    out += '}';
  }
  out += '}';
}

}  // namespace

std::span<const ChangeWriter> change_writers() { return kChangeWriters; }

void write_changes_json(const Changes& changes, report::Sink sink) {
  report::BufferedWriter out(sink);
  std::string& text = out.text();
  text += "{\n  \"schema_version\": 1,\n";
  append_change_counts(text, changes);
  report::append_file_matches(text, changes.files);
  append_labels(text, "files_added", changes.files.only_after);
  append_labels(text, "files_removed", changes.files.only_before);
  text += ",\n  \"changes\": [";
  for (std::size_t c = 0; c < changes.objects.size(); ++c) {
    text += c == 0 ? "\n    " : ",\n    ";
    append_change(text, changes.objects[c]);
    out.done();
  }
  text += changes.objects.empty() ? "]\n}\n" : "\n  ]\n}\n";
}

void write_changes_csv(const Changes& changes, report::Sink sink) {
  report::BufferedWriter out(sink);
  const report::CsvForm form;
  report::CsvRow head(out.text(), form);
  for (const char* const column :
       {"change", "file", "id", "name", "file_before", "id_before", "name_before"})
    head.word(column);
  head.end();
  for (const ObjectChange& change : changes.objects)
    for (const ChangeKind kind : kinds_in(change)) {
      report::CsvRow row(out.text(), form);
      const ObjectChange::Name& name = change.name();
      row.word(change_name(kind)).text(name.file).text(name.id).text(name.name);
      if (had_another_name(change))
        row.text(change.before.file).text(change.before.id).text(change.before.name);
      else
        row.blank(3);
      row.end();
      out.done();
    }
}

}  // namespace strake::project
