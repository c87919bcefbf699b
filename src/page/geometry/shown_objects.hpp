// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"

/// Which objects of a model a page shows as they are, and of which a box must do.
namespace strake::page {

enum class ShownAs : std::uint8_t { nothing, box, shape };

/// Where not everything is shown as it is, what lies within this distance of a clash is, mm.
inline constexpr double kReachMm = 2000;

/// Which objects come first when a page cannot have everything.
struct ShowPriorities {
  report::ModelShown how = report::ModelShown::automatic;
  /// Objects in the order in which they are wanted as they are; others are wanted after those that
  /// are near.
  std::vector<model::ObjectId> first = {};
  std::vector<geometry::Vec3d> places_mm = {};  ///< near which objects are wanted next
  std::vector<model::ObjectId> last = {};       ///< those that are wanted if there is still room
  /// The objects that are in the page at all; empty: all.
  std::vector<bool> drawn = {};
};

struct ShownObjects {
  std::vector<ShownAs> of;    ///< an entry per object
  bool is_near_only = false;  ///< objects are boxes because there are too many for shapes
  bool is_full = false;       ///< some that were wanted as shapes had no room
};

/// Chooses what is shown of each object. Automatically all objects are shown as they are while
/// shapes and instances stay within what a browser takes well (decision 0085), else those that are
/// wanted, as far as there is room. The choice depends on the scene and the priorities alone.
/// Errors: cancelled, out of memory.
[[nodiscard]] Result<ShownObjects> choose_shown(const model::Scene& scene,
                                                const ShowPriorities& priorities,
                                                const parallel::Context& context);

}  // namespace strake::page
