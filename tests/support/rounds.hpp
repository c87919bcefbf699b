// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// How often a test goes round: `few` times in the fast set, `many` in the nightly one. Sanitized
/// programs are five to fifteen times as slow and look for other faults: a third of the few.
template <class T>
[[nodiscard]] constexpr T rounds(T few, T many) {
  if (kLongRun) return many;
  return kSanitized ? (few + 2) / 3 : few;
}
template <class T>
[[nodiscard]] constexpr T rounds(T few) {
  return rounds(few, few);
}

}  // namespace strake::test
