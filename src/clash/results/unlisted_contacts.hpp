// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/clash/clash.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"

// Decision 0065 says which contacts stay, and why counting is not the default.
namespace strake::clash {

/// Takes the contacts out of a report's pairs and counts them in `unlisted`. Those that may be
/// something else stay: where the two do not lie side by side, where the bracket leaves the class
/// open, and where a rule allows some of the regions; and those that `stays` says. Errors:
/// cancelled.
[[nodiscard]] Status leave_out_contacts(const parallel::Context& context, Report& report);
[[nodiscard]] Status leave_out_contacts(const parallel::Context& context, Report& report,
                                        parallel::FunctionRef<bool(const Pair&)> stays);

}  // namespace strake::clash
