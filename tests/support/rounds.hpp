// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::test {

#ifdef STRAKE_LONG_RUN
inline constexpr bool kLongRun = true;
#else
inline constexpr bool kLongRun = false;
#endif

/// How often a test goes round: `few` times in the fast set, `many` in the nightly one.
template <class T>
[[nodiscard]] constexpr T rounds(T few, T many) {
  return kLongRun ? many : few;
}

}  // namespace strake::test
