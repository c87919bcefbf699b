// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bcf/topics/reference.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

/// BCF read: what people said of topics in other programs.
namespace strake::bcf {

struct ReadComment {
  std::string date;  ///< UTC, as 2026-01-31T23:59:59Z; empty where the file has none
  std::string author, text;
  std::string guid = {};  ///< in small letters; empty where the file has none
  /// When it was said, and by whom, before it was edited; empty: it was not.
  std::string first_date = {}, first_author = {};
};

struct ReadTopic {
  std::string guid;  ///< in small letters
  std::string title, status, assignee;
  std::string changed, changer;             ///< the last change, as a comment has them; or empty
  std::vector<ReadComment> comments;        ///< by date; of an edited one the last form
  std::optional<ClashReference> reference;  ///< where the topic is one that was written by Strake
};

struct ReadFile {
  std::string version;            ///< "2.1" or "3.0"
  std::vector<ReadTopic> topics;  ///< by GUID
  /// By place, topics that could not be read ("bcf-topic-damaged"), and dates that are none
  /// ("bcf-date-invalid"), which count as absent.
  Diagnostics diagnostics;
};

/// Reads the topics of a BCF 2.1 or 3.0 without their viewpoints. Errors: input for what is no zip
/// archive, for other versions, and where topics unpack to more than 512 MiB; cancelled.
[[nodiscard]] Result<ReadFile> read_bcf(const std::filesystem::path& file,
                                        const parallel::Context& context = {});

}  // namespace strake::bcf
