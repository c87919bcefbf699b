// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "page/blocks/block.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"

namespace strake::page {

/// Writes a block as the element that docs/formats/page.md describes: base64 of one gzip member
/// without time and name. The team makes and compresses pieces while what is done goes out in
/// order, so that some megabytes are held at a time; the bytes are the same for any team. What the
/// sink throws comes out. Errors: cancelled, out of memory.
[[nodiscard]] Status write_block(const Block& block, report::Sink sink,
                                 const parallel::Context& context);

}  // namespace strake::page
