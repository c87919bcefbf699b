// SPDX-License-Identifier: Apache-2.0
// What a program beside Strake's did on one scene: plain data, which peer programs write and an
// evaluation keeps.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace strake::cli {

// What became of a peer. It has times only where its result agrees: seconds for another result say
// nothing.
inline constexpr std::string_view kMeasured = "measured";
inline constexpr std::string_view kDisagrees = "disagrees";  ///< by more than is stated: an error
inline constexpr std::string_view kOverLimit = "over limit";
inline constexpr std::string_view kFailed = "failed";
inline constexpr std::string_view kNotThere = "not there";  ///< its program is not installed
inline constexpr std::array<std::string_view, 5> kPeerOutcomes{kMeasured, kDisagrees, kOverLimit,
                                                               kFailed, kNotThere};

struct PeerRow {
  std::string scene;  ///< "ship of 2000 objects, turned"
  std::uint64_t objects = 0, triangles = 0;
  unsigned threads = 0;  ///< that the peer used
  std::string who, version;
  std::string answers;  ///< what is requested of it: "pairs whose triangles meet"
  double cpu_s = 0, wall_s = 0;
  double ours_cpu_s = 0, ours_wall_s = 0;  ///< Strake's on the same triangles, in the same run
  std::string outcome{kNotThere};          ///< one of kPeerOutcomes
  /// How its result compares with Strake's, or why it has none.
  std::string result;
};

}  // namespace strake::cli
