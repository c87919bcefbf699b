// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <set>
#include <vector>

namespace strake::test {

/// What all schedules of a few threads can come to.
struct Interleavings {
  std::size_t states = 0;
  bool can_hang = false;  ///< in some state nobody can go on and somebody is not done
};

/// Visits every state that some schedule reaches, so that a hang is found for certain and its
/// absence proved, without a clock. State has an order (<); next(state, thread) gives the states
/// that the thread's next step may lead to, none if it has to wait or is done.
template <class State, class Next, class Done>
Interleavings explore(const State& start, unsigned threads, Next&& next, Done&& done) {
  std::set<State> found{start};
  std::vector<State> open{start};
  Interleavings all;
  while (!open.empty()) {
    const State state = open.back();
    open.pop_back();
    bool somebody_moves = false, all_done = true;
    for (unsigned thread = 0; thread < threads; ++thread) {
      all_done = all_done && done(state, thread);
      for (const State& after : next(state, thread)) {
        somebody_moves = true;
        if (found.insert(after).second) open.push_back(after);
      }
    }
    all.can_hang = all.can_hang || (!somebody_moves && !all_done);
  }
  all.states = found.size();
  return all;
}

}  // namespace strake::test
