// SPDX-License-Identifier: Apache-2.0
// A producer that hands items to consumers through a queue, a mutex and a condition variable, step
// by step, with the ways of telling the end that go wrong and the one that does not.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "support/interleavings.hpp"

namespace strake::test {

enum class End : std::uint8_t {
  flag_outside_lock,  ///< the producer raises the flag without the mutex, then wakes all
  count_of_items,     ///< the number of finished producers is raised once an item
  flag_under_lock,    ///< the right one
};

class Handover {
 public:
  Handover(End end, unsigned items) : end_(end), items_(static_cast<std::uint8_t>(items)) {}

  /// One producer and two consumers under every schedule.
  [[nodiscard]] Interleavings explored() const {
    return explore(
        State(), kThreads, [this](const State& s, unsigned thread) { return next(s, thread); },
        [](const State& s, unsigned thread) { return s.at[thread] == Step::done; });
  }

 private:
  static constexpr std::int8_t kSequentialContext = -1;
  static constexpr unsigned kThreads = 3, kProducer = 0;

  enum class Step : std::uint8_t { begin, locked, sleeping, woken, flag_raised, done };

  struct State {
    std::array<Step, kThreads> at{};
    std::int8_t owner = kSequentialContext;  ///< of the mutex
    std::uint8_t made = 0, queued = 0, taken = 0, finished = 0;
    bool about_to_sleep = false;  ///< the owner found nothing to do and has not let go yet
    auto operator<=>(const State&) const = default;
  };

  static void wake_all(State& s) {
    for (Step& step : s.at)
      if (step == Step::sleeping) step = Step::woken;
  }
  /// Which sleeper is woken is left to the system: one state for each.
  static std::vector<State> with_one_woken(const State& s) {
    std::vector<State> all;
    for (unsigned thread = 0; thread < kThreads; ++thread)
      if (s.at[thread] == Step::sleeping) {
        all.push_back(s);
        all.back().at[thread] = Step::woken;
      }
    if (all.empty()) all.push_back(s);
    return all;
  }

  [[nodiscard]] std::vector<State> next(const State& s, unsigned thread) const {
    const Step at = s.at[thread];
    if (at == Step::sleeping || at == Step::done) return {};
    return thread == kProducer ? produce(s) : consume(s, thread);
  }

  [[nodiscard]] std::vector<State> produce(State s) const {
    Step& at = s.at[kProducer];
    const bool all_made = s.made == items_;
    if (at == Step::flag_raised) {
      wake_all(s);
      at = Step::done;
      return {s};
    }
    if (at == Step::begin && all_made && end_ != End::flag_under_lock) {
      at = end_ == End::flag_outside_lock ? Step::flag_raised : Step::done;
      if (end_ == End::flag_outside_lock) s.finished = 1;
      return {s};
    }
    if (at == Step::begin) {
      if (s.owner != kSequentialContext) return {};
      s.owner = kProducer;
      at = Step::locked;
      return {s};
    }
    s.owner = kSequentialContext;
    at = all_made ? Step::flag_raised : Step::begin;
    if (all_made) {
      s.finished = 1;
      return {s};
    }
    ++s.made;
    ++s.queued;
    if (end_ == End::count_of_items) {
      ++s.finished;
      wake_all(s);
      return {s};
    }
    return with_one_woken(s);
  }

  [[nodiscard]] std::vector<State> consume(State s, unsigned thread) const {
    Step& at = s.at[thread];
    if (at != Step::locked) {
      // Whether there is anything left is asked without the mutex.
      if (at == Step::begin && s.taken == items_) {
        at = Step::done;
        return {s};
      }
      if (s.owner != kSequentialContext) return {};
      s.owner = static_cast<std::int8_t>(thread);
      at = Step::locked;
      return {s};
    }
    if (s.about_to_sleep) {
      s.about_to_sleep = false;
      s.owner = kSequentialContext;
      at = Step::sleeping;
      return {s};
    }
    if (s.queued == 0 && s.finished != 1) {
      s.about_to_sleep = true;
      return {s};
    }
    s.owner = kSequentialContext;
    at = s.queued == 0 ? Step::done : Step::begin;
    if (s.queued > 0) {
      --s.queued;
      ++s.taken;
    }
    return {s};
  }

  End end_;
  std::uint8_t items_;
};

}  // namespace strake::test
