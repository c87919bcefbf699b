// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/report/file_match.hpp"

namespace strake::report {

/// Matches the files of two results of one kind. `labels_of(document)` returns their labels,
/// `files_of(document, labels, with_contents)` the files; what is in them is read only where labels
/// do not decide.
template <class Document, class LabelsOf, class FilesOf>
[[nodiscard]] Result<FileMatches> match_documents(const Document& before, const Document& after,
                                                  std::span<const std::string> given_pairs,
                                                  LabelsOf&& labels_of, FilesOf&& files_of) {
  const std::vector<std::string> old_labels = labels_of(before), new_labels = labels_of(after);
  const bool by_contents = !given_pairs.empty() || old_labels != new_labels;
  const RunFiles old_files = files_of(before, old_labels, by_contents);
  const RunFiles new_files = files_of(after, new_labels, by_contents);
  const Result<std::vector<FilePair>> pairs = parse_file_pairs(given_pairs, old_files, new_files);
  if (!pairs) return pairs.error();
  return match_files(old_files, new_files, *pairs);
}

}  // namespace strake::report
