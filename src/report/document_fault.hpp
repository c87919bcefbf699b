// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace strake::report {

/// What is wrong with a document and where in it; thrown, and caught where the file's name is
/// known.
struct DocumentFault {
  std::string where, what;
  bool edited = false;  ///< no run wrote it so: something was changed since
};

/// A document that says two things which exclude each other.
[[nodiscard]] inline DocumentFault contradicts(std::string where, std::string what) {
  return {std::move(where), std::move(what), true};
}

[[nodiscard]] inline DocumentFault lacks(const std::string& where, std::string_view key) {
  return {where, "has no \"" + std::string(key) + "\""};
}

[[nodiscard]] inline DocumentFault is_not(const std::string& where, std::string_view key,
                                          const char* what) {
  return {where, "\"" + std::string(key) + "\" is no " + what};
}

}  // namespace strake::report
