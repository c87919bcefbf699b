// SPDX-License-Identifier: Apache-2.0
#include <string_view>
#include <vector>

#include "strake/clash/clash.hpp"

namespace strake::clash {

std::string_view name(Class cls) {
  switch (cls) {
    case Class::no_hit:
      return "NO_HIT";
    case Class::clearance_violation:
      return "CLEARANCE_VIOLATION";
    case Class::contact:
      return "CONTACT";
    case Class::hit:
      return "HIT";
  }
  return "";
}

std::string_view name(Relation relation) {
  switch (relation) {
    case Relation::separate:
      return "SEPARATE";
    case Relation::abut_outside:
      return "ABUT_OUTSIDE";
    case Relation::abut_inside:
      return "ABUT_INSIDE";
    case Relation::interfere:
      return "INTERFERE";
    case Relation::a_in_b:
      return "A_IN_B";
    case Relation::b_in_a:
      return "B_IN_A";
    case Relation::duplicate:
      return "DUPLICATE";
    case Relation::cross:
      return "CROSS";
  }
  return "";
}

std::string_view name(Level level) {
  switch (level) {
    case Level::hard:
      return "hard";
    case Level::soft:
      return "soft";
    case Level::insulation:
      return "insulation";
    case Level::none:
      return "none";
  }
  return "";
}

std::vector<std::string_view> flag_names(std::uint16_t flags) {
  std::vector<std::string_view> names;
  if ((flags & kBorderline) != 0) names.push_back("BORDERLINE");
  if ((flags & kUncertain) != 0) names.push_back("UNCERTAIN");
  if ((flags & kOpen) != 0) names.push_back("OPEN");
  if ((flags & kInverted) != 0) names.push_back("INVERTED");
  return names;
}

}  // namespace strake::clash
