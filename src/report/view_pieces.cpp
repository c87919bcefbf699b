// SPDX-License-Identifier: Apache-2.0
#include "report/view_pieces.hpp"

#include <cmath>

#include "strake/geometry/grid.hpp"

namespace strake::report {
namespace {

using Kind = JsonReader::Kind;

constexpr std::uint32_t kNone = 0xffffffffU;

}  // namespace

std::string ViewPieceReader::here() const {
  return "pieces[" + std::to_string(pieces_.size()) + "]";
}

void ViewPieceReader::take() {
  if (json_.kind() != Kind::object) throw DocumentFault{here(), "is no object"};
  ViewPiece piece;
  piece.object = piece.other = kNone;
  there_ = {};
  json_.members([&](std::string_view key) { member(key, piece); });
  constexpr std::array<const char*, kMembers> kKeys{
      "object_index", "kind", "state", "a_mm", "b_mm", "a_paper_mm", "b_paper_mm"};
  for (std::size_t i = 0; i < kMembers; ++i)
    if (!there_.at(i)) throw lacks(here(), kKeys.at(i));
  if (piece.kind == hlr::EdgeKind::intersection && piece.other == kNone)
    throw lacks(here(), "other_index");
  if (piece.kind != hlr::EdgeKind::intersection) piece.other = piece.object;
  pieces_.push_back(piece);
}

void ViewPieceReader::member(std::string_view key, ViewPiece& piece) {
  if (key == "object_index") {
    piece.object = index("object_index");
    there_[0] = true;
  } else if (key == "other_index") {
    piece.other = index("other_index");
  } else if (key == "kind") {
    if (json_.kind() != Kind::string) throw is_not(here(), "kind", "text");
    const auto kind = named<hlr::EdgeKind>(json_.text(), drawing::kind_name);
    if (!kind) throw is_not(here(), "kind", "kind of line that this version knows");
    piece.kind = *kind;
    there_[1] = true;
  } else if (key == "state") {
    if (json_.kind() != Kind::string) throw is_not(here(), "state", "text");
    const auto state = named<drawing::LineState>(json_.text(), drawing::state_name);
    if (!state) throw is_not(here(), "state", "state that this version knows");
    piece.state = *state;
    there_[2] = true;
  } else if (key == "a_mm" || key == "b_mm") {
    (key[0] == 'a' ? piece.a : piece.b) = model_point(key[0] == 'a' ? "a_mm" : "b_mm");
  } else if (key == "a_paper_mm" || key == "b_paper_mm") {
    (key[0] == 'a' ? piece.a_paper : piece.b_paper) =
        paper_point(key[0] == 'a' ? "a_paper_mm" : "b_paper_mm");
  } else {
    json_.skip();
  }
}

std::uint32_t ViewPieceReader::index(const char* key) {
  const double value = json_.kind() == Kind::number ? json_.number() : -1;
  if (!(value >= 0 && value < kNone) || value != std::floor(value))
    throw is_not(here(), key, "number of an object");
  return static_cast<std::uint32_t>(value);
}

geometry::Vec3l ViewPieceReader::model_point(const char* key) {
  const auto mm = fields_.numbers<3>([this] { return here(); }, key, DocumentFields::kFarthestMm);
  there_[key[0] == 'a' ? 3 : 4] = true;
  const auto um = [](double v) {
    return static_cast<std::int64_t>(std::llround(v * geometry::kGridPerMm));
  };
  return {um(mm[0]), um(mm[1]), um(mm[2])};
}

std::array<float, 2> ViewPieceReader::paper_point(const char* key) {
  const auto mm = fields_.numbers<2>([this] { return here(); }, key, drawing::kFarthestPaperMm);
  there_[key[0] == 'a' ? 5 : 6] = true;
  return {static_cast<float>(mm[0]), static_cast<float>(mm[1])};
}

}  // namespace strake::report
