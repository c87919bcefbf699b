// SPDX-License-Identifier: Apache-2.0
#include "cli/run/authorship.hpp"

#include <fmt/chrono.h>
#include <pwd.h>
#include <unistd.h>

#include <array>
#include <chrono>

namespace strake::cli {

std::string utc_time() {
  const auto now =
      std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}Z", now);
}

std::string person() {
  passwd entry{};
  passwd* found = nullptr;
  std::array<char, 4096> texts{};
  const uid_t user = ::geteuid();
  if (::getpwuid_r(user, &entry, texts.data(), texts.size(), &found) == 0 && found != nullptr)
    return found->pw_name;
  return "user " + std::to_string(user);
}

}  // namespace strake::cli
