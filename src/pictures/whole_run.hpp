// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "report/report_writers.hpp"
#include "strake/report/clash.hpp"

/// All clashes of a run at once.
namespace strake::pictures {

/// Writes a drawing of the model on A3 as SVG: objects that clash in the colour of their worst
/// class, the rest thin, a numbered mark at each group or clash, and how many there are of each
/// class. Marks are numbered as groups are in their order, without groups from the worst on.
/// Errors: usage where the contents have no scene; cancelled, out of memory.
[[nodiscard]] Status write_overview(const report::ClashContents& contents, report::Sink sink,
                                    const parallel::Context& context);

/// Writes a model of the results as GLB: of each result that no rule allows a marker at its point,
/// in the colour of its class, with key, class, d_mm and test as attributes; and the objects that
/// they are about. Errors: output for more than 4 GiB; cancelled, out of memory.
[[nodiscard]] Status write_markers(const report::ClashContents& contents, report::Sink sink,
                                   const parallel::Context& context);

/// Both, as formats of clash results.
[[nodiscard]] std::span<const report::ClashWriter> picture_writers();

}  // namespace strake::pictures
