// SPDX-License-Identifier: Apache-2.0
#include "cli/run/person.hpp"

#include <pwd.h>
#include <unistd.h>

#include <array>

namespace strake::cli {

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
