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

}  // namespace

std::string ViewPieceReader::here() const { return "pieces[" + std::to_string(taken_) + "]"; }

void ViewPieceReader::take() {
  if (json_.kind() != Kind::object) throw DocumentFault{here(), "is no object"};
  ReadPiece piece;
  there_ = {};
  json_.members([&](std::string_view key) { member(key, piece); });
  constexpr std::array<const char*, kMembers> kKeys{
      "object_index", "kind", "state", "a_mm", "b_mm", "a_paper_mm", "b_paper_mm"};
  for (std::size_t i = 0; i < kMembers; ++i)
    if (!there_.at(i)) throw missing_key(here(), kKeys.at(i));
  if (piece.kind == hlr::EdgeKind::intersection && piece.other == ReadPiece::kNone)
    throw missing_key(here(), "other_index");
  if (piece.kind != hlr::EdgeKind::intersection) piece.other = piece.object;
  sink_(piece);
  ++taken_;
}

void ViewPieceReader::member(std::string_view key, ReadPiece& piece) {
  if (key == "object_index") {
    piece.object = index("object_index", "number of an object");
    there_[0] = true;
  } else if (key == "other_index") {
    piece.other = index("other_index", "number of an object");
  } else if (key == "edge") {
    piece.edge = index("edge", "number of an edge");
  } else if (key == "curve_index") {
    piece.curve = index("curve_index", "number of a curve");
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

std::uint32_t ViewPieceReader::index(const char* key, const char* what) {
  const double value = json_.kind() == Kind::number ? json_.number() : -1;
  if (!(value >= 0 && value < ReadPiece::kNone) || value != std::floor(value))
    throw wrong_type(here(), key, what);
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

std::array<double, 2> ViewPieceReader::paper_point(const char* key) {
  const auto mm = fields_.numbers<2>([this] { return here(); }, key, drawing::kFarthestPaperMm);
  there_[key[0] == 'a' ? 5 : 6] = true;
  return mm;
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
ReadPiece piece_of(const drawing::ViewRow<Int>& row, const RowLayout& form, std::uint64_t number) {
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
    return std::array<double, 2>{static_cast<double>(v[0]) / 1000,
                                 static_cast<double>(v[1]) / 1000};
  };
  ReadPiece piece;
  piece.a = model(row.a, "a_um");
  piece.b = model(row.b, "b_um");
  piece.a_paper = paper(row.a_paper, "a_paper_um");
  piece.b_paper = paper(row.b_paper, "b_paper_um");
  piece.object = row.object;
  piece.edge = row.edge;
  piece.curve = row.curve;
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
void read_all(std::istream& in, const RowLayout& form, std::uint64_t count, Checksum& checksum,
              PieceSink sink) {
  constexpr std::uint64_t kRun = 16384;
  std::uint64_t taken = 0;
  std::vector<drawing::ViewRow<Int>> rows;
  while (taken < count) {
    rows.resize(std::min<std::uint64_t>(kRun, count - taken));
    const std::size_t bytes = rows.size() * sizeof rows[0];
    in.read(reinterpret_cast<char*>(rows.data()), static_cast<std::streamsize>(bytes));
    const auto got = static_cast<std::size_t>(in.gcount());
    if (got < bytes) cut_off(taken + got / sizeof rows[0], count);
    checksum.add({reinterpret_cast<const char*>(rows.data()), bytes});
    for (const drawing::ViewRow<Int>& row : rows) sink(piece_of(row, form, taken++));
  }
  if (form.has_checksum) check_checksum(in, checksum);
  if (in.peek() != std::istream::traits_type::eof())
    throw contradiction("the document", "goes on behind its last row");
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

void read_rows(std::istream& in, const RowLayout& form, std::uint64_t count, Checksum& before,
               PieceSink sink) {
  if (is_of<std::int32_t>(form)) return read_all<std::int32_t>(in, form, count, before, sink);
  if (is_of<std::int64_t>(form)) return read_all<std::int64_t>(in, form, count, before, sink);
  throw wrong_type("rows", "fields", "form of rows that this version knows");
}

}  // namespace strake::report
