// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {

/// Writes the document of write_clash_json() without its long lists: without `results`, the list of
/// `groups`, and what is only there to compare runs (`elements`, `sheets`, `positional_ids` and
/// `tested` of the tests). It is for writers that have results in another form. Errors: cancelled,
/// out of memory.
[[nodiscard]] Status write_clash_head(const ClashContents& contents, Sink sink,
                                      const parallel::Context& context);

}  // namespace strake::report
