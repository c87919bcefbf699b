// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

/// Importers: programs that make a scene of a file that no reader knows
/// (docs/formats/importers.md).
namespace strake::io {

/// Where importers are found, how long they may be silent, and where their scenes are kept.
struct ImportSettings {
  static constexpr double kSilence = 600;
  static constexpr std::uint64_t kCacheBytes = 20'000'000'000;

  /// Searched in this order for strake-import-SUFFIX, then for strake-import.
  std::vector<std::filesystem::path> folders;
  /// An importer that makes no progress for so many seconds is ended.
  double silence_s = kSilence;
  /// The largest distance of triangles from the true surface, in mm, where the importer makes them
  /// of curved ones; without it each takes its own.
  std::optional<double> sag_mm;
  /// The folder of scenes that are kept for the next run; without it none is.
  std::optional<std::filesystem::path> cache;
  /// The least recently used scenes go when all together are larger.
  std::uint64_t cache_bytes = kCacheBytes;
};

/// Returns what the environment says, as the program and the functions without settings take it:
/// the folder of the running program and those of PATH; STRAKE_IMPORT_LIMIT (seconds);
/// STRAKE_IMPORT_SAG ("0.1mm");
/// STRAKE_CACHE, XDG_CACHE_HOME or HOME, and STRAKE_CACHE_LIMIT ("20GB").
/// Errors: usage, where a value makes no sense.
[[nodiscard]] Result<ImportSettings> import_settings_of_environment();

/// Reads as read_models() without settings does, which takes those of the environment.
[[nodiscard]] Result<model::Model> read_models(std::span<const FileToRead> files,
                                               const ImportSettings& settings,
                                               const parallel::Context& context);

/// Makes the scenes of those files that importers read, several at once, so that reading one after
/// the other finds them; without a folder for scenes, or where no file needs one, it does nothing.
/// Errors: those of the first file whose importer fails.
[[nodiscard]] Status make_scenes(std::span<const FileToRead> files,
                                 const parallel::Context& context);

}  // namespace strake::io
