// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::cli {

/// Keeps freed memory for what comes next instead of handing it back: a run's phases reuse that of
/// earlier ones. Call it before anything large is allocated. docs/decisions has what it is worth.
void keep_freed_memory();

/// Where memory runs out and no exception can say so (none is left for the exception either, or a
/// thread has nobody to catch it) the program says so and ends with ExitCode::memory all the same,
/// rather than abort.
void end_well_without_memory();

}  // namespace strake::cli
