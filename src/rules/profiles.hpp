// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

/// Rules files for a first look, which the library brings along: `rules/NAME.toml` of the project,
/// compiled in.
namespace strake::rules {

struct Profile {
  std::string_view name;   ///< "plant"
  std::string_view about;  ///< what it is for, in a few words
  std::string_view text;   ///< the rules file

  /// Returns what messages and results call its file: "plant.toml".
  [[nodiscard]] std::string file() const { return std::string(name) + ".toml"; }
};

/// Returns all profiles. They have no tests and no tolerances of their own: those of a run stay.
[[nodiscard]] std::span<const Profile> profiles();

/// Returns the profile of a name; null if there is none.
[[nodiscard]] const Profile* find_profile(std::string_view name);

}  // namespace strake::rules
