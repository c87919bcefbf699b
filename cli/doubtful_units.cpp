// SPDX-License-Identifier: Apache-2.0
#include "cli/doubtful_units.hpp"

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace strake::cli {

namespace {

using geometry::Box3d;
using geometry::Vec3d;

/// Files of these two units, read as of one, differ by the factor.
struct Mistake {
  double factor;
  std::string_view small, large;
};

/// Not 10 and 12: parts that are so much larger than others are common.
constexpr std::array<Mistake, 4> kMistakes{
    {{1000, "m", "mm"}, {25.4, "in", "mm"}, {39.3701, "m", "in"}, {304.8, "ft", "mm"}}};

/// Whether `large` is `factor` times `small`, both in grid units, along all three axes but for a
/// tenth, and along two at least by extents that the grid has not made of nothing: two parts seldom
/// are alike along all axes, and what stands in a line often is.
bool is_alike(const Vec3d& small, const Vec3d& large, double factor) {
  constexpr double kAlike = 1.12;
  constexpr double kTelling = 8;
  int telling = 0;
  for (int k = 0; k < 3; ++k) {
    // The grid moves each of two ends by half a unit.
    if (large[k] > (small[k] + 1) * factor * kAlike || large[k] < (small[k] - 1) * factor / kAlike)
      return false;
    if (small[k] >= kTelling) ++telling;
  }
  return telling >= 2;
}

struct Extent {
  std::size_t file;
  Vec3d size;
  bool assumed;  ///< the unit
};

/// Of the files that anything is placed of.
std::vector<Extent> extents(const model::Scene& scene) {
  const std::vector<model::SourceFile>& files = scene.model->files;
  std::vector<Box3d> boxes(files.size(), geometry::empty_box<double>());
  for (const model::GridBody& body : scene.bodies)
    boxes[scene.model->object(body.object).file].include(
        body.box(scene.shapes[body.grid_shape]).as<double>());
  std::vector<Extent> found;
  for (std::size_t f = 0; f < files.size(); ++f)
    if (!boxes[f].empty())
      found.push_back({f, boxes[f].hi - boxes[f].lo, files[f].unit.ends_with("(assumed)")});
  return found;
}

}  // namespace

void note_doubtful_units(model::Scene& scene) {
  const std::vector<Extent> found = extents(scene);
  const auto label = [&](const Extent& e) -> const std::string& {
    return scene.model->files[e.file].label;
  };
  for (const Extent& large : found)
    for (const Extent& small : found) {
      if (!large.assumed && !small.assumed) continue;
      for (const auto& [factor, small_unit, large_unit] : kMistakes)
        if (is_alike(small.size, large.size, factor))
          scene.diagnostics.add(
              Severity::warning, "unit-doubtful",
              fmt::format("is about {:g} times as large as {} along all axes: if one is in {} and "
                          "the other in {}, say --unit '{}={}' --unit '{}={}'",
                          factor, label(small), small_unit, large_unit, label(small), small_unit,
                          label(large), large_unit),
              label(large));
    }
}

}  // namespace strake::cli
