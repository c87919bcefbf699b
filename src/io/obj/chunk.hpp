// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/source/text_number.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::io::obj {

/// A vertex reference as written: absolute, or counted back from the last vertex so far, which a
/// chunk knows only relative to its own first vertex.
struct VertexReference {
  std::int64_t vertex = 0;
  bool chunk_relative = false;
};

/// A statement that changes what the following faces and lines belong to, or `unread`: what they
/// belong to has geometry of a kind that is not read.
enum class StatementKind : std::uint8_t { object, group, material, library, unread };

struct Statement {
  StatementKind kind = StatementKind::object;
  std::string text;
  std::uint32_t face = 0;      ///< the first face of the chunk behind it
  std::uint32_t polyline = 0;  ///< the first polyline behind it
};

/// What is wrong with a line of the file.
enum class LineFault : std::uint8_t {
  bad_vertex,        ///< `v` without three finite numbers
  bad_face,          ///< a corner that is not an index
  short_face,        ///< fewer than three corners
  bad_polyline,      ///< `l` with a point that is not an index
  short_polyline,    ///< fewer than two points
  curve_or_surface,  ///< free-form geometry, which is not read
};

struct Problem {
  LineFault fault = LineFault::bad_vertex;
  std::uint64_t line = 0;  ///< 0-based within the chunk
};

/// Rows of varying length: row i is values[end[i - 1] .. end[i]).
struct CornerRows {
  std::vector<VertexReference> corners;
  std::vector<std::uint32_t> end;
  std::vector<std::uint32_t> line;  ///< the line in the chunk of each row, 0-based

  [[nodiscard]] std::uint32_t begin_of(std::uint32_t row) const {
    return row == 0 ? 0 : end[row - 1];
  }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(end.size()); }
};

/// What one chunk of the text says, read without knowing the chunks before it.
struct ObjChunk {
  std::vector<geometry::Vec3d> vertices;  ///< as written; a bad one is NaN, to keep the numbering
  std::vector<DigitStatistics> digits;    ///< one entry per vertex
  CornerRows faces;
  CornerRows polylines;
  std::vector<Statement> statements;
  std::vector<Problem> problems;
  std::uint64_t lines = 0;
  bool cut_off = false;  ///< its last line does not end and has a problem
};

/// Cuts the text into chunks of about `size` bytes at line ends that no continuation crosses.
/// The cuts depend on the text and the size alone.
[[nodiscard]] std::vector<std::string_view> cut_chunks(std::string_view text, std::size_t size);

[[nodiscard]] ObjChunk parse_chunk(std::string_view text);

}  // namespace strake::io::obj
