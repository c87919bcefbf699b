// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "io/importer/import_run.hpp"
#include "io/importer/scene_cache.hpp"
#include "io/importer/work_folder.hpp"
#include "strake/io/importer.hpp"

namespace strake::io {

/// A file, and the program that makes a scene of it.
struct SceneJob {
  std::filesystem::path file;
  ImporterProgram program;
  Hash128 content;  ///< of the file's bytes
  Hash128 key;      ///< of all that the scene depends on: files with the same have the same scene
};

/// A scene of a file.
struct ImportedScene {
  std::filesystem::path path;
  EntryFacts facts;
  bool is_kept = false;                ///< the path is an entry of the cache, with its trailer
  std::unique_ptr<WorkFolder> work;    ///< holds it where it is not kept
  std::optional<std::string> trouble;  ///< why it is not kept although it should be
};

/// Scenes by the keys of their jobs, or why there is none.
using ImportedScenes = std::map<Hash128, Result<ImportedScene>>;

/// Finds scenes that are kept, and has importers make the others.
class SceneMaker {
 public:
  explicit SceneMaker(ImportSettings settings);

  /// Returns what is to be done for a file; nothing where no importer takes it.
  [[nodiscard]] std::optional<SceneJob> job_of(const FileBytes& file) const;
  /// Finds or makes the scenes of all jobs, as many at once as there are workers; files with the
  /// same key share one. After one that fails those of later jobs are given up.
  [[nodiscard]] ImportedScenes make_all(std::span<const SceneJob> jobs,
                                        const parallel::Context& context) const;
  /// Makes a scene whether or not one is kept.
  [[nodiscard]] Result<ImportedScene> make(const SceneJob& job,
                                           const ImportRunOptions& options) const;
  /// Removes a kept scene that is damaged, or that cannot be read.
  void forget(const Hash128& key) const;
  [[nodiscard]] const ImportSettings& settings() const { return settings_; }

 private:
  struct Place {
    std::unique_ptr<WorkFolder> work;
    bool may_be_kept = false;
    std::optional<std::string> trouble;
  };
  [[nodiscard]] Place place_for(const SceneJob& job) const;
  [[nodiscard]] std::optional<ImportedScene> find(const SceneJob& job) const;
  void keep(const SceneJob& job, std::span<const std::byte> bytes, ImportedScene& scene) const;

  ImportSettings settings_;
  std::optional<SceneCache> cache_;
};

}  // namespace strake::io
