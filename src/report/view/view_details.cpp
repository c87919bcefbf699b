// SPDX-License-Identifier: Apache-2.0
#include "report/view/view_details.hpp"

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "report/document/document_reader.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::report {

namespace {

using Kind = JsonReader::Kind;

drawing::PaperPoint paper_point(const std::array<double, 2>& mm) { return {mm[0], mm[1]}; }

std::string place_in(std::string_view list, std::size_t number) {
  return std::string(list) + "[" + std::to_string(number) + "]";
}

}  // namespace

void ViewDetails::add(const ReadPiece& piece, std::string_view list_item) {
  const auto where = [&] { return std::string(list_item) + " " + std::to_string(lines.size()); };
  if (piece.edge == ReadPiece::kNone) throw missing_key(where(), "edge");
  const drawing::Line line{model::ObjectId{piece.object},
                           piece.edge,
                           piece.kind,
                           piece.state,
                           model::ObjectId{piece.other},
                           geometry::to_mm(piece.a),
                           geometry::to_mm(piece.b),
                           paper_point(piece.a_paper),
                           paper_point(piece.b_paper)};
  const auto key = [](const auto& l) { return std::pair(l.object, l.edge); };
  if (!lines.empty() && key(line) < key(lines.back()))
    throw contradiction(where(), "is not in order of objects and edges");
  lines.push_back(line);
  if (piece.curve == ReadPiece::kNone) return;
  const bool is_known = !curves.edges.empty() && key(curves.edges.back()) == key(line);
  if (!is_known) curves.edges.push_back({line.object, line.edge, piece.curve});
  if (curves.edges.back().curve != piece.curve)
    throw contradiction(where(), "is of another curve than its edge");
}

void read_curves(JsonReader& json, ViewDetails& details) {
  DocumentFields fields(json);
  fields.must_be(Kind::array, "the document", "curves", "list");
  json.items([&] {
    const std::size_t number = details.curves.all.size();
    const auto where = [number] { return place_in("curves", number); };
    if (json.kind() != Kind::object) throw DocumentFault{where(), "is no object"};
    drawing::PaperCurve curve;
    std::array<std::pair<std::string_view, drawing::PaperPoint*>, 3> points{
        {{"centre_paper_mm", &curve.centre}, {"u_paper_mm", &curve.u}, {"v_paper_mm", &curve.v}}};
    json.members([&](std::string_view key) {
      for (auto& [name, into] : points) {
        if (into == nullptr || key != name) continue;
        *into = paper_point(fields.numbers<2>(where, name, DocumentFields::kFarthestMm));
        into = nullptr;
        return;
      }
      json.skip();
    });
    for (const auto& [name, into] : points)
      if (into != nullptr) throw missing_key(where(), name);
    details.curves.all.push_back(curve);
  });
}

void read_defects(JsonReader& json, ViewDetails& details) {
  DocumentFields fields(json);
  fields.must_be(Kind::array, "the document", "defects", "list");
  json.items([&] {
    const std::string where = place_in("defects", details.defects.size());
    if (json.kind() != Kind::object) throw DocumentFault{where, "is no object"};
    ViewDefect defect;
    json.members([&](std::string_view key) {
      const std::string name(key);
      if (name == "id")
        defect.object.id = fields.text(where, name);
      else if (name == "name")
        defect.object.name = fields.text(where, name);
      else if (name == "file")
        defect.object.file = fields.text(where, name);
      else if (name == "fate")
        defect.fate = fields.text(where, name);
      else if (name == "why" && json.kind() == Kind::array)
        json.items([&] { defect.why.push_back(fields.text(where, name)); });
      else
        json.skip();
    });
    details.defects.push_back(std::move(defect));
  });
}

void read_cut_files(JsonReader& json, ViewDetails& details) {
  DocumentFields fields(json);
  fields.must_be(Kind::array, "the document", "files_ending_early", "list");
  json.items(
      [&] { details.cut_files.push_back(fields.text("the document", "files_ending_early")); });
}

drawing::PaperFrame read_frame(JsonReader& json) {
  const auto mm = DocumentFields(json).numbers<4>([] { return std::string("sheet"); },
                                                  "frame_paper_mm", drawing::kFarthestPaperMm);
  return {mm[0], mm[1], mm[2], mm[3]};
}

}  // namespace strake::report
