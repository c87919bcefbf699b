// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

namespace strake::test {

#ifdef STRAKE_LONG_RUN
inline constexpr bool kLongRun = true;
#else
inline constexpr bool kLongRun = false;
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#else
inline constexpr bool kSanitized = false;
#endif

/// How often a test goes round: `few` times in the fast set, `many` in the nightly one.
template <class T>
[[nodiscard]] constexpr T rounds(T few, T many) {
  return kLongRun ? many : few;
}

// Sanitized programs are five to fifteen times as slow and look for other faults than tests do.

/// How often a test goes round that is sure of itself after a third of it: so often, sanitized.
template <class T>
[[nodiscard]] constexpr T rounds(T usual) {
  return kSanitized ? (usual + 2) / 3 : usual;
}

/// The numbers 1 to `usual`, from each of which a test draws all it needs: sanitized, 1 alone.
template <class T>
[[nodiscard]] auto seeds(T usual) {
  return ::testing::Range(T{1}, kSanitized ? T{2} : usual + 1);
}

}  // namespace strake::test
