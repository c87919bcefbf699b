// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "report/files/file_match_output.hpp"
#include "report/json/json_writer.hpp"
#include "report/text/formatting.hpp"
#include "strake/core/version.hpp"
#include "strake/report/view_diff.hpp"

namespace strake::report {
namespace {

constexpr std::string_view kViewDiffVersion = "1";

void file(std::string& out, std::string_view name, const ViewDocument& document) {
  append_key(out, name);
  out += "{\"file\": ";
  append_json(out, document.name);
  out += ", \"hash\": ";
  append_json(out, document.hash);
  out += '}';
}

void count(std::string& out, const LineCount& count) {
  out += "{\"lines\": " + std::to_string(count.lines) + ", \"length_mm\": ";
  append_mm(out, count.length_mm);
  out += '}';
}

/// Writes which lines are new and gone because their objects were left out as far from all others,
/// where there are such.
void left_out(std::string& out, const ViewDiff& diff) {
  if (diff.gone_left_out.lines + diff.new_left_out.lines == 0) return;
  out += ",\n\"left_out\": {\"new\": ";
  count(out, diff.new_left_out);
  out += ", \"gone\": ";
  count(out, diff.gone_left_out);
  out += '}';
}

void counts(std::string& out, const LineCounts& counts) {
  std::string_view between = "{";
  for (const LineChange change :
       {LineChange::added, LineChange::gone, LineChange::changed, LineChange::same}) {
    out += between;
    append_key(out, change_name(change));
    count(out, counts.at(static_cast<std::size_t>(change)));
    between = ", ";
  }
  out += '}';
}

void object(std::string& out, const ViewObject& o) {
  out += '{';
  append_identity(out, o.id, o.name, o.file);
  out += '}';
}

void line_class(std::string& out, const ViewDiff& diff, const DiffLineClass& cls) {
  append_key(out, "object");
  object(out, *diff.objects[cls.object]);
  out += ", \"kind\": ";
  append_json(out, drawing::kind_name(cls.kind));
  out += ", \"state\": ";
  append_json(out, drawing::state_name(cls.state));
  if (cls.other == cls.object) return;
  out += ", \"other\": ";
  object(out, *diff.objects[cls.other]);
}

void point(std::string& out, const ViewPiece& piece, float at) {
  const geometry::Vec3d along = (piece.b - piece.a).as<double>();
  out += '[';
  for (int k = 0; k < 3; ++k) {
    if (k > 0) out += ", ";
    append_mm(
        out,
        (static_cast<double>(piece.a[k]) + std::round(along[k] * static_cast<double>(at))) / 1000);
  }
  out += ']';
}

void line(std::string& out, const ViewDiff& diff, const DiffInterval& s) {
  out += "{\"change\": ";
  append_json(out, change_name(s.change));
  out += ", ";
  line_class(out, diff, diff.line_class(s));
  if (s.change == LineChange::changed) {
    out += ", \"was\": {";
    line_class(out, diff, s.was);
    out += '}';
  }
  out += ", \"a_mm\": ";
  point(out, diff.piece(s), s.from);
  out += ", \"b_mm\": ";
  point(out, diff.piece(s), s.to);
  out += '}';
}

}  // namespace

void write_view_diff_json(const ViewDiff& diff, Sink sink) {
  BufferedWriter buffer(sink);
  std::string& out = buffer.text();
  out += "{\"schema_version\": ";
  out += kViewDiffVersion;
  out += ", \"generator\": {\"name\": \"strake\", \"version\": ";
  append_json(out, version());
  out += "},\n";
  file(out, "before", *diff.before);
  out += ",\n";
  file(out, "after", *diff.after);
  append_file_matches(out, diff.files);
  out += ",\n\"tolerance_mm\": ";
  append_mm(out, diff.tolerance_mm);
  out += ",\n";
  append_list(out, "settings", diff.settings, [&](const ViewSettingChange& change) {
    std::string_view between = "{";
    for (const auto& [key, value] :
         {std::pair<std::string_view, const std::string&>("setting", change.setting),
          {"before", change.before},
          {"after", change.after}}) {
      out += between;
      append_key(out, key);
      append_json(out, value);
      between = ", ";
    }
    out += '}';
  });
  out += ",\n\"counts\": ";
  counts(out, diff.total);
  left_out(out, diff);
  out += ",\n";
  append_list(
      out, "classes", diff.by_class,
      [&](const auto& of) {
        out += "{\"kind\": ";
        append_json(out, drawing::kind_name(of.first.first));
        out += ", \"state\": ";
        append_json(out, drawing::state_name(of.first.second));
        out += ", \"counts\": ";
        counts(out, of.second);
        out += '}';
      },
      "\n  ");
  out += ",\n";
  append_list(
      out, "objects", diff.by_object,
      [&](const auto& of) {
        const ViewObject& o = *diff.objects[of.first];
        out += '{';
        append_identity(out, o.id, o.name, o.file);
        out += ", \"counts\": ";
        counts(out, of.second);
        out += '}';
        buffer.done();
      },
      "\n  ");
  out += ",\n\"lines\": [";
  std::string_view between = "\n  ";
  for (const DiffInterval& s : diff.intervals) {
    if (s.change == LineChange::same) continue;
    out += between;
    between = ",\n  ";
    line(out, diff, s);
    buffer.done();
  }
  out += "]}\n";
}

}  // namespace strake::report
