// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "strake/clash/clash.hpp"
#include "strake/report/decisions.hpp"

/// What becomes of a clash from run to run. docs/statuses.md has the table.
namespace strake::project {

/// Who changes a status where no person does.
inline constexpr std::string_view kProgram = "strake";

/// What a clash measures.
struct Measure {
  clash::Class cls = clash::Class::no_hit;
  double d_mm = 0;
  std::uint32_t regions = 0;  ///< 0: not counted
  friend bool operator==(const Measure&, const Measure&) = default;
};

enum class ObservationKind : std::uint8_t {
  found,
  allowed,      ///< found, and a rule allows it
  gone,         ///< the two were compared, and it is not there
  cannot_tell,  ///< the two were not compared, or not whole
};

/// What a run says of a clash; `why` names the rule, or why it cannot tell.
struct Observation {
  ObservationKind kind = ObservationKind::found;
  Measure now;
  std::string why;
};

/// What was decided about a clash so far. The status `undecided` is that of a clash which nobody
/// has decided about: New in its first run, Active in later ones.
struct LifeState {
  report::DecisionStatus status = report::DecisionStatus::undecided;
  Measure decided;             ///< what it was when it was approved
  bool has_decided_d = false;  ///< whether that is known
};

/// What a run makes of it.
struct LifeChange {
  report::DecisionStatus status = report::DecisionStatus::undecided;
  bool is_new = false;   ///< it counts as found for the first time again
  bool is_there = true;  ///< false: it is gone, or a rule allows it
  report::Reopened reopened = report::Reopened::no;
  std::string cause = {};  ///< why the status changed; empty: it did not
};

/// Returns it. An approved clash comes back where its class is severer, where d is less than it was
/// by more than `deeper_mm`, and where the two meet at more places.
[[nodiscard]] LifeChange next(const LifeState& state, const Observation& observed,
                              double deeper_mm);

}  // namespace strake::project
