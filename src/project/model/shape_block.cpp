// SPDX-License-Identifier: Apache-2.0
#include "project/model/shape_block.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <variant>

#include "geometry/primitives/lengths.hpp"
#include "project/codec/blob.hpp"
#include "project/model/columns.hpp"

namespace strake::project {
namespace {

using geometry::Primitive;

/// Kinds are numbered as the variant is, and each has columns of its own: one more kind, or one
/// more length of one, is a new version of the tables (database/schema.hpp).
constexpr std::size_t kPrimitiveKinds = std::variant_size_v<Primitive>;
static_assert(kPrimitiveKinds == 10 &&
              std::is_same_v<std::variant_alternative_t<9, Primitive>, geometry::LinePrimitive>);
constexpr auto kSharedKind = static_cast<std::uint8_t>(kPrimitiveKinds);

template <std::size_t Kind>
using Lengths = geometry::Lengths<std::variant_alternative_t<Kind, Primitive>>;

/// Appends the lengths of all primitives of one kind, first lengths first.
template <std::size_t Kind>
void write_kind(BlobWriter& out, std::span<const model::Shape> shapes) {
  std::array<std::vector<double>, std::tuple_size_v<Lengths<Kind>>> columns;
  for (const model::Shape& shape : shapes) {
    const auto* const any = std::get_if<Primitive>(&shape);
    const auto* const primitive = any == nullptr ? nullptr : std::get_if<Kind>(any);
    if (primitive == nullptr) continue;
    const auto lengths = geometry::lengths_of(*primitive);
    for (std::size_t k = 0; k < lengths.size(); ++k) columns[k].push_back(lengths[k]);
  }
  for (const std::vector<double>& column : columns) out.planes(column);
}

template <std::size_t Kind>
void read_kind(BlobReader& in, std::span<const std::uint8_t> kinds,
               std::span<model::Shape> shapes) {
  const auto count = static_cast<std::size_t>(std::ranges::count(kinds, Kind));
  std::array<std::vector<double>, std::tuple_size_v<Lengths<Kind>>> columns;
  for (std::vector<double>& column : columns) {
    column = in.planes<double>();
    if (column.size() != count) in.refuse("lengths lack");
  }
  if (in.failed()) return;
  std::size_t n = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (kinds[i] != Kind) continue;
    Lengths<Kind> lengths;
    for (std::size_t k = 0; k < lengths.size(); ++k) lengths[k] = columns[k][n];
    shapes[i] = geometry::from_lengths<std::variant_alternative_t<Kind, Primitive>>(lengths);
    ++n;
  }
}

template <std::size_t... Kinds>
void write_kinds(BlobWriter& out, std::span<const model::Shape> shapes,
                 std::index_sequence<Kinds...> /*all*/) {
  (write_kind<Kinds>(out, shapes), ...);
}

template <std::size_t... Kinds>
void read_kinds(BlobReader& in, std::span<const std::uint8_t> kinds, std::span<model::Shape> shapes,
                std::index_sequence<Kinds...> /*all*/) {
  (read_kind<Kinds>(in, kinds, shapes), ...);
}

}  // namespace

Result<Blob> pack_shapes(std::span<const model::Shape> shapes,
                         std::span<const PackedShape> packed) {
  std::vector<std::uint8_t> kinds;
  for (const model::Shape& shape : shapes) {
    const auto* const primitive = std::get_if<Primitive>(&shape);
    kinds.push_back(primitive == nullptr ? kSharedKind
                                         : static_cast<std::uint8_t>(primitive->index()));
  }
  std::vector<std::uint32_t> packs, numbers;
  for (const PackedShape& shape : packed) {
    packs.push_back(shape.pack);
    numbers.push_back(shape.number);
  }
  BlobWriter out;
  out.column<std::uint8_t>(kinds);
  write_kinds(out, shapes, std::make_index_sequence<kPrimitiveKinds>());
  out.planes(packs);
  write_steps(out, numbers);
  return out.finish();
}

Result<std::vector<SharedShape>> unpack_shapes(std::span<const std::byte> blob, std::string what,
                                               std::span<model::Shape> shapes) {
  Result<BlobReader> in = BlobReader::open(blob, std::move(what));
  if (!in) return in.error();
  const std::vector<std::uint8_t> kinds = in->column<std::uint8_t>();
  if (kinds.size() != shapes.size() ||
      std::ranges::any_of(kinds, [](std::uint8_t kind) { return kind > kSharedKind; }))
    in->refuse("kinds lack");
  read_kinds(*in, kinds, shapes, std::make_index_sequence<kPrimitiveKinds>());
  const auto count = static_cast<std::size_t>(std::ranges::count(kinds, kSharedKind));
  const std::vector<std::uint32_t> packs = read_planes(*in, count);
  const std::vector<std::uint32_t> numbers = read_steps(*in, count);
  if (const Status status = in->finish(); !status) return status.error();
  std::vector<SharedShape> shared;
  shared.reserve(count);
  for (std::uint32_t i = 0; i < kinds.size(); ++i)
    if (kinds[i] == kSharedKind)
      shared.push_back({i, {packs[shared.size()], numbers[shared.size()]}});
  return shared;
}

}  // namespace strake::project
