// SPDX-License-Identifier: Apache-2.0
#include "cli/run/on_cluster.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace strake::cli {

namespace {

namespace fs = std::filesystem;

/// Python runs this. It says what to install where the package is not there. No module is taken
/// from the folder of the run: what lies beside a model may be anybody's.
constexpr const char* kStart = R"(import sys
sys.path = [folder for folder in sys.path if folder]
try:
    from strake.cluster_program import main
except ImportError as error:
    sys.stderr.write("strake: error: --scheduler: " + (sys.executable or "python3")
                     + " lacks the package strake, or what it needs: " + str(error)
                     + " (pip install 'strake[cluster]', or let STRAKE_PYTHON name a Python "
                     + "that has it)\n")
    sys.exit(2)
sys.exit(main(sys.argv[1:]))
)";

/// Returns the Python that has the package: as the environment says, beside the program, as pip
/// installs both, or in PATH.
std::string python() {
  if (const char* const given = ::secure_getenv("STRAKE_PYTHON"); given != nullptr && *given != 0)
    return given;
  std::error_code failed;
  const fs::path beside = fs::read_symlink("/proc/self/exe", failed).parent_path() / "python3";
  if (!failed && fs::exists(beside, failed)) return beside.string();
  return "python3";
}

}  // namespace

Error go_on_cluster(std::span<char* const> words) {
  const std::string program = python();
  std::vector<std::string> all{program, "-c", kStart};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  arguments.reserve(all.size() + 1);
  for (std::string& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execvp(arguments.front(), arguments.data());
  return {ErrorCode::usage,
          "'" + program + "' cannot be run: " + std::generic_category().message(errno),
          "--scheduler",
          "install Python and pip install 'strake[cluster]', or let STRAKE_PYTHON name a Python "
          "that has it"};
}

}  // namespace strake::cli
