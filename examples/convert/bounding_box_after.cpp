// SPDX-License-Identifier: Apache-2.0
#include "bounding_box.hpp"
#include "strake/parallel/pieces.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace convert::after {

using namespace strake::parallel;

strake::Result<std::vector<Box>> boxes_of(const Model& model, const Context& context) {
  const auto work =
      pieces(model.size(), [&](std::size_t m) { return model[m].points.size(); }, 4096);
  if (!work) return work.error();
  const auto parts = transform(context, {.name = "boxes", .n = work->size()}, [&](std::size_t k) {
    const Piece& piece = (*work)[k];
    Box box;
    for (std::size_t p = piece.first; p < piece.last; ++p) box.add(model[piece.item].points[p]);
    return box;
  });
  if (!parts) return parts.error();
  std::vector<Box> boxes(model.size());
  for (std::size_t k = 0; k < work->size(); ++k) boxes[(*work)[k].item].add((*parts)[k]);
  return boxes;
}

strake::Result<Extent> extent_of(const std::vector<Box>& boxes,
                                 std::span<const std::uint32_t> selected, const Context& context) {
  return reduce(
      context, {.name = "extent", .n = selected.size(), .grain = 1024}, Extent(),
      [&](Extent& extent, std::size_t i) { extent.add(boxes[selected[i]], selected[i]); },
      [](Extent& into, const Extent& extent) { into.add(extent); });
}

}  // namespace convert::after
