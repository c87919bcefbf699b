// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/output/stats.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::cli {

/// Returns "900 objects: 400 drawn, 496 hidden, 4 failed; 2 without some of their geometry", whose
/// fates add up. It names files that end early, too.
[[nodiscard]] std::string object_summary_line(const hlr::Account& account,
                                              const model::Model& model);

/// Returns "1:50", of a view in perspective "1:50 in the plane of the target", where alone it
/// holds.
[[nodiscard]] std::string scale_words(const drawing::NeutralDrawing& drawing);

/// Returns a sentence for each of what was asked to be left whole or out: "3 objects are left whole
/// by the sections", "flush seams of 12 edges are left out".
[[nodiscard]] std::vector<std::string> left_alone_lines(const drawing::NeutralDrawing& drawing);

/// Adds every fate to --stats, each name behind `prefix`.
void count_objects(Stats& stats, const hlr::Account& account, std::string_view prefix);

}  // namespace strake::cli
