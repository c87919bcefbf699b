// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::cli {

/// Keeps freed memory for what comes next instead of handing it back: a run's phases reuse that of
/// earlier ones. Call it before anything large is allocated. docs/decisions says what it is worth.
void keep_freed_memory();

/// Makes the program print a message and end with ExitCode::memory, rather than abort, where memory
/// runs out and no exception can say so (none is left for the exception either, or a thread has
/// nobody to catch it).
void end_well_without_memory();

}  // namespace strake::cli
