// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::cli {

/// Runs the program with its command line and returns its exit code. Errors of the run are printed;
/// std::bad_alloc and other exceptions of the library come out.
int run(int argc, char** argv);

}  // namespace strake::cli
