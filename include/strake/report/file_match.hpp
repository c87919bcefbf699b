// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"

/// Tells which file of one run is which of another, so that files that were renamed are compared.
///
///     const auto files = report::match_files(*old_run, *new_run, {});
///     const report::ClashDiff diff = report::compare(*old_run, *new_run, *files);
namespace strake::report {

/// A file of a run, and what the result of the run holds of it.
struct FileContents {
  std::string label;
  std::vector<std::string> ids;  ///< lasting ids of its objects that the result names, ascending
  std::vector<Hash128> places;   ///< hashes of what lies where in it, ascending
};

/// The files of a run.
struct RunFiles {
  std::vector<FileContents> files;
  /// Whether a file of the run has an object of this id; absent: the ids above are all that there
  /// are.
  std::function<bool(std::string_view label, std::string_view id)> has;
  /// Of the old run: it holds some of what the run had, as a file of decisions does. What the new
  /// run has beyond it makes no file another.
  bool is_excerpt = false;
};

/// Why two files are taken for one.
enum class FileRelation : std::uint8_t {
  same_label,  ///< they are called alike
  requested,   ///< the caller says so
  renamed,     ///< more than half of either is in the other
  split,       ///< more than half of the new file was in the old one, which is also another's
  merged,      ///< more than half of the old file is in the new one, which is also another's
};

struct FileMatch {
  std::string before, after;
  FileRelation relation = FileRelation::same_label;
  /// How many ids are in both files, of those that the results name of either; of a split or merged
  /// file, of those of the part. With `by_places`, how many places. Both are 0 where one of the
  /// files has neither ids nor places.
  std::uint64_t common = 0, of = 0;
  bool by_places = false;  ///< one of the files has no lasting ids, or neither has
  friend bool operator==(const FileMatch&, const FileMatch&) = default;
};

/// A file that is about equally like several of the other run.
struct AmbiguousFile {
  std::string label;
  bool of_after = false;  ///< it is of the new run
  std::vector<std::string> candidates;
  friend bool operator==(const AmbiguousFile&, const AmbiguousFile&) = default;
};

/// Which files of two runs are taken for one. One without any says that labels decide.
struct FileMatches {
  std::vector<FileMatch> matches;        ///< by label of the new file, then of the old one
  std::vector<AmbiguousFile> ambiguous;  ///< those of the old run first
  std::vector<std::string> only_before, only_after;  ///< files that are like none of the other run

  /// Whether files of equal labels are matched, and no others.
  [[nodiscard]] bool by_label_alone() const;
};

/// A file of the old run, and what it is in the new one.
struct FilePair {
  std::string before, after;
};

/// Matches the files of two runs.
///
/// The `given_pairs` come first, then files of equal labels. What is left goes by what is
/// in it. Two files are one, renamed, where more than half of the lasting ids of either that the
/// results name are in the other: at least three of them, twenty where both have places and share
/// none, or fewer with more than half of the places in common (where the old run is an excerpt, of
/// what it has alone); where one of them has no lasting
/// ids, places decide alone. Of several candidates one is taken only if the others have less than
/// nine tenths of its ids in common, or, where ids do not decide, of its places; else none is, and
/// all are ambiguous. A file of which more than half of the ids, as many at least, are in a file of
/// the other run and not in the counterpart of that one is a part of it.
///
/// Errors: usage for a pair that is requested and names a file that its run does not have, or one
/// that another pair names.
[[nodiscard]] Result<FileMatches> match_files(const RunFiles& before, const RunFiles& after,
                                              std::span<const FilePair> given_pairs = {});

/// Reads pairs as they are written: OLD=NEW, where either label may have a '=' itself. Errors:
/// usage.
[[nodiscard]] Result<std::vector<FilePair>> parse_file_pairs(std::span<const std::string> texts,
                                                             const RunFiles& before,
                                                             const RunFiles& after);

/// Returns lines for a terminal: files that are taken as renamed, as split or merged, those that
/// are ambiguous, and those that are left over in both runs. Empty where labels alone decide and
/// either run has all files of the other.
[[nodiscard]] std::string file_matches_text(const FileMatches& files);

}  // namespace strake::report
