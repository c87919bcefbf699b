// SPDX-License-Identifier: Apache-2.0
// What of the results of a test is in its report.
#pragma once

#include <cstdint>

#include "clash/results/object_results.hpp"
#include "strake/clash/clash.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"

// Decision 0065 says which contacts stay, and why counting is not the default.
namespace strake::clash {

/// Returns the count that a result of a class is in.
[[nodiscard]] std::uint64_t& count_of(NotReported::Counts& counts, Class cls, bool allowed);

/// Takes out of a report's pairs what Options::reporting says that the test does not report, and
/// counts it in `not_reported`. A hit of which the bracket of its volume leaves open whether it is
/// reported stays, flagged kUncertain. `pairs` still carry the number of their first result in
/// Pair::first_region. Errors: cancelled.
[[nodiscard]] Status filter_reported(const PartResults& results, const Sets& sets,
                                     const parallel::Context& context, Report& report);

/// Returns how many regions of a pair are listed, those that a rule allows too.
[[nodiscard]] std::uint32_t listed_regions(const Pair& pair, const Options& options);

/// Brings Report::regions into the order of the pairs, without those of pairs that are not there
/// any more.
void put_regions_in_order(Report& report);

/// Takes the contacts out of a report's pairs and counts them in `unlisted`. Those that may be
/// something else stay: where the two do not lie side by side, where the bracket leaves the class
/// open, and where a rule allows some of the regions; and those that `stays` says. Errors:
/// cancelled.
[[nodiscard]] Status leave_out_contacts(const parallel::Context& context, Report& report);
[[nodiscard]] Status leave_out_contacts(const parallel::Context& context, Report& report,
                                        parallel::FunctionRef<bool(const Pair&)> stays);

}  // namespace strake::clash
