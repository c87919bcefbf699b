// SPDX-License-Identifier: Apache-2.0
#include "project/views/piece_blocks.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>

#include "project/views/number_columns.hpp"
#include "project/views/view_codec.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {

namespace {

using hlr::EdgePiece;

/// Pieces of a block: what is worked on at a time stays in a core's own memory.
constexpr std::size_t kBlock = 4096;

/// Columns of a block: ends by axis, objects, edges, how far the other object is.
constexpr std::size_t kAxes = 3;

std::int64_t number_of(model::ObjectId id) { return static_cast<std::int64_t>(model::index(id)); }

std::vector<std::uint8_t> block_of(std::span<const EdgePiece> pieces) {
  std::vector<std::uint8_t> bytes;
  for (const EdgePiece& piece : pieces) bytes.push_back(static_cast<std::uint8_t>(piece.kind));
  for (const EdgePiece& piece : pieces) bytes.push_back(static_cast<std::uint8_t>(piece.state));
  std::vector<std::int64_t> values;
  const auto append = [&](auto&& each) {
    values.clear();
    for (const EdgePiece& piece : pieces) each(piece);
    append_numbers(bytes, values);
  };
  // A piece mostly begins where the last one ends.
  for (int axis = 0; axis < static_cast<int>(kAxes); ++axis)
    append([&](const EdgePiece& piece) {
      values.push_back(piece.a[axis]);
      values.push_back(piece.b[axis]);
    });
  append([&](const EdgePiece& piece) { values.push_back(number_of(piece.object)); });
  append([&](const EdgePiece& piece) { values.push_back(piece.edge); });
  // That of the object itself but for intersections.
  append([&](const EdgePiece& piece) {
    values.push_back(number_of(piece.other) - number_of(piece.object));
  });
  return bytes;
}

bool are_on_grid(const EdgePiece& piece) {
  return std::ranges::all_of(std::array{0, 1, 2}, [&](int axis) {
    return is_on_grid(piece.a[axis]) && is_on_grid(piece.b[axis]);
  });
}

bool is_before(const EdgePiece& x, const EdgePiece& y) {
  return std::tie(x.object, x.edge) < std::tie(y.object, y.edge);
}

/// Reads one block; its memory is used again for the next.
class BlockReader {
 public:
  explicit BlockReader(std::size_t objects) : objects_(objects) {}

  /// Returns false where the bytes are no block of so many pieces.
  bool read(std::span<const std::uint8_t> bytes, std::span<EdgePiece> pieces) {
    const std::size_t n = pieces.size();
    if (bytes.size() < 2 * n) return false;
    for (std::size_t i = 0; i < n; ++i) {
      if (bytes[i] > static_cast<std::uint8_t>(hlr::kLastEdgeKind) ||
          bytes[n + i] > static_cast<std::uint8_t>(hlr::State::clipped))
        return false;
      pieces[i].kind = static_cast<hlr::EdgeKind>(bytes[i]);
      pieces[i].state = static_cast<hlr::State>(bytes[n + i]);
    }
    bytes = bytes.subspan(2 * n);
    return take_ends(bytes, pieces) && take_objects(bytes, pieces) && bytes.empty() &&
           std::ranges::is_sorted(pieces, is_before);
  }

 private:
  bool take_ends(std::span<const std::uint8_t>& bytes, std::span<EdgePiece> pieces) {
    for (int axis = 0; axis < static_cast<int>(kAxes); ++axis) {
      const std::span ends = std::span(ends_).first(2 * pieces.size());
      if (!take_numbers(bytes, ends)) return false;
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        pieces[i].a[axis] = ends[2 * i];
        pieces[i].b[axis] = ends[2 * i + 1];
      }
    }
    return std::ranges::all_of(pieces, are_on_grid);
  }

  bool take_objects(std::span<const std::uint8_t>& bytes, std::span<EdgePiece> pieces) {
    constexpr std::uint64_t kMostEdges = std::uint64_t{1} << 32U;
    const std::size_t n = pieces.size();
    const std::span object = std::span(ends_).first(n), edge = std::span(edges_).first(n),
                    apart = std::span(apart_).first(n);
    if (!take_numbers(bytes, object) || !take_numbers(bytes, edge) || !take_numbers(bytes, apart))
      return false;
    for (std::size_t i = 0; i < n; ++i) {
      const auto most = static_cast<std::int64_t>(objects_);
      if (!is_number(object[i], objects_) || !is_number(edge[i], kMostEdges) || apart[i] <= -most ||
          apart[i] >= most || !is_number(object[i] + apart[i], objects_))
        return false;
      pieces[i].object = model::ObjectId{static_cast<std::uint32_t>(object[i])};
      pieces[i].edge = static_cast<std::uint32_t>(edge[i]);
      pieces[i].other = model::ObjectId{static_cast<std::uint32_t>(object[i] + apart[i])};
    }
    return true;
  }

  std::size_t objects_;
  std::array<std::int64_t, 2 * kBlock> ends_{};
  std::array<std::int64_t, kBlock> edges_{}, apart_{};
};

}  // namespace

void write_pieces(BlobWriter& out, std::span<const EdgePiece> pieces) {
  out.number(pieces.size());
  for (std::size_t begin = 0; begin < pieces.size(); begin += kBlock)
    out.column(std::span<const std::uint8_t>(
        block_of(pieces.subspan(begin, std::min(kBlock, pieces.size() - begin)))));
}

Result<std::vector<EdgePiece>> read_pieces(BlobReader& in, std::size_t objects,
                                           const parallel::Context& context) {
  const std::uint64_t count = in.number();
  std::vector<std::span<const std::uint8_t>> blocks;
  std::uint64_t pieces_there = 0;
  while (!in.failed() && pieces_there < count) {
    blocks.push_back(in.bytes());
    const std::uint64_t here = std::min<std::uint64_t>(kBlock, count - pieces_there);
    // A piece has two bytes at least, so that a count claims no more memory than there are bytes.
    if (!in.failed() && blocks.back().size() < 2 * here) in.refuse("a block of lines is too short");
    pieces_there += here;
  }
  if (in.failed()) return std::vector<EdgePiece>{};
  // There is room for the pieces that a change adds, so that hlr::draw_changes() leaves the others
  // where they are.
  const std::uint64_t room = pieces_there + pieces_there / 64;
  Result<std::vector<EdgePiece>> pieces = parallel::slots<EdgePiece>(room, context);
  if (!pieces) return pieces;
  pieces->resize(pieces_there);
  const std::span<EdgePiece> slot = *pieces;
  const auto is_sound = parallel::transform_with(
      context, {.name = "stored lines", .n = blocks.size()},
      [objects] { return std::make_unique<BlockReader>(objects); },
      [&](std::unique_ptr<BlockReader>& reader, std::size_t b) -> std::uint8_t {
        const std::size_t begin = b * kBlock;
        return reader->read(blocks[b], slot.subspan(begin, std::min(kBlock, slot.size() - begin)))
                   ? 1
                   : 0;
      });
  if (!is_sound) return is_sound.error();
  bool sound = std::ranges::count(*is_sound, std::uint8_t{0}) == 0;
  for (std::size_t begin = kBlock; begin < slot.size(); begin += kBlock)
    sound = sound && !is_before(slot[begin], slot[begin - 1]);
  if (sound) return pieces;
  in.refuse("a line cannot be one of a drawing");
  return std::vector<EdgePiece>{};
}

}  // namespace strake::project
