// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/run/session.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"

namespace strake::cli {

/// Returns what the brute force has to do and about how long that takes so many workers, in words.
[[nodiscard]] std::string brute_force_cost(const hlr::BruteForceWork& work, unsigned workers);

/// Prints on standard error what the brute force will cost, before it starts.
[[nodiscard]] Status print_brute_force_cost(Session& session, const model::Scene& scene,
                                            const std::vector<bool>& drawn, const hlr::View& view,
                                            const hlr::Options& options);

}  // namespace strake::cli
