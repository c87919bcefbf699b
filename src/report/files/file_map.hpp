// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "strake/report/file_match.hpp"

namespace strake::report {

enum class RunSide : std::uint8_t { before, after };

[[nodiscard]] constexpr RunSide opposite_run(RunSide run) {
  return run == RunSide::before ? RunSide::after : RunSide::before;
}

/// Tells what an object of one run is called in the other, by the files that were matched. It maps
/// objects one to one: of two that would be one, at most one is, that of the file which is matched
/// as a whole.
class FileMap {
 public:
  using Has = std::function<bool(std::string_view label, std::string_view id)>;

  /// The matches must outlive this.
  FileMap(const FileMatches& files, Has has_before, Has has_after);

  /// Whether every object is called in the other run as in its own.
  [[nodiscard]] bool is_identity() const { return identity_; }

  /// Returns the label under which the other run would have an object of `run`; where its file has
  /// no counterpart, one that no file has.
  [[nodiscard]] std::string label_in_other(RunSide run, std::string_view label,
                                           std::string_view id) const;

  /// Returns one text for all files of both runs that are matched with each other, directly or by
  /// others.
  [[nodiscard]] std::string group_of(RunSide run, std::string_view label) const;

 private:
  /// The files of the other run in which objects of a file may be.
  struct LinkedFiles {
    std::string_view whole;  ///< the file that it is; empty: none
    std::vector<std::string_view> parts;
    std::string_view group;
  };
  using ByLabel = std::map<std::string_view, LinkedFiles>;

  [[nodiscard]] const ByLabel& links(RunSide run) const {
    return links_[static_cast<std::size_t>(run)];
  }
  [[nodiscard]] bool has(RunSide run, std::string_view label, std::string_view id) const {
    return has_[static_cast<std::size_t>(run)](label, id);
  }
  [[nodiscard]] std::string_view holder(RunSide run, std::string_view label,
                                        std::string_view id) const;
  void link(const FileMatches& files);
  void group(const FileMatches& files);

  bool identity_ = true;
  std::array<Has, 2> has_;
  std::array<ByLabel, 2> links_;
};

}  // namespace strake::report
