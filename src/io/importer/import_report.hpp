// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf/json/json.hpp"
#include "io/importer/map_place.hpp"
#include "strake/core/diagnostics.hpp"

namespace strake::io {

/// What an importer says of the scene that it made.
struct SceneFacts {
  std::string made_by, format;
  std::string unit;                     ///< of the file, as "mm"; empty where it is not said
  std::optional<MapPlace> map;          ///< where it lies on a map, if it says so
  std::vector<std::string> depends_on;  ///< files of the importer
  Diagnostics diagnostics;              ///< `where` is the object alone
};

/// What an importer says when nothing came of it.
struct ImportFault {
  std::string message, mend;
};

/// Reads the report of an importer as it grows. What it holds in memory is bounded, whatever is
/// written there: lines that are too long or no JSON of the kind are counted, and that is all.
class ImportReport {
 public:
  static constexpr std::size_t kLongestLine = std::size_t{1} << 20U;
  static constexpr std::size_t kMaxCodes = 500, kMaxDepends = 20000;

  void feed(std::string_view bytes);
  /// Takes the last line, whether or not an end of line is behind it.
  void end();

  /// How much is done, 0 to 1; it never falls.
  [[nodiscard]] double progress() const { return progress_; }
  [[nodiscard]] const std::optional<ImportFault>& fault() const { return fault_; }
  /// Whether it says at the end what was made.
  [[nodiscard]] bool is_complete() const { return complete_; }
  [[nodiscard]] const SceneFacts& facts() const { return facts_; }
  [[nodiscard]] SceneFacts take_facts() { return std::move(facts_); }

 private:
  void read_line();
  void read_diagnostic(const gltf::JsonValue& line, std::string_view severity);
  void read_end(const gltf::JsonValue& line);
  void note_odd();

  std::string line_;
  bool too_long_ = false;
  double progress_ = 0;
  bool complete_ = false;
  std::optional<ImportFault> fault_;
  SceneFacts facts_;
};

}  // namespace strake::io
