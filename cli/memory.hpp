// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::cli {

/// Keeps freed memory for what comes next instead of handing it back: a run's phases reuse that of
/// earlier ones. Call it before anything large is allocated. docs/decisions has what it is worth.
void keep_freed_memory();

}  // namespace strake::cli
