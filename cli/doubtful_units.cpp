// SPDX-License-Identifier: Apache-2.0
#include "cli/doubtful_units.hpp"

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <string>
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
  double alike;  ///< extents that differ by no more than this factor besides
};

/// Not 10 and 12: parts that are so much larger than others are common. 25 and 40 times as large,
/// of a cube or a plate, are so, too: those have to be told from inches by a hundredth.
constexpr double kAlike = 1.12, kSame = 1.01;
constexpr std::array<Mistake, 4> kMistakes{{{1000, "m", "mm", kAlike},
                                            {25.4, "in", "mm", kSame},
                                            {39.3701, "m", "in", kSame},
                                            {304.8, "ft", "mm", kAlike}}};

/// Whether `large` is larger than `small`, both in grid units, by the mistake along all three axes,
/// and along two at least by extents that the grid has not made of nothing: two parts seldom are
/// alike along all axes, and what stands in a line often is.
bool is_alike(const Vec3d& small, const Vec3d& large, const Mistake& mistake) {
  constexpr double kTelling = 8;
  const auto& [factor, small_unit, large_unit, alike] = mistake;
  int telling = 0;
  for (int k = 0; k < 3; ++k) {
    // The grid moves each of two ends by half a unit.
    if (large[k] > (small[k] + 1) * factor * alike || large[k] < (small[k] - 1) * factor / alike)
      return false;
    if (small[k] >= kTelling) ++telling;
  }
  return telling >= 2;
}

struct Extent {
  std::size_t file;
  Vec3d size;
  std::string_view assumed;  ///< the unit; empty where it is known
};

/// The unit where a file does not say it and nobody has.
std::string_view assumed_unit(std::string_view unit) {
  constexpr std::string_view kAssumed = " (assumed)";
  return unit.ends_with(kAssumed) ? unit.substr(0, unit.size() - kAssumed.size()) : "";
}

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
      found.push_back({f, boxes[f].hi - boxes[f].lo, assumed_unit(files[f].unit)});
  return found;
}

/// One file may be in another axis' hands, too: y and z change places.
bool is_alike_in_any_frame(const Extent& small, const Extent& large, const Mistake& mistake) {
  const Vec3d& s = small.size;
  return is_alike(s, large.size, mistake) || is_alike({s.x, s.z, s.y}, large.size, mistake);
}

/// What to say of the two files: never another unit of one that is known.
std::string options_to_try(const Extent& small, const Extent& large, const Mistake& mistake,
                           const std::vector<model::SourceFile>& files) {
  const auto option = [&](const Extent& of, std::string_view unit) {
    return fmt::format("--unit '{}={}'", files[of.file].label, unit);
  };
  const auto& [factor, small_unit, large_unit, alike] = mistake;
  if (!small.assumed.empty() && !large.assumed.empty())
    return option(small, small_unit) + ' ' + option(large, large_unit);
  if (!small.assumed.empty())
    return option(small, small.assumed == large_unit ? small_unit : "UNIT");
  return option(large, large.assumed == small_unit ? large_unit : "UNIT");
}

}  // namespace

void note_doubtful_units(model::Scene& scene) {
  const std::vector<model::SourceFile>& files = scene.model->files;
  const std::vector<Extent> found = extents(scene);
  for (const Extent& large : found)
    for (const Extent& small : found) {
      if (large.assumed.empty() && small.assumed.empty()) continue;
      for (const Mistake& mistake : kMistakes)
        if (is_alike_in_any_frame(small, large, mistake))
          scene.diagnostics.add(
              Severity::warning, "unit-doubtful",
              fmt::format("is about {:g} times as large as {}: where that is the factor between "
                          "their units, say {}",
                          mistake.factor, files[small.file].label,
                          options_to_try(small, large, mistake, files)),
              files[large.file].label);
    }
}

}  // namespace strake::cli
