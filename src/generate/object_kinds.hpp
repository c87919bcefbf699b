// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "strake/model/model.hpp"

/// The disciplines and the kinds of objects of a generated ship.
namespace strake::generate {

enum class Discipline : std::uint8_t {
  hull,
  structure,
  piping,
  ventilation,
  electrical,
  machinery,
  accommodation,
  stores,
  deck_gear,
  lines,
};

struct DisciplineInfo {
  std::string_view name;
  double kg_per_mm3;
};

inline constexpr std::array<DisciplineInfo, 10> kDisciplines{{{"HULL", 7.85e-6},
                                                              {"STRUCTURE", 7.85e-6},
                                                              {"PIPING", 3.1e-6},
                                                              {"HVAC", 7.85e-6},
                                                              {"ELECTRICAL", 2.2e-6},
                                                              {"MACHINERY", 4.5e-6},
                                                              {"ACCOMMODATION", 0.6e-6},
                                                              {"STORES", 0.9e-6},
                                                              {"DECK-GEAR", 5.2e-6},
                                                              {"CENTRE-LINES", 0}}};

/// What an object is: its three-letter code in ids, its system and its paint.
enum class ObjectKind : std::uint8_t {
#define STRAKE_KIND(name, code, system, discipline, red, green, blue, alpha, optional) name,
#include "generate/object_kinds.inc"
#undef STRAKE_KIND
  count,
};

struct KindInfo {
  std::string_view code;
  std::string_view system;
  Discipline discipline;
  model::Color color;
  bool optional;  ///< may be left out to meet the asked number of objects
};

inline constexpr std::array<KindInfo, static_cast<std::size_t>(ObjectKind::count)> kKinds{{
#define STRAKE_KIND(name, code, system, discipline, red, green, blue, alpha, optional) \
  KindInfo{code, system, Discipline::discipline, {red, green, blue, alpha}, optional},
#include "generate/object_kinds.inc"
#undef STRAKE_KIND
}};

[[nodiscard]] constexpr const KindInfo& info(ObjectKind kind) {
  return kKinds[static_cast<std::size_t>(kind)];
}

}  // namespace strake::generate
