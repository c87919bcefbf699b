// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "strake/clash/clash.hpp"
#include "strake/model/model.hpp"
#include "strake/report/decisions.hpp"

namespace strake::cli {

/// Returns a sentence that says what makes most of the hits, which a list of the worst does not
/// show: parts of one assembly that overlap, where these are half of them; or else two assemblies,
/// as a rack that stands in a duct, where these have a quarter. Empty where nothing does, and below
/// 20 hits. Hits that decisions settle do not count; null: there are none.
[[nodiscard]] std::string concentration_hint(const clash::Findings& findings,
                                             const model::Model& model,
                                             const report::DecidedResults* decided);

}  // namespace strake::cli
