// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"

namespace strake::import_step {

/// The report that strake reads while the work goes on: one JSON object on a line, on disk when its
/// call returns (docs/formats/importers.md).
class Report {
 public:
  explicit Report(const std::filesystem::path& file);

  [[nodiscard]] bool is_open() const { return file_.is_open(); }
  /// Says how much is done, 0 to 1; small steps are not written.
  void progress(double done);
  void add(Severity severity, std::string_view code, std::string_view object,
           std::string_view message);
  /// The last line of an import of which nothing came.
  void fail(const Error& error);
  /// The last line of one that went well. `unit` is that of the file, "mm".
  void end(std::string_view format, std::string_view unit, std::span<const std::string> depends_on);

 private:
  void line(const std::string& text);

  std::ofstream file_;
  double shown_ = -1;
};

}  // namespace strake::import_step
