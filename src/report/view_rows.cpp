// SPDX-License-Identifier: Apache-2.0
#include "report/view_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>

#include "drawing/view_rows.hpp"
#include "report/document_fields.hpp"

namespace strake::report {
namespace {

using Kind = JsonReader::Kind;

/// The names of an enumeration's values, as the writer numbered them.
template <class Enum, class Name>
std::vector<Enum> take_names(JsonReader& json, std::string_view key, Name&& name) {
  DocumentFields fields(json);
  fields.must_be(Kind::array, "rows", key, "list");
  std::vector<Enum> values;
  json.items([&] {
    const std::string text = fields.text("rows", key);
    const auto value = named<Enum>(text, name);
    if (!value || values.size() > 0xff)
      throw DocumentFault{"rows", "\"" + std::string(key) + "\" has '" + text +
                                      "', which this version does not know"};
    values.push_back(*value);
  });
  return values;
}

[[noreturn]] void cut_off(std::uint64_t row, std::uint64_t count) {
  throw contradicts("the document",
                    "ends in row " + std::to_string(row) + " of " + std::to_string(count));
}

template <class Int>
ViewPiece piece_of(const drawing::Row<Int>& row, const RowForm& form, std::uint64_t number) {
  const auto wrong = [&](const char* key, const char* what) {
    return is_not("row " + std::to_string(number), key, what);
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
    throw contradicts("the document", "ends in the checksum behind its rows");
  if (stored != drawing::checksum_bytes(checksum.value()))
    throw contradicts("the document",
                      "has not the checksum that stands behind its rows: it was damaged or edited");
}

/// A run at a time: a file that claims more rows than it has must not claim memory.
template <class Int>
std::vector<ViewPiece> read_all(std::istream& in, const RowForm& form, std::uint64_t count,
                                Checksum& checksum) {
  constexpr std::uint64_t kRun = 16384;
  std::vector<ViewPiece> pieces;
  std::vector<drawing::Row<Int>> rows;
  while (pieces.size() < count) {
    rows.resize(std::min<std::uint64_t>(kRun, count - pieces.size()));
    const std::size_t bytes = rows.size() * sizeof rows[0];
    in.read(reinterpret_cast<char*>(rows.data()), static_cast<std::streamsize>(bytes));
    const auto got = static_cast<std::size_t>(in.gcount());
    if (got < bytes) cut_off(pieces.size() + got / sizeof rows[0], count);
    checksum.add({reinterpret_cast<const char*>(rows.data()), bytes});
    for (const drawing::Row<Int>& row : rows) pieces.push_back(piece_of(row, form, pieces.size()));
  }
  if (form.has_checksum) check_checksum(in, checksum);
  if (in.peek() != std::istream::traits_type::eof())
    throw contradicts("the document", "goes on behind its last row");
  return pieces;
}

template <class Int>
bool is_of(const RowForm& form) {
  return form.bytes == sizeof(drawing::Row<Int>) && form.fields == drawing::row_fields<Int>();
}

}  // namespace

RowForm take_row_form(JsonReader& json) {
  DocumentFields fields(json);
  fields.must_be(Kind::object, "the document", "rows", "object");
  RowForm form;
  std::set<std::string, std::less<>> met;
  json.members([&](std::string_view key) {
    const std::string name(key);
    if (!met.insert(name).second) throw contradicts("rows", "has \"" + name + "\" twice");
    if (name == "bytes") {
      form.bytes = fields.count("rows", name);
    } else if (name == "fields") {
      json.copy(form.fields);
    } else if (name == "origin_um") {
      const auto um = fields.numbers<3>([] { return std::string("rows"); }, name,
                                        DocumentFields::kFarthestMm * 1000);
      for (int k = 0; k < 3; ++k) {
        const double value = um.at(static_cast<std::size_t>(k));
        if (value != std::floor(value)) throw is_not("rows", name, "point in whole micrometres");
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
    if (!met.contains(key)) throw lacks("rows", key);
  return form;
}

std::vector<ViewPiece> read_rows(std::istream& in, const RowForm& form, std::uint64_t count,
                                 Checksum& before) {
  if (is_of<std::int32_t>(form)) return read_all<std::int32_t>(in, form, count, before);
  if (is_of<std::int64_t>(form)) return read_all<std::int64_t>(in, form, count, before);
  throw is_not("rows", "fields", "form of rows that this version knows");
}

}  // namespace strake::report
