// SPDX-License-Identifier: Apache-2.0
// The document in which a peer program says what it measured.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cli/evaluate/peers/peer_row.hpp"
#include "strake/core/result.hpp"

namespace strake::cli {

[[nodiscard]] std::string peer_rows_json(const std::vector<PeerRow>& rows);

/// Reads what peer_rows_json() made; `name` stands in errors. Errors: input, where it is no such
/// document, or a row says what cannot be: an outcome that there is not, a time below 0, a
/// measurement without a time, a time without one.
[[nodiscard]] Result<std::vector<PeerRow>> parse_peer_rows(std::string_view text,
                                                           const std::string& name);

/// The rows of one run of a peer program. Its file holds all that were added, whenever the program
/// ends.
class PeerRowFile {
 public:
  /// An empty name: no file.
  explicit PeerRowFile(std::filesystem::path file) : file_(std::move(file)) {}
  [[nodiscard]] Status add(PeerRow row);

 private:
  std::filesystem::path file_;
  std::vector<PeerRow> rows_;
};

}  // namespace strake::cli
