// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/files/file_map.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/report/decisions.hpp"
#include "strake/report/file_match.hpp"

namespace strake::report {

/// Which file of a model had which name when decisions were made.
struct DecidedFiles {
  FileMatches matches;
  std::vector<std::string> in_force;  ///< as DecidedResults::renamed_before
};

/// Finds the names that files of decisions have today. Errors: usage, as of match_files() and
/// parse_file_pairs().
[[nodiscard]] Result<DecidedFiles> match_decided_files(const clash::Findings& findings,
                                                       const model::Model& model,
                                                       const DecisionFile& decided,
                                                       std::span<const std::string> given_pairs);

/// Ids of objects by the labels of their files.
using IdsByFile = std::map<std::string_view, std::set<std::string_view>>;

/// Maps keys of clashes to those that they had when decisions were made, and keys of rows to those
/// of today. The matches, the model and the decisions must outlive it.
class DecidedKeys {
 public:
  DecidedKeys(const FileMatches& files, const model::Model& model, const DecisionFile& decided);
  DecidedKeys(const DecidedKeys&) = delete;
  DecidedKeys& operator=(const DecidedKeys&) = delete;

  /// Whether all files have the names that they had.
  [[nodiscard]] bool is_identity() const { return map_.is_identity(); }
  [[nodiscard]] Hash128 former_key(std::string_view test, const clash::Pair& pair) const;
  /// Returns the key of a clash today.
  [[nodiscard]] Hash128 key(std::string_view test, const clash::Pair& pair) const;
  /// Whether the label of one of the two was that of another file when decisions were made.
  [[nodiscard]] bool has_label_of_another(const clash::Pair& pair) const;
  /// Returns the label that the file of an object of a row has today; one that no file has where it
  /// has no counterpart.
  [[nodiscard]] std::string label_today(const DecisionObject& object) const {
    return has_new_name(object.file) ? object.file
                                     : map_.label_in_other(RunSide::before, object.file, object.id);
  }
  /// Return one text for a file then, and for the files that it is today.
  [[nodiscard]] std::string group_then(std::string_view label) const {
    return has_new_name(label) ? group_now(label) : map_.group_of(RunSide::before, label);
  }
  [[nodiscard]] std::string group_now(std::string_view label) const {
    return map_.group_of(RunSide::after, label);
  }
  /// Returns a row with the key and the labels of today, if they are others than it states, and if
  /// it names what its key is made of.
  [[nodiscard]] std::optional<Decision> renamed(const Decision& row) const;

 private:
  /// Whether rows have the name that a file has today, beside those that have its former one.
  [[nodiscard]] bool has_new_name(std::string_view label) const {
    return ids_now_.contains(label) && map_.group_of(RunSide::before, label).starts_with('\0');
  }

  const model::Model& model_;
  const FileMatches& files_;
  IdsByFile ids_then_, ids_now_;
  FileMap map_;
};

}  // namespace strake::report
