// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// Makes room for what the solvers count by object, as the options have it.
void make_room_for_counts(const Options& options, std::size_t objects, Drawing& drawing);

/// Removes what is left of an object of which nothing is visible, points on paper and clipped
/// pieces, where its hidden pieces were left out: they would be most of the drawing of a large
/// model. Errors: cancelled, out of memory.
[[nodiscard]] Status leave_out_hidden_objects(const parallel::Context& context, Drawing& drawing);

/// Returns the fate of every object of a scene, from the pieces and the left-out edges of a
/// drawing. `drawn` is by object. Errors: cancelled.
[[nodiscard]] Result<Account> account_of(const model::Scene& scene, const std::vector<bool>& drawn,
                                         const Drawing& drawing, const parallel::Context& context);

/// Fills the counters that are sums over objects: feature edges, specks, edges left out.
void sum_up_lines(Drawing& drawing);

/// Adds a warning for each object that is degenerate, failed, or drawn without some of its
/// geometry, but not for wires that are seen end-on.
void report_defects(const model::Model& model, const Account& account, Diagnostics& diagnostics);

/// Returns whether report_defects() gives diagnostics this code.
[[nodiscard]] bool is_code_of_defect(std::string_view code);

}  // namespace strake::hlr
