// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0072 says why importers are programs of their own, 0126 how several files have one.

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "io/importer/find_importer.hpp"
#include "io/importer/host/import_host.hpp"
#include "io/importer/import_report.hpp"
#include "strake/core/result.hpp"

namespace strake::io {

/// One file that an importer is to make a scene of.
struct ImportTask {
  ImporterProgram program;
  std::filesystem::path file;
  std::filesystem::path folder;       ///< its own, for the scene and what it says
  double silence_s = 0;               ///< the longest time without progress
  std::optional<double> sag_mm = {};  ///< of its triangles, where that is said
};

/// How an importer is run.
struct ImportRunOptions {
  unsigned threads = 1;
  std::function<void(double)> progress = [](double /*done*/) {
  };  ///< told 0 to 1, on the calling thread
  std::stop_token stop;              ///< of the whole run
  std::stop_token given_up;          ///< of this file, because another has failed
  const ImportHost* host = nullptr;  ///< what imports it together with others; none: itself alone
};

/// Returns where an importer puts the scene.
[[nodiscard]] std::filesystem::path scene_file(const std::filesystem::path& folder);

/// Runs an importer to its end. Where a host ends of itself, the file has an importer of its own.
/// Errors: input, where it fails, crashes, makes no progress or writes what it must not; cancelled.
[[nodiscard]] Result<SceneFacts> run_importer(const ImportTask& task,
                                              const ImportRunOptions& options);

}  // namespace strake::io
