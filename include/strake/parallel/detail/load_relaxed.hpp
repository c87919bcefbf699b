// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>

namespace strake::parallel::detail {

/// word.load(std::memory_order_relaxed), for a word that is looked at before every item of a loop.
///
/// Compilers take an atomic load, relaxed or not, for a place where all memory may have changed,
/// and load again what the loop's body refers to. With g++ on x86-64 this is the same instruction
/// without that; elsewhere it is that load, or no better.
[[nodiscard]] inline std::size_t load_relaxed(const std::atomic<std::size_t>& word) {
#if defined(__x86_64__) && defined(__GNUC__)
  static_assert(sizeof(word) == sizeof(std::size_t));
  std::size_t value;
  asm volatile("mov {%1, %0|%0, %1}" : "=r"(value) : "m"(word));  // AT&T's syntax | Intel's
  return value;
#else
  return word.load(std::memory_order_relaxed);
#endif
}

}  // namespace strake::parallel::detail
