// SPDX-License-Identifier: Apache-2.0
#include "report/view/view_line_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>

#include "drawing/neutral/neutral_rows.hpp"
#include "report/document/document_reader.hpp"
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
    if (!there_.at(i)) throw missing_key(here(), kKeys.at(i));
  if (piece.kind == hlr::EdgeKind::intersection && piece.other == kNone)
    throw missing_key(here(), "other_index");
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
    if (json_.kind() != Kind::string) throw wrong_type(here(), "kind", "text");
    const auto kind = enum_by_name<hlr::EdgeKind>(json_.text(), drawing::kind_name);
    if (!kind) throw wrong_type(here(), "kind", "kind of line that this version knows");
    piece.kind = *kind;
    there_[1] = true;
  } else if (key == "state") {
    if (json_.kind() != Kind::string) throw wrong_type(here(), "state", "text");
    const auto state = enum_by_name<drawing::LineState>(json_.text(), drawing::state_name);
    if (!state) throw wrong_type(here(), "state", "state that this version knows");
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
    throw wrong_type(here(), key, "number of an object");
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

namespace {

using Kind = JsonReader::Kind;

/// Reads the names of an enumeration's values, as the writer numbered them.
template <class Enum, class Name>
std::vector<Enum> take_names(JsonReader& json, std::string_view key, Name&& name) {
  DocumentFields fields(json);
  fields.must_be(Kind::array, "rows", key, "list");
  std::vector<Enum> values;
  json.items([&] {
    const std::string text = fields.text("rows", key);
    const auto value = enum_by_name<Enum>(text, name);
    if (!value || values.size() > 0xff)
      throw DocumentFault{"rows", "\"" + std::string(key) + "\" has '" + text +
                                      "', which this version does not know"};
    values.push_back(*value);
  });
  return values;
}

[[noreturn]] void cut_off(std::uint64_t row, std::uint64_t count) {
  throw contradiction("the document",
                      "ends in row " + std::to_string(row) + " of " + std::to_string(count));
}

template <class Int>
ViewPiece piece_of(const drawing::ViewRow<Int>& row, const RowLayout& form, std::uint64_t number) {
  const auto wrong = [&](const char* key, const char* what) {
    return wrong_type("row " + std::to_string(number), key, what);
  };
  if (row.kind >= form.kinds.size()) throw wrong("kind", "kind of line that the document names");
  if (row.state >= form.states.size()) throw wrong("state", "state that the document names");
  const auto within = [](auto um, double farthest_mm) {
    return std::fabs(static_cast<double>(um)) <= farthest_mm * 1000;
  };
  const auto model = [&](const std::array<Int, 3>& v, const char* key) {
    geometry::Vec3l p = form.origin;
    for (int k = 0; k < 3; ++k) {
      const Int um = v.at(static_cast<std::size_t>(k));
      // Each is small enough for the sum to exist.
      if (!within(um, DocumentFields::kFarthestMm)) throw wrong(key, "point");
      p[k] += um;
      if (!within(p[k], DocumentFields::kFarthestMm)) throw wrong(key, "point");
    }
    return p;
  };
  const auto paper = [&](const std::array<Int, 2>& v, const char* key) {
    if (!within(v[0], drawing::kFarthestPaperMm) || !within(v[1], drawing::kFarthestPaperMm))
      throw wrong(key, "point");
    return std::array<float, 2>{static_cast<float>(static_cast<double>(v[0]) / 1000),
                                static_cast<float>(static_cast<double>(v[1]) / 1000)};
  };
  ViewPiece piece;
  piece.a = model(row.a, "a_um");
  piece.b = model(row.b, "b_um");
  piece.a_paper = paper(row.a_paper, "a_paper_um");
  piece.b_paper = paper(row.b_paper, "b_paper_um");
  piece.object = row.object;
  piece.kind = form.kinds[row.kind];
  piece.state = form.states[row.state];
  piece.other = piece.kind == hlr::EdgeKind::intersection ? row.other : row.object;
  return piece;
}

void check_checksum(std::istream& in, const Checksum& checksum) {
  std::string stored(drawing::kChecksumBytes, '\0');
  if (!in.read(stored.data(), static_cast<std::streamsize>(stored.size())))
    throw contradiction("the document", "ends in the checksum behind its rows");
  if (stored != drawing::checksum_bytes(checksum.value()))
    throw contradiction(
        "the document",
        "has not the checksum that stands behind its rows: it was damaged or edited");
}

/// Reads a run at a time: a file that claims more rows than it has must not claim memory.
template <class Int>
std::vector<ViewPiece> read_all(std::istream& in, const RowLayout& form, std::uint64_t count,
                                Checksum& checksum) {
  constexpr std::uint64_t kRun = 16384;
  std::vector<ViewPiece> pieces;
  std::vector<drawing::ViewRow<Int>> rows;
  while (pieces.size() < count) {
    rows.resize(std::min<std::uint64_t>(kRun, count - pieces.size()));
    const std::size_t bytes = rows.size() * sizeof rows[0];
    in.read(reinterpret_cast<char*>(rows.data()), static_cast<std::streamsize>(bytes));
    const auto got = static_cast<std::size_t>(in.gcount());
    if (got < bytes) cut_off(pieces.size() + got / sizeof rows[0], count);
    checksum.add({reinterpret_cast<const char*>(rows.data()), bytes});
    for (const drawing::ViewRow<Int>& row : rows)
      pieces.push_back(piece_of(row, form, pieces.size()));
  }
  if (form.has_checksum) check_checksum(in, checksum);
  if (in.peek() != std::istream::traits_type::eof())
    throw contradiction("the document", "goes on behind its last row");
  return pieces;
}

template <class Int>
bool is_of(const RowLayout& form) {
  return form.bytes == sizeof(drawing::ViewRow<Int>) && form.fields == drawing::row_fields<Int>();
}

}  // namespace

RowLayout read_row_layout(JsonReader& json) {
  DocumentFields fields(json);
  fields.must_be(Kind::object, "the document", "rows", "object");
  RowLayout form;
  std::set<std::string, std::less<>> met;
  json.members([&](std::string_view key) {
    const std::string name(key);
    if (!met.insert(name).second) throw contradiction("rows", "has \"" + name + "\" twice");
    if (name == "bytes") {
      form.bytes = fields.count("rows", name);
    } else if (name == "fields") {
      json.copy(form.fields);
    } else if (name == "origin_um") {
      const auto um = fields.numbers<3>([] { return std::string("rows"); }, name,
                                        DocumentFields::kFarthestMm * 1000);
      for (int k = 0; k < 3; ++k) {
        const double value = um.at(static_cast<std::size_t>(k));
        if (value != std::floor(value))
          throw wrong_type("rows", name, "point in whole micrometres");
        form.origin[k] = static_cast<std::int64_t>(value);
      }
    } else if (name == "kinds") {
      form.kinds = take_names<hlr::EdgeKind>(json, name, drawing::kind_name);
    } else if (name == "states") {
      form.states = take_names<drawing::LineState>(json, name, drawing::state_name);
    } else if (name == "checksum") {
      const std::string kind = fields.text("rows", name);
      if (kind != drawing::kChecksumName)
        throw DocumentFault{"rows",
                            "have a checksum '" + kind + "', which this version does not know"};
      form.has_checksum = true;
    } else {
      json.skip();
    }
  });
  for (const char* const key : {"bytes", "fields", "origin_um", "kinds", "states"})
    if (!met.contains(key)) throw missing_key("rows", key);
  return form;
}

std::vector<ViewPiece> read_rows(std::istream& in, const RowLayout& form, std::uint64_t count,
                                 Checksum& before) {
  if (is_of<std::int32_t>(form)) return read_all<std::int32_t>(in, form, count, before);
  if (is_of<std::int64_t>(form)) return read_all<std::int64_t>(in, form, count, before);
  throw wrong_type("rows", "fields", "form of rows that this version knows");
}

}  // namespace strake::report
