// SPDX-License-Identifier: Apache-2.0
#include "drawing/view_hash.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

#include "strake/parallel/transform.hpp"

namespace strake::drawing {

namespace {

void add_vector(Hasher& hasher, const geometry::Vec3l& v) { hasher.add(v.x).add(v.y).add(v.z); }

void add_view(Hasher& hasher, const hlr::View& view) {
  add_vector(hasher, view.direction);
  add_vector(hasher, view.up);
  hasher.add(static_cast<std::uint64_t>(view.limits ? 1 : 0));
  if (view.limits) {
    add_vector(hasher, view.limits->lo);
    add_vector(hasher, view.limits->hi);
  }
  hasher.add(static_cast<std::uint64_t>(view.sections.size()));
  for (const hlr::Section& section : view.sections) {
    add_vector(hasher, section.normal);
    add_vector(hasher, section.point);
  }
  if (const auto& perspective = view.perspective) {
    add_vector(hasher, perspective->eye);
    add_vector(hasher, perspective->target);
    hasher.add(perspective->near_mm).add(perspective->field_of_view_deg);
  }
}

Hash128 hash_of_run(std::span<const hlr::Piece> pieces, const model::Model& model) {
  Hasher hasher;
  const hlr::Piece* last = nullptr;
  for (const hlr::Piece& piece : pieces) {
    if (last == nullptr || last->object != piece.object) {
      const model::Object& object = model.object(piece.object);
      hasher.add(std::string_view(model.files[object.file].label)).add(std::string_view(object.id));
    }
    hasher.add(static_cast<std::uint32_t>(piece.kind)).add(static_cast<std::uint32_t>(piece.state));
    if (piece.kind == hlr::EdgeKind::intersection)
      hasher.add(std::string_view(model.object(piece.other).id));
    add_vector(hasher, piece.a);
    add_vector(hasher, piece.b);
    last = &piece;
  }
  return hasher.value();
}

}  // namespace

Result<Hash128> hash_of(const hlr::Drawing& drawing, const model::Model& model,
                        const parallel::Context& context) {
  // Run by run, so that many workers can; how long a run is changes the hash.
  constexpr std::size_t kRun = 65536;
  const std::span<const hlr::Piece> pieces = drawing.pieces;
  const auto runs = parallel::transform(
      context, {.name = "hash of pieces", .n = (pieces.size() + kRun - 1) / kRun},
      [&](std::size_t run) {
        const std::size_t begin = run * kRun;
        return hash_of_run(pieces.subspan(begin, std::min(kRun, pieces.size() - begin)), model);
      });
  if (!runs) return runs.error();
  Hasher hasher;
  add_view(hasher, drawing.view);
  hasher.add(static_cast<std::uint64_t>(pieces.size()));
  for (const Hash128& run : *runs) hasher.add(run.high).add(run.low);
  return hasher.value();
}

}  // namespace strake::drawing
