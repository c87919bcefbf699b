// SPDX-License-Identifier: Apache-2.0
// docs/patterns/convert.md, the first conversion: two selections of a model, by the sequential
// program and by teams.
#include "bounding_box.hpp"

#include <cstdio>

#include "everywhere.hpp"

namespace {

using namespace convert;

/// Every step-th part.
std::vector<std::uint32_t> selection(const Model& model, std::uint32_t step) {
  std::vector<std::uint32_t> selected;
  for (std::uint32_t part = 0; part < model.size(); part += step) selected.push_back(part);
  return selected;
}

strake::Result<std::vector<Extent>> extents(const Model& model,
                                            const strake::parallel::Context& context) {
  const auto boxes = after::boxes_of(model, context);
  if (!boxes) return boxes.error();
  std::vector<Extent> found;
  for (const std::uint32_t step : {1U, 7U}) {
    const auto extent = after::extent_of(*boxes, selection(model, step), context);
    if (!extent) return extent.error();
    found.push_back(*extent);
  }
  return found;
}

void print(const Extent& extent) {
  const auto& [box, parts] = extent;
  for (std::size_t axis = 0; axis < 3; ++axis)
    std::printf("  %c from %d (part %u) to %d (part %u)\n", "xyz"[axis], box.lo[axis], parts[axis],
                box.hi[axis], parts[axis + 3]);
}

}  // namespace

int main() {
  const Model model = make_model(5000, 200);
  std::vector<Extent> expected;
  for (const std::uint32_t step : {1U, 7U})
    expected.push_back(before::extent_of(model, selection(model, step)));
  std::printf("%zu parts, %zu triangles\n", model.size(), triangles_of(model));
  for (const Extent& extent : expected) print(extent);
  if (expected[0].box.is_empty() || expected[0].reached_by == expected[1].reached_by) return 1;
  const auto run = [&](const strake::parallel::Context& context) {
    return extents(model, context);
  };
  if (!same_everywhere(expected, run)) return 1;
  std::puts("the same bytes from 1, 2, 3, 8 and 64 workers");
  return 0;
}
