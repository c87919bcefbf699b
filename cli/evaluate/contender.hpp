// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/evaluate/published/sheet_pixels.hpp"
#include "strake/clash/options.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::cli {

/// The document that a user would get.
struct Published {
  std::string hash;                        ///< of its bytes
  std::optional<SheetPixels> pixels = {};  ///< of a drawing
};

/// What a contender came to. The functions refer to the scene.
struct Computed {
  std::map<std::string, std::uint64_t> counters;  ///< of its work
  std::function<std::string()> hash;              ///< of the result
  std::function<Result<Published>(const parallel::Context&)> publish;
};

/// How a contender must compare with the sequential run.
enum class MustEqual : std::uint8_t {
  bytes,    ///< the result and the published document
  nothing,  ///< it is no exact method: its result is counted, not compared
};

/// One way to do a stage, on so many workers.
struct Contender {
  std::string name;
  unsigned threads = 1;
  bool limited = false;  ///< stopped after the limit, and run in one round only
  MustEqual must_equal = MustEqual::bytes;
  std::function<Result<Computed>(const parallel::Context&)> compute;
};

/// Return one way to do a stage.
[[nodiscard]] Contender drawing_contender(std::string name, unsigned threads,
                                          const model::Scene& scene, const hlr::View& view,
                                          const hlr::Options& options);
[[nodiscard]] Contender clash_contender(std::string name, unsigned threads,
                                        const model::Scene& scene, const clash::Options& options);

/// Returns who takes part in a stage of drawing: the sequential path, again, ours on each number of
/// workers above one, and the thesis's push, without culling, on one and on the most workers.
[[nodiscard]] std::vector<Contender> drawing_contenders(const model::Scene& scene,
                                                        const hlr::View& view, hlr::Stage stage,
                                                        const std::vector<unsigned>& threads);

/// Returns who takes part in clash detection: the same, and as the thesis's way all pairs of boxes,
/// sphere subdivision, and both.
[[nodiscard]] std::vector<Contender> clash_contenders(const model::Scene& scene,
                                                      const clash::Options& options,
                                                      const std::vector<unsigned>& threads);

}  // namespace strake::cli
