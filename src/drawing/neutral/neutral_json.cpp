// SPDX-License-Identifier: Apache-2.0
// The neutral drawing as JSON: its head, which the binary form shares, and its lines.
#include "drawing/neutral/neutral_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "core/number.hpp"
#include "drawing/buffered_writer.hpp"
#include "drawing/layout/view_title.hpp"
#include "strake/core/version.hpp"
#include "strake/drawing/write.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::drawing {

namespace {

std::string whole_numbers(const geometry::Vec3l& v) {
  return fmt::format("[{},{},{}]", v.x, v.y, v.z);
}

void write_perspective(BufferedWriter& out, const hlr::Perspective& perspective) {
  const geometry::Vec3d eye = geometry::to_mm(perspective.eye);
  const geometry::Vec3d target = geometry::to_mm(perspective.target);
  out << ",\"perspective\":{\"eye_mm\":";
  append_numbers(out.text(), {eye.x, eye.y, eye.z});
  out << ",\"target_mm\":";
  append_numbers(out.text(), {target.x, target.y, target.z});
  out << ",\"near_mm\":" << shortest(perspective.near_mm)
      << ",\"field_of_view_deg\":" << shortest(perspective.field_of_view_deg) << "}";
}

/// Writes which selections sections leave whole, or that they do where nobody says which.
void write_uncut(BufferedWriter& out, const NeutralDrawing& drawing) {
  if (!drawing.uncut) return;
  out << ",\"uncut\":";
  if (drawing.uncut_selections.empty()) out << "true";
  const char* separator = "[";
  for (const std::string& selection : drawing.uncut_selections) {
    out << separator << json_quoted(selection);
    separator = ",";
  }
  if (*separator == ',') out << "]";
}

void write_view(BufferedWriter& out, const NeutralDrawing& drawing) {
  out << "\"view\":{\"name\":" << json_quoted(drawing.view_name) << ",\"projection\":\""
      << (drawing.view.perspective ? "perspective" : "orthographic")
      << "\",\"direction\":" << whole_numbers(drawing.view.direction)
      << ",\"up\":" << whole_numbers(drawing.view.up) << ",\"limits_mm\":";
  if (drawing.view.limits) {
    const geometry::Vec3d lo = geometry::to_mm(drawing.view.limits->lo);
    const geometry::Vec3d hi = geometry::to_mm(drawing.view.limits->hi);
    append_numbers(out.text(), {lo.x, lo.y, lo.z, hi.x, hi.y, hi.z});
  } else {
    out << "null";
  }
  out << ",\"sections\":[";
  for (const hlr::Section& section : drawing.view.sections) {
    const geometry::Vec3d point = geometry::to_mm(section.point);
    out << (&section == drawing.view.sections.data() ? "" : ",")
        << "{\"normal\":" << whole_numbers(section.normal) << ",\"point_mm\":";
    append_numbers(out.text(), {point.x, point.y, point.z});
    out << "}";
  }
  out << "]";
  if (drawing.view.perspective) write_perspective(out, *drawing.view.perspective);
  out << "},\n\"settings\":{\"stage\":\"" << stage_name(drawing.stage)
      << "\",\"hidden_lines\":" << (drawing.hidden_lines ? "true" : "false")
      << ",\"sharp_angle_deg\":" << shortest(drawing.sharp_angle_deg) << ",\"smooth\":\""
      << smooth_name(drawing.smooth) << "\",\"intersections\":\""
      << intersections_name(drawing.intersections) << "\"";
  if (drawing.own_polylines != hlr::OwnPolylines::visible)
    out << ",\"own_polylines\":\"" << own_polylines_name(drawing.own_polylines) << "\"";
  if (!drawing.flush_seams) out << ",\"flush_seams\":\"off\"";
  write_uncut(out, drawing);
  if (drawing.single_line_mm > 0) out << ",\"single_line_mm\":" << shortest(drawing.single_line_mm);
  out << ",\"contact_distance_mm\":" << shortest(drawing.contact_distance_mm);
  if (drawing.sag_mm > 0) out << ",\"sag_mm\":" << shortest(drawing.sag_mm);
  if (drawing.weld_mm >= 0) out << ",\"weld_mm\":" << shortest(drawing.weld_mm);
  out << "},\n\"sheet\":{\"width_mm\":" << shortest(drawing.sheet.width_mm)
      << ",\"height_mm\":" << shortest(drawing.sheet.height_mm)
      << ",\"scale\":" << shortest(drawing.sheet.scale) << ",\"scale_text\":\""
      << drawing.sheet.scale_text << "\"";
  if (drawing.title != title_of(drawing.view_name, drawing.view))
    out << ",\"title\":" << json_quoted(drawing.title);
  if (drawing.frame) {
    out << ",\"frame_paper_mm\":";
    const PaperFrame& frame = *drawing.frame;
    append_numbers(out.text(), {frame.left, frame.top, frame.right, frame.bottom});
  }
  out << "},\n";
}

void write_counts(BufferedWriter& out, const NeutralDrawing& drawing) {
  // Lines are counted that are listed; clipped ones that are not stand apart.
  std::array<std::uint64_t, kLineStates> count = drawing.count;
  const std::uint64_t all = std::accumulate(count.begin(), count.end(), std::uint64_t{0});
  const std::uint64_t clipped_left_out = all - std::min<std::uint64_t>(all, drawing.lines.size());
  count.at(static_cast<std::size_t>(LineState::clipped)) -= clipped_left_out;
  out << fmt::format("\"counts\":{{\"objects\":{}", drawing.account.objects());
  for (std::size_t f = 1; f < hlr::kFates; ++f) {
    const auto fate = static_cast<hlr::Fate>(f);
    out << fmt::format(",\"objects_{}\":{}", fate_name(fate), drawing.account.of(fate));
  }
  out << fmt::format(
      ",\"objects_in_part\":{},\"feature_edges\":{},\"edges_left_out\":{},\"specks\":{},"
      "\"pieces\":{}",
      drawing.account.in_part, drawing.counters.feature_edges, drawing.counters.left_out,
      drawing.counters.specks, drawing.lines.size());
  if (drawing.uncut) out << fmt::format(",\"objects_uncut\":{}", drawing.counters.uncut_objects);
  if (!drawing.flush_seams) out << fmt::format(",\"edges_with_seams\":{}", drawing.counters.seams);
  for (std::size_t s = 0; s < kLineStates; ++s)
    out << fmt::format(",\"{}\":{}", state_name(static_cast<LineState>(s)), count.at(s));
  if (clipped_left_out > 0) out << fmt::format(",\"clipped_left_out\":{}", clipped_left_out);
  out << "},\n";
}

void append_object(std::string& out, const model::Model& model, model::ObjectId id) {
  const model::Object& object = model.object(id);
  out += "{\"id\":" + json_quoted(object.id) + ",\"name\":" + json_quoted(object.name) +
         ",\"file\":" + json_quoted(model.files[object.file].label);
}

void write_curves(BufferedWriter& out, const PaperCurves& curves) {
  out << "\"curves\":[";
  const char* separator = "\n";
  for (const PaperCurve& curve : curves.all) {
    out << separator << "{\"centre_paper_mm\":";
    append_numbers(out.text(), {curve.centre.x, curve.centre.y});
    out << ",\"u_paper_mm\":";
    append_numbers(out.text(), {curve.u.x, curve.u.y});
    out << ",\"v_paper_mm\":";
    append_numbers(out.text(), {curve.v.x, curve.v.y});
    out << "}";
    separator = ",\n";
  }
  out << "],\n";
}

/// Writes the objects of which something could not be drawn, each with all reasons.
void write_defects(BufferedWriter& out, const NeutralDrawing& drawing, const model::Model& model) {
  const std::vector<hlr::Defect>& defects = drawing.account.defects;
  out << "\"defects\":[";
  for (std::size_t d = 0; d < defects.size();) {
    const model::ObjectId id = defects[d].object;
    out << (d == 0 ? "\n" : ",\n");
    append_object(out.text(), model, id);
    out << ",\"fate\":\"" << fate_name(drawing.account.fates[model::index(id)]) << "\",\"why\":";
    const char* separator = "[";
    for (; d < defects.size() && defects[d].object == id; ++d, separator = ",")
      out << separator << json_quoted(defects[d].code);
    out << "]}";
  }
  out << "],\n";
}

/// Writes the objects that were left out because they lie far from all others, where there are
/// such.
void write_far_left_out(BufferedWriter& out, const NeutralDrawing& drawing,
                        const model::Model& model) {
  const char* separator = "\"far_objects\":[\n";
  for (const model::ObjectId object : drawing.far_left_out) {
    out << separator;
    append_object(out.text(), model, object);
    out << "}";
    separator = ",\n";
  }
  if (!drawing.far_left_out.empty()) out << "],\n";
}

/// Writes the files that end early, whose further contents are unknown, where there are such.
void write_cut_files(BufferedWriter& out, const model::Model& model) {
  const char* separator = "\"files_ending_early\":[";
  for (const model::SourceFile& file : model.files) {
    if (!file.ends_early) continue;
    out << separator << json_quoted(file.label);
    separator = ",";
  }
  if (*separator == ',') out << "],\n";
}

}  // namespace

void append_numbers(std::string& out, std::initializer_list<double> values) {
  const char* separator = "[";
  for (const double value : values) {
    out += separator;
    append_shortest(out, value);
    separator = ",";
  }
  out += ']';
}

ListedObjects::ListedObjects(const std::vector<Line>& lines, std::size_t objects)
    : number_(objects, kNot) {
  for (const Line& line : lines)
    for (const model::ObjectId id : {line.object, line.other}) number_[model::index(id)] = 0;
  for (std::uint32_t o = 0; o < number_.size(); ++o) {
    if (number_[o] == kNot) continue;
    number_[o] = static_cast<std::uint32_t>(objects_.size());
    objects_.push_back(model::ObjectId{o});
  }
}

void write_view_head(BufferedWriter& out, const NeutralDrawing& drawing, const model::Model& model,
                     const ListedObjects& listed) {
  out << "{\"schema_version\":1,\n\"generator\":{\"name\":\"strake\",\"version\":"
      << json_quoted(version()) << "},\n";
  write_view(out, drawing);
  write_counts(out, drawing);
  write_defects(out, drawing, model);
  write_far_left_out(out, drawing, model);
  write_cut_files(out, model);
  out << "\"hash\":\"" << drawing.hash.text() << "\",\n\"objects\":[";
  for (const model::ObjectId o : listed.objects()) {
    out << (listed.number(o) == 0 ? "\n" : ",\n");
    append_object(out.text(), model, o);
    out << "}";
  }
  out << "],\n";
  write_curves(out, drawing.curves);
}

namespace {

void append_line(std::string& out, const Line& line, std::string_view object, std::uint32_t curve,
                 const ListedObjects& listed) {
  out += "{\"object\":";
  out += object;
  fmt::format_to(
      std::back_inserter(out), ",\"object_index\":{},\"edge\":{},\"kind\":\"{}\",\"state\":\"{}\"",
      listed.number(line.object), line.edge, kind_name(line.kind), state_name(line.state));
  if (line.kind == hlr::EdgeKind::intersection)
    fmt::format_to(std::back_inserter(out), ",\"other_index\":{}", listed.number(line.other));
  if (curve != PaperCurves::kNone)
    fmt::format_to(std::back_inserter(out), ",\"curve_index\":{}", curve);
  out += ",\"a_mm\":";
  append_numbers(out, {line.a_mm.x, line.a_mm.y, line.a_mm.z});
  out += ",\"b_mm\":";
  append_numbers(out, {line.b_mm.x, line.b_mm.y, line.b_mm.z});
  out += ",\"a_paper_mm\":";
  append_numbers(out, {line.a_paper.x, line.a_paper.y});
  out += ",\"b_paper_mm\":";
  append_numbers(out, {line.b_paper.x, line.b_paper.y});
  out += '}';
}

}  // namespace

Status write_view_json(const NeutralDrawing& drawing, const model::Model& model, Sink sink,
                       const parallel::Context& context) {
  const ListedObjects listed(drawing.lines, model.objects.size());
  {
    BufferedWriter out(sink);
    write_view_head(out, drawing, model, listed);
    out << "\"pieces\":[";
  }
  const auto encode = [&](std::size_t begin, std::size_t end, std::string& out) {
    std::string id;
    for (std::size_t i = begin; i < end; ++i) {
      const Line& line = drawing.lines[i];
      if (i == begin || drawing.lines[i - 1].object != line.object)
        id = json_quoted(model.object(line.object).id);
      out += i == 0 ? "\n" : ",\n";
      append_line(out, line, id, drawing.curves.index_of(line), listed);
    }
  };
  const Status status =
      write_in_batches("neutral drawing", drawing.lines.size(), encode, sink, context);
  if (!status) return status;
  sink("]}\n");
  return {};
}

}  // namespace strake::drawing
