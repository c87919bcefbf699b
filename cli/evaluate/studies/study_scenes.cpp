// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/studies/study_scenes.hpp"

#include <algorithm>
#include <utility>

#include "strake/clash/clash.hpp"

namespace strake::cli {

const ViewCase& view_named(std::string_view name) {
  return *std::ranges::find(view_cases(), name, &ViewCase::name);
}

Result<StudyView> place_view(const StudyInput& input, const ViewCase& view,
                             const generate::ShipOptions& options) {
  Result<PlacedModel> ship = place_ship(options, {}, input.stop);
  if (!ship) return ship.error();
  const hlr::View hlr_view = view_of(view, ship->box);
  return StudyView{std::move(*ship), hlr_view};
}

Result<SkewedScene> place_skewed_scene(const StudyInput& input) {
  input.narrate("generating a ship with imported objects");
  const ViewCase& view = view_named("crowd");
  const generate::ShipOptions ship = viewed_ship(view.ship, input.settings.scale);
  Result<StudyView> drawn = place_view(input, view, ship);
  if (!drawn) return drawn.error();
  const clash::Options options{.tolerances = {.clearance_mm = generate::Truth::kClearanceMm}};
  Result<PlacedModel> clashing = place_ship(ship, clash::scene_options(options), input.stop);
  if (!clashing) return clashing.error();
  return SkewedScene{std::move(*drawn), std::move(*clashing), options};
}

Contender skewed_lines(const SkewedScene& scene, hlr::Stage stage, unsigned threads) {
  hlr::Options options;
  options.stage = stage;
  return drawing_contender(
      stage == hlr::Stage::local ? "local hidden lines" : "global hidden lines", threads,
      scene.view.ship.scene, scene.view.view, options);
}

Contender skewed_clashes(const SkewedScene& scene, clash::BroadPhase broad_phase,
                         unsigned threads) {
  clash::Options options = scene.options;
  options.engine.broad_phase = broad_phase;
  return clash_contender("clash detection", threads, scene.clashing.scene, options);
}

std::vector<Contender> skewed_stages(const SkewedScene& scene, unsigned threads) {
  return {skewed_lines(scene, hlr::Stage::local, threads),
          skewed_lines(scene, hlr::Stage::global, threads),
          skewed_clashes(scene, clash::BroadPhase::tree, threads)};
}

}  // namespace strake::cli
