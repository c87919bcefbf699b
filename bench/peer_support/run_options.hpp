// SPDX-License-Identifier: Apache-2.0
// What all programs with peers take on their command lines.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace strake::bench {

struct RunOptions {
  double limit_s = 900;          ///< of a peer that is a program of its own
  std::filesystem::path scenes;  ///< the folder that keeps the scenes; empty: none
  std::filesystem::path json;    ///< the file for what was measured; empty: none

  /// Takes one of these options; false where the key is another.
  bool take(std::string_view key, const char* value) {
    if (key == "--limit")
      limit_s = std::atof(value);
    else if (key == "--scenes")
      scenes = value;
    else if (key == "--json")
      json = value;
    else
      return false;
    return true;
  }
};

}  // namespace strake::bench
