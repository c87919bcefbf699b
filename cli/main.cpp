// SPDX-License-Identifier: Apache-2.0
#include <exception>
#include <new>
#include <string>

#include "cli/output/console.hpp"
#include "cli/program.hpp"
#include "cli/run/exit_code.hpp"
#include "cli/run/memory.hpp"

int main(int argc, char** argv) {
  try {
    return strake::cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    strake::cli::print_out_of_memory();
    return static_cast<int>(strake::cli::ExitCode::memory);
  } catch (const std::exception& error) {
    strake::cli::Console().error(std::string("internal fault: ") + error.what() +
                                 " (please report it with the command line)");
    return static_cast<int>(strake::cli::ExitCode::internal);
  }
}
