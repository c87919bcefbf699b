// SPDX-License-Identifier: Apache-2.0
#include "io/obj/chunk.hpp"

#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "core/text_encoding.hpp"

namespace strake::io::obj {
namespace {

/// Whether the line that ends at this newline goes on in the next one.
bool continues(const char* text_begin, const char* newline) {
  const char* last = newline;
  if (last != text_begin && last[-1] == '\r') --last;
  return last != text_begin && last[-1] == '\\';
}

const char* find_newline(const char* at, const char* end) {
  const auto length = static_cast<std::size_t>(end - at);
  const void* found = length == 0 ? nullptr : std::memchr(at, '\n', length);
  return found == nullptr ? end : static_cast<const char*>(found);
}

/// Reads an integer at `at`; one too large for any file saturates, so that it is out of range
/// later.
bool read_index(const char*& at, const char* end, std::int64_t& value) {
  constexpr std::int64_t kTooLarge = std::int64_t{1} << 40;
  const char* digit = at;
  const bool negative = digit != end && *digit == '-';
  if (digit != end && (*digit == '-' || *digit == '+')) ++digit;
  const char* const first = digit;
  std::int64_t sum = 0;
  for (; digit != end && static_cast<unsigned char>(*digit - '0') < 10; ++digit)
    sum = sum < kTooLarge ? sum * 10 + (*digit - '0') : kTooLarge;
  if (digit == first) return false;
  value = negative ? -sum : sum;
  at = digit;
  return true;
}

class ChunkParser {
 public:
  ObjChunk parse(std::string_view text);

 private:
  void line(const char* at, const char* end);
  void vertex(const char* at, const char* end);
  void row(const char* at, const char* end, bool face);
  void statement(StatementKind kind, const char* at, const char* end);
  void problem(LineFault fault) { chunk_.problems.push_back({fault, chunk_.lines}); }
  std::pair<const char*, const char*> joined(const char* at, const char*& end, const char* text_end,
                                             std::uint64_t& extra);

  ObjChunk chunk_;
  std::string joined_;  ///< a line put together from its continuations
};

/// Returns the keyword of a line; `at` moves behind it.
std::string_view keyword(const char*& at, const char* end) {
  const char* const begin = at;
  while (at != end && !is_blank(*at)) ++at;
  return {begin, static_cast<std::size_t>(at - begin)};
}

void ChunkParser::line(const char* at, const char* end) {
  skip_blanks(at, end);
  if (at == end || *at == '#') return;
  const std::string_view word = keyword(at, end);
  if (word == "v") return vertex(at, end);
  if (word == "f" || word == "fo") return row(at, end, true);
  if (word == "l") return row(at, end, false);
  if (word == "o") return statement(StatementKind::object, at, end);
  if (word == "g") return statement(StatementKind::group, at, end);
  if (word == "usemtl") return statement(StatementKind::material, at, end);
  if (word == "mtllib") return statement(StatementKind::library, at, end);
  if (word == "surf" || word == "curv") {
    problem(LineFault::curve_or_surface);
    return statement(StatementKind::unread, end, end);
  }
  // Normals, texture coordinates, smoothing groups and display attributes say nothing about
  // where the surface is.
}

void ChunkParser::vertex(const char* at, const char* end) {
  geometry::Vec3d point;
  DigitStatistics digits;
  bool good = true;
  for (int axis = 0; axis < 3 && good; ++axis) {
    skip_blanks(at, end);
    good = read_number(at, end, point[axis], digits) && (at == end || is_blank(*at)) &&
           is_coordinate(point[axis]);
  }
  if (!good) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    point = {kNan, kNan, kNan};
    problem(LineFault::bad_vertex);
  }
  chunk_.vertices.push_back(point);
  chunk_.digits.push_back(digits);
}

/// Reads face corners "7", "7/1", "7//3", "-1/-1/-1": the vertex index alone matters.
void ChunkParser::row(const char* at, const char* end, bool face) {
  CornerRows& rows = face ? chunk_.faces : chunk_.polylines;
  const std::size_t begin = rows.corners.size();
  bool good = true;
  for (skip_blanks(at, end); at != end && *at != '#'; skip_blanks(at, end)) {
    std::int64_t index = 0;
    good = read_index(at, end, index) && index != 0 && (at == end || is_blank(*at) || *at == '/');
    if (!good) break;
    while (at != end && !is_blank(*at)) ++at;
    if (index > 0)
      rows.corners.push_back({index - 1, false});
    else
      rows.corners.push_back({static_cast<std::int64_t>(chunk_.vertices.size()) + index, true});
  }
  const std::size_t least = face ? 3 : 2;
  if (good && rows.corners.size() - begin < least) {
    rows.corners.resize(begin);
    problem(face ? LineFault::short_face : LineFault::short_polyline);
    return;
  }
  if (!good) {
    // An empty row marks the object that the line belongs to as damaged.
    rows.corners.resize(begin);
    problem(face ? LineFault::bad_face : LineFault::bad_polyline);
  }
  rows.end.push_back(static_cast<std::uint32_t>(rows.corners.size()));
  rows.line.push_back(static_cast<std::uint32_t>(chunk_.lines));
}

void ChunkParser::statement(StatementKind kind, const char* at, const char* end) {
  const std::string_view text =
      trimmed(std::string_view(at, static_cast<std::size_t>(end - at)), kBlanks);
  chunk_.statements.push_back(
      {kind, std::string(text), chunk_.faces.size(), chunk_.polylines.size()});
}

/// Returns the logical line from `at`, its continuations joined by blanks; `end` moves to the
/// newline that really ends it.
std::pair<const char*, const char*> ChunkParser::joined(const char* at, const char*& end,
                                                        const char* text_end,
                                                        std::uint64_t& extra) {
  joined_.clear();
  const char* piece = at;
  while (true) {
    const char* piece_end = end;
    if (piece_end != piece && piece_end[-1] == '\r') --piece_end;
    const bool more = piece_end != piece && piece_end[-1] == '\\';
    joined_.append(piece, more ? piece_end - 1 : piece_end);
    if (!more || end == text_end) break;
    joined_.push_back(' ');
    ++extra;
    piece = end + 1;
    end = find_newline(piece, text_end);
  }
  return {joined_.data(), joined_.data() + joined_.size()};
}

ObjChunk ChunkParser::parse(std::string_view text) {
  // Typical lines are longer: this avoids most growth without asking for more than the text's size.
  chunk_.vertices.reserve(text.size() / 64);
  chunk_.digits.reserve(text.size() / 64);
  const char* at = text.data();
  const char* const text_end = at + text.size();
  while (at != text_end) {
    const char* end = find_newline(at, text_end);
    std::uint64_t extra = 0;
    const std::size_t problems = chunk_.problems.size();
    if (continues(at, end)) {
      const auto [begin, stop] = joined(at, end, text_end, extra);
      line(begin, stop);
    } else {
      line(at, end);
    }
    chunk_.cut_off = end == text_end && chunk_.problems.size() > problems;
    chunk_.lines += 1 + extra;
    at = end == text_end ? end : end + 1;
  }
  return std::move(chunk_);
}

}  // namespace

std::vector<std::string_view> cut_chunks(std::string_view text, std::size_t size) {
  std::vector<std::string_view> chunks;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    const char* cut = end;
    if (static_cast<std::size_t>(end - at) > size) {
      cut = find_newline(at + size, end);
      while (cut != end && continues(at, cut)) cut = find_newline(cut + 1, end);
      if (cut != end) ++cut;
    }
    chunks.emplace_back(at, static_cast<std::size_t>(cut - at));
    at = cut;
  }
  return chunks;
}

ObjChunk parse_chunk(std::string_view text) { return ChunkParser().parse(text); }

}  // namespace strake::io::obj
