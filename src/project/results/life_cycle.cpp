// SPDX-License-Identifier: Apache-2.0
#include "project/results/life_cycle.hpp"

#include <fmt/format.h>

namespace strake::project {
namespace {

using report::DecisionStatus;
using report::Reopened;

Reopened reopened(const LifeState& state, const Measure& now, double deeper_mm) {
  if (state.status != DecisionStatus::approved || !state.has_decided_d) return Reopened::no;
  const Measure& then = state.decided;
  if (now.cls > then.cls) return Reopened::severer;
  if (now.d_mm < then.d_mm - deeper_mm) return Reopened::deeper;
  return then.regions > 0 && now.regions > then.regions ? Reopened::more_regions : Reopened::no;
}

std::string cause_of(Reopened why, const Measure& then, const Measure& now) {
  if (why == Reopened::severer)
    return fmt::format("approved as {}, and {} now", name(then.cls), name(now.cls));
  if (why == Reopened::deeper)
    return fmt::format("approved at d = {:.3f} mm, and {:.3f} mm now", then.d_mm, now.d_mm);
  return fmt::format("approved at {} {}, and at {} now", then.regions,
                     then.regions == 1 ? "place" : "places", now.regions);
}

LifeChange found(const LifeState& state, const Observation& observed, double deeper_mm) {
  if (state.status == DecisionStatus::resolved)
    return {DecisionStatus::undecided, true, true, Reopened::found_again, "found again"};
  const Reopened why = reopened(state, observed.now, deeper_mm);
  if (why == Reopened::no) return {.status = state.status};
  return {DecisionStatus::undecided, false, true, why, cause_of(why, state.decided, observed.now)};
}

LifeChange resolved(const LifeState& state, std::string cause) {
  LifeChange change{.status = DecisionStatus::resolved, .is_there = false};
  if (state.status != DecisionStatus::resolved) change.cause = std::move(cause);
  return change;
}

}  // namespace

LifeChange next(const LifeState& state, const Observation& observed, double deeper_mm) {
  switch (observed.kind) {
    case ObservationKind::found:
      return found(state, observed, deeper_mm);
    case ObservationKind::allowed:
      // An approval holds whether a rule says the same or not, and is there when the rule goes.
      if (state.status == DecisionStatus::approved) return {.status = state.status};
      return resolved(state, "allowed by rule '" + observed.why + "'");
    case ObservationKind::gone:
      return resolved(state, "no longer found");
    case ObservationKind::cannot_tell:
      break;
  }
  return {.status = state.status};
}

}  // namespace strake::project
