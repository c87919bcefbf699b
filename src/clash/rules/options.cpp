// SPDX-License-Identifier: Apache-2.0
#include "clash/rules/options.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "clash/rules/tolerance_lengths.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::clash {
namespace {

/// The largest tolerance: far beyond any clearance a user can mean, and small enough for every box
/// of the grid.
constexpr double kMaxToleranceMm = 1e6;

/// The finest tessellation, used when a tolerance is zero.
constexpr double kFinestSagMm = 0.02;

Error bad(const std::string& option, const char* what) {
  return {ErrorCode::usage, "the " + option + " " + what, option, "give a length from 0 to 1 km"};
}

}  // namespace

namespace {

Status check_length(const std::string& option, double value) {
  if (std::isnan(value)) return bad(option, "is not a number");
  if (value < 0) return bad(option, "is negative");
  if (!(value <= kMaxToleranceMm)) return bad(option, "is larger than a kilometre");
  return {};
}

}  // namespace

Status check(const Tolerances& t, std::size_t objects) {
  for (const ToleranceLength& length : kToleranceLengths)
    if (Status s = check_length(length.name_with(' '), t.*length.value_mm); !s) return s;
  if (!t.object_clearances) return {};
  if (t.object_clearances->mm.size() != objects)
    return Error{ErrorCode::usage,
                 "the clearances of objects do not have one entry per object of the scene",
                 "clearance", "build them from the same scene"};
  for (const double mm : t.object_clearances->mm)
    if (Status s = check_length("clearance of an object", mm); !s) return s;
  return {};
}

bool are_named(const std::vector<std::uint32_t>& numbers, const std::vector<Hash128>& names) {
  return names.empty() || std::ranges::all_of(numbers, [&](std::uint32_t n) {
           return n == kNoLabel || n < names.size();
         });
}

Status check(const Options& o, const Sets& sets, std::size_t objects) {
  if (Status s = check(o.tolerances, objects); !s) return s;
  if (std::isnan(o.contact_distance_mm) || o.contact_distance_mm > kMaxToleranceMm)
    return bad("contact distance", "is not a length");
  if (sets.in_a.size() != objects || sets.in_b.size() != objects ||
      (!sets.group.empty() && sets.group.size() != objects) ||
      !are_named(sets.group, sets.group_names))
    return Error{
        ErrorCode::usage,
        "the sets do not have one entry per object of the scene, or do not name all groups", "sets",
        "build them from the same scene"};
  if (std::isnan(o.reporting.min_volume_mm3) || o.reporting.min_volume_mm3 < 0)
    return Error{ErrorCode::usage, "the least volume is no volume", "min volume",
                 "give 0, or more cubic millimetres"};
  if (o.engine.curves == Curves::on && o.engine.narrow_phase != NarrowPhase::exact)
    return Error{ErrorCode::usage, "lines are checked by the exact narrow phase only", "curves",
                 "leave out --curves or --narrow-phase"};
  return {};
}

double contact_distance(const Options& options, float precision_um) {
  if (options.contact_distance_mm >= 0) return options.contact_distance_mm * geometry::kGridPerMm;
  return model::contact_distance(precision_um);
}

float coarse_step(const Options& options, float precision_um) {
  // The half spacing at which a reader warns of coarse-coordinates.
  constexpr float kCoarseUm = 250;
  return options.contact_distance_mm < 0 && precision_um > kCoarseUm ? 2 * precision_um : 0;
}

Sets one_set(const model::Scene& scene) {
  const std::size_t n = scene.model->objects.size();
  Sets sets;
  sets.in_a.assign(n, true);
  sets.in_b.assign(n, true);
  return sets;
}

model::SceneOptions scene_options(const Options& options) {
  model::SceneOptions scene;
  const Tolerances& t = options.tolerances;
  scene.sag_mm = std::max(kFinestSagMm, std::min(t.touch_gap_mm, t.touch_overlap_mm) / 4);
  if (!(scene.sag_mm <= 0.25)) scene.sag_mm = 0.25;
  return scene;
}

}  // namespace strake::clash
