// SPDX-License-Identifier: Apache-2.0
#include "rules/profiles.hpp"

#include <algorithm>
#include <array>

#include "rules/profile_texts.hpp"

namespace strake::rules {

std::span<const Profile> profiles() {
  static constexpr std::array<Profile, 3> kProfiles{
      {{"plant", "process plants, platforms and pipe racks, as RVM above all", kPlantText},
       {"ship", "ships and sections of them", kShipText},
       {"building", "buildings, as glTF made from IFC", kBuildingText}}};
  return kProfiles;
}

const Profile* find_profile(std::string_view name) {
  const std::span<const Profile> all = profiles();
  const auto found = std::ranges::find(all, name, &Profile::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace strake::rules
