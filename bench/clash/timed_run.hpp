// SPDX-License-Identifier: Apache-2.0
// Files to clashes, with a clock beside it: what the clash benchmarks share.
#pragma once

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "clocks.hpp"
#include "strake/clash/clash.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace strake::bench {

struct TimedRun {
  std::unique_ptr<const model::Model> model;
  clash::Report report;
  double load_s = 0, scene_s = 0, clash_s = 0;

  [[nodiscard]] double total_s() const { return load_s + scene_s + clash_s; }
};

/// `sets_of` makes the sets of a scene.
template <class SetsOf>
[[nodiscard]] Result<TimedRun> timed_run(const std::vector<std::filesystem::path>& paths,
                                         const clash::Options& options, unsigned threads,
                                         SetsOf&& sets_of) {
  parallel::Team team(threads);
  const parallel::Context context{.team = &team, .stop = {}};
  TimedRun run;
  Lap lap;
  auto model = io::read_models(paths, {}, context);
  if (!model) return model.error();
  run.load_s = lap();
  run.model = std::make_unique<const model::Model>(std::move(*model));
  const auto scene = model::make_scene(*run.model, clash::scene_options(options), context);
  if (!scene) return scene.error();
  run.scene_s = lap();
  auto report = clash::detect(*scene, sets_of(*scene), options, context);
  if (!report) return report.error();
  run.report = std::move(*report);
  run.clash_s = lap();
  return run;
}

}  // namespace strake::bench
