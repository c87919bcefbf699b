// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "strake/report/file_match.hpp"

namespace strake::report {

/// How much of a file of the old run is in one of the new run, and the other way round.
struct FileLikeness {
  std::uint64_t ids_before = 0, ids_after = 0;  ///< lasting ids that the results name
  std::uint64_t found_after = 0;                ///< ids_before that the new file has
  std::uint64_t found_before = 0;               ///< ids_after that the old file has
  std::uint64_t common = 0, of = 0;             ///< of the ids that either result names
  std::uint64_t places_before = 0, places_after = 0, common_places = 0;
  bool is_excerpt = false;  ///< the old run is: what it lacks says nothing

  /// Whether the two are one file, as far as they themselves tell.
  [[nodiscard]] bool is_one_file() const;
  /// Whether places decide, as one of the two has no lasting ids, or neither has: a few objects
  /// that have names now say nothing of all others.
  [[nodiscard]] bool by_places() const {
    return common == 0 && (ids_before == 0 || ids_after == 0);
  }
  /// Whether there is something in both files to compare.
  [[nodiscard]] bool is_known() const {
    return ids_before + places_before > 0 && ids_after + places_after > 0;
  }
};

[[nodiscard]] FileLikeness compare_contents(const RunFiles& before, const FileContents& old_file,
                                            const RunFiles& after, const FileContents& new_file);

/// Whether a file of a run has an object of this id.
[[nodiscard]] bool has_object(const RunFiles& run, const FileContents& file, std::string_view id);

/// Whether another file may have more than half of the ids of a file: it has one of some that are
/// spread over them. It spares counting the ids of files that have nothing to do with each other.
[[nodiscard]] bool may_have_most(const RunFiles& run, const FileContents& file,
                                 const std::vector<std::string>& ids);

/// Whether `some` is more than half of `all`, which is not none.
[[nodiscard]] constexpr bool is_most(std::uint64_t some, std::uint64_t all) {
  return 2 * some > all;
}

/// Whether so many ids in common are too many for chance.
[[nodiscard]] bool exceeds_chance(std::uint64_t ids, const FileContents& file,
                                  const FileContents& other);

/// Whether a count is so much larger than that of a rival that it is no chance.
[[nodiscard]] constexpr bool is_clearly_more(std::uint64_t count, std::uint64_t rival) {
  return rival * 10 < count * 9;
}

/// Whether one pair of files is clearly more alike than another.
[[nodiscard]] bool is_clearly_more_alike(const FileLikeness& one, const FileLikeness& rival);

}  // namespace strake::report
