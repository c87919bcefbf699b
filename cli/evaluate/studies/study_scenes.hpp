// SPDX-License-Identifier: Apache-2.0
// What studies look at: ships in a view, and one with a few objects that outweigh all others.
#pragma once

#include <string_view>
#include <vector>

#include "cli/evaluate/cases.hpp"
#include "cli/evaluate/contender.hpp"
#include "cli/evaluate/placed_model.hpp"
#include "cli/evaluate/studies/studies.hpp"
#include "strake/clash/options.hpp"

namespace strake::cli {

/// Returns the case of a name that there is.
[[nodiscard]] const ViewCase& view_named(std::string_view name);

/// A ship in a view, to be drawn in several ways.
struct StudyView {
  PlacedModel ship;
  hlr::View view;
};
[[nodiscard]] Result<StudyView> place_view(const StudyInput& input, const ViewCase& view,
                                           const generate::ShipOptions& options);

/// A deck with a group of imported objects of far too much detail, which lie side by side in the
/// order of objects as well: the cost of items is skewed. For drawings and for clashes, which take
/// curves in different fineness.
struct SkewedScene {
  StudyView view;
  PlacedModel clashing;
  clash::Options options;
};
[[nodiscard]] Result<SkewedScene> place_skewed_scene(const StudyInput& input);

/// Return a stage of the scene on so many workers: local or global hidden lines, or clashes. The
/// scene outlives the contender.
[[nodiscard]] Contender skewed_lines(const SkewedScene& scene, hlr::Stage stage, unsigned threads);
[[nodiscard]] Contender skewed_clashes(const SkewedScene& scene, clash::BroadPhase broad_phase,
                                       unsigned threads);

/// Returns hidden lines, local and global, and clashes.
[[nodiscard]] std::vector<Contender> skewed_stages(const SkewedScene& scene, unsigned threads);

}  // namespace strake::cli
