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

  /// Returns false where the bytes are no block of so many pieces of these objects.
  bool read(std::span<const std::uint8_t> bytes, ObjectRange range, std::span<EdgePiece> pieces) {
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
           std::ranges::is_sorted(pieces, is_before) &&
           (pieces.empty() || (model::index(pieces.front().object) >= range.first &&
                               model::index(pieces.back().object) < range.last));
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
    constexpr std::uint64_t kMaxEdges = std::uint64_t{1} << 32U;
    const std::size_t n = pieces.size();
    const std::span object = std::span(ends_).first(n), edge = std::span(edges_).first(n),
                    apart = std::span(apart_).first(n);
    if (!take_numbers(bytes, object) || !take_numbers(bytes, edge) || !take_numbers(bytes, apart))
      return false;
    for (std::size_t i = 0; i < n; ++i) {
      const auto largest = static_cast<std::int64_t>(objects_);
      if (!is_number(object[i], objects_) || !is_number(edge[i], kMaxEdges) ||
          apart[i] <= -largest || apart[i] >= largest || !is_number(object[i] + apart[i], objects_))
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

PieceBlocks take_pieces(BlobReader& in, ObjectRange objects) {
  PieceBlocks pieces{objects, in.number(), {}};
  std::uint64_t there = 0;
  while (!in.failed() && there < pieces.count) {
    pieces.blocks.push_back(in.bytes());
    const std::uint64_t here = std::min<std::uint64_t>(kBlock, pieces.count - there);
    // A piece has two bytes at least, so that a count claims no more memory than there are bytes.
    if (!in.failed() && pieces.blocks.back().size() < 2 * here)
      in.refuse("a block of lines is too short");
    there += here;
  }
  if (in.failed()) return {};
  return pieces;
}

namespace {

/// A block, and where its pieces come to lie.
struct PlacedBlock {
  std::span<const std::uint8_t> bytes;
  ObjectRange objects;
  std::size_t begin = 0, size = 0;
};

std::vector<PlacedBlock> placed(std::span<const PieceBlocks> ranges) {
  std::vector<PlacedBlock> blocks;
  std::size_t begin = 0;
  for (const PieceBlocks& range : ranges) {
    std::uint64_t left = range.count;
    for (const std::span<const std::uint8_t> bytes : range.blocks) {
      const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, left));
      blocks.push_back({bytes, range.objects, begin, size});
      begin += size;
      left -= size;
    }
  }
  return blocks;
}

}  // namespace

Result<std::vector<EdgePiece>> read_pieces(std::span<const PieceBlocks> ranges, std::size_t objects,
                                           BlobReader& in, const parallel::Context& context) {
  const std::vector<PlacedBlock> blocks = placed(ranges);
  const std::size_t count = blocks.empty() ? 0 : blocks.back().begin + blocks.back().size;
  // There is room for the pieces that a change adds, so that hlr::draw_changes() leaves the others
  // where they are.
  Result<std::vector<EdgePiece>> pieces = parallel::slots<EdgePiece>(count + count / 64, context);
  if (!pieces) return pieces;
  pieces->resize(count);
  const std::span<EdgePiece> slot = *pieces;
  const auto is_sound = parallel::transform_with(
      context, {.name = "stored lines", .n = blocks.size()},
      [objects] { return std::make_unique<BlockReader>(objects); },
      [&](std::unique_ptr<BlockReader>& reader, std::size_t b) -> std::uint8_t {
        const PlacedBlock& block = blocks[b];
        return reader->read(block.bytes, block.objects, slot.subspan(block.begin, block.size)) ? 1
                                                                                               : 0;
      });
  if (!is_sound) return is_sound.error();
  bool sound = std::ranges::count(*is_sound, std::uint8_t{0}) == 0;
  for (const PlacedBlock& block : blocks)
    sound = sound && (block.begin == 0 || !is_before(slot[block.begin], slot[block.begin - 1]));
  if (sound) return pieces;
  in.refuse("a line cannot be one of a drawing");
  return std::vector<EdgePiece>{};
}

}  // namespace strake::project
