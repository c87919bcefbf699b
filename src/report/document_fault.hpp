// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace strake::report {

/// What is wrong with a document and where in it; thrown, and caught where the file's name is
/// known.
struct DocumentFault {
  std::string where, what;
};

[[nodiscard]] inline DocumentFault lacks(const std::string& where, std::string_view key) {
  return {where, "has no \"" + std::string(key) + "\""};
}

[[nodiscard]] inline DocumentFault is_not(const std::string& where, std::string_view key,
                                          const char* what) {
  return {where, "\"" + std::string(key) + "\" is no " + what};
}

}  // namespace strake::report
