// SPDX-License-Identifier: Apache-2.0
#include "cli/run/utc_time.hpp"

#include <fmt/chrono.h>

#include <chrono>

namespace strake::cli {

std::string utc_time() {
  const auto now =
      std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}Z", now);
}

}  // namespace strake::cli
