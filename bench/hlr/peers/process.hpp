// SPDX-License-Identifier: Apache-2.0
// Another program that runs to its end, or to the end of our patience.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace strake::bench {

struct Ended {
  enum class How { exited, not_found, over_limit, killed } how = How::exited;
  int code = 0;        ///< of `exited`
  std::string output;  ///< all that it wrote
};

/// Runs `words`, the first of which is searched in PATH. After `limit_s` seconds it is killed, with
/// all that it has started. `log` takes its output and stays.
[[nodiscard]] Ended run_to_end(const std::vector<std::string>& words, double limit_s,
                               const std::filesystem::path& log);

}  // namespace strake::bench
