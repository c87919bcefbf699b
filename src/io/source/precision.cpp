// SPDX-License-Identifier: Apache-2.0
#include "io/source/precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

#include "strake/geometry/grid.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::io {

float precision_um(double half_spacing_mm) {
  constexpr double kUmPerMm = 1000, kMaxUm = geometry::kMaxGridMm * kUmPerMm;
  const double um = half_spacing_mm * kUmPerMm;
  return static_cast<float>(um <= kMaxUm ? um : kMaxUm);
}

double largest_coordinate(std::span<const geometry::Vec3d> points) {
  double largest = 0;
  for (const geometry::Vec3d& p : points)
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  return largest;
}

bool came_through_float32(const geometry::Vec3d& numbers) {
  constexpr std::size_t kFloatDigits = std::numeric_limits<float>::max_digits10;
  bool any = false;
  for (int k = 0; k < 3; ++k) {
    if (!(std::fabs(numbers[k]) <= static_cast<double>(std::numeric_limits<float>::max())) ||
        numbers[k] != static_cast<double>(static_cast<float>(numbers[k])))
      return false;
    std::array<char, 32> text{};  // "1.25e+02": a digit, a point, others, an exponent
    const auto written = std::to_chars(text.data(), text.data() + text.size(),
                                       std::fabs(numbers[k]), std::chars_format::scientific);
    const std::string_view all(text.data(), static_cast<std::size_t>(written.ptr - text.data()));
    any = any || all.find('e') > kFloatDigits + 1;
  }
  return any;
}

double scale_of(const geometry::Mat3d& linear) {
  double largest = 0;
  for (const geometry::Vec3d& row : linear.row) largest = std::max(largest, dot(row, row));
  return std::sqrt(largest);
}

namespace {

constexpr float kCoarseUm = 250;  // half a spacing; a contact distance is two whole ones

/// The worst precision of objects, in half spacings, the first object that has it, and how many
/// have coarse ones.
struct WorstPrecision {
  float um = 0;
  std::size_t object = 0, coarse = 0;

  void add(const WorstPrecision& later) {
    if (later.um > um) {
      um = later.um;
      object = later.object;
    }
    coarse += later.coarse;
  }
};

}  // namespace

Status settle_precision(const FileBytes& file, model::Model& model,
                        const parallel::Context& context) {
  constexpr double kMmPerUm = 1e-3;
  constexpr std::size_t kGrain = 4096;
  const auto found = parallel::reduce(
      context, {.name = "precision of objects", .n = model.objects.size(), .grain = kGrain},
      WorstPrecision{},
      [&](WorstPrecision& of_block, std::size_t o) {
        const model::Object& object = model.objects[o];
        WorstPrecision own{.object = o};
        for (std::uint32_t b = 0; b < object.body_count; ++b)
          own.um = std::max(own.um, model.bodies[object.first_body + b].precision_um);
        if (own.um > kCoarseUm) own.coarse = 1;
        of_block.add(own);
      },
      [](WorstPrecision& into, const WorstPrecision& of_block) { into.add(of_block); });
  if (!found) return found.error();
  const auto [worst, example, coarse] = *found;
  model.files.front().precision_mm = static_cast<double>(worst) / 1000;
  if (coarse == 0) return {};
  model.diagnostics.add(
      Severity::warning, "coarse-coordinates",
      fmt::format("the coordinates of {} are so large for the file's numbers that these "
                  "stand in steps of up to {:.3g} mm there, and what is nearer counts as touching: "
                  "export nearer to the origin, or with more digits",
                  coarse == 1 ? "1 object" : std::to_string(coarse) + " objects",
                  2 * static_cast<double>(worst) * kMmPerUm),
      fmt::format("{}, '{}'", file.path.string(), model.objects[example].name));
  return {};
}

}  // namespace strake::io
