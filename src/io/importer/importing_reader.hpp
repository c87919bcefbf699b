// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf/import.hpp"
#include "io/importer/map_place.hpp"
#include "io/importer/scene_maker.hpp"
#include "strake/io/importer.hpp"
#include "strake/io/reader.hpp"

namespace strake::io {

/// Whether a file may need an importer, by its name alone.
[[nodiscard]] bool may_need_importer(const std::filesystem::path& file);

/// What an importer made of a file.
struct ImportedModel {
  model::Model model;
  std::optional<MapPlace> map;
};

/// Reads the scenes that importers make of files which no other reader takes.
class ImportingReader final : public Reader {
 public:
  /// Without settings it takes the same files, and reading is their error.
  explicit ImportingReader(const Result<ImportSettings>& settings);

  [[nodiscard]] std::string_view format() const override { return "imported"; }
  [[nodiscard]] int recognise(const FileBytes& file) const override;
  [[nodiscard]] Result<model::Model> read(const FileBytes& file, const ReadOptions& options,
                                          const parallel::Context& context) const override;

  [[nodiscard]] const SceneMaker& maker() const { return maker_; }
  /// Reads as read() does; what `scenes` has of the file is not made again.
  [[nodiscard]] Result<ImportedModel> read_with(const FileBytes& file, const ReadOptions& options,
                                                ImportedScenes& scenes,
                                                const parallel::Context& context) const;

 private:
  /// Returns nothing where a scene that was kept is no more, or is damaged.
  [[nodiscard]] std::optional<Result<ImportedModel>> read_scene(const gltf::ImportInput& input,
                                                                const SceneJob& job,
                                                                const ImportedScene& scene) const;

  std::optional<Error> fault_;
  SceneMaker maker_;
};

/// The code of the diagnostic that scenes cannot be kept.
inline constexpr std::string_view kSceneNotKept = "scene-not-kept";

/// Returns what to install where a file is of a format that a known importer reads.
[[nodiscard]] std::optional<Error> missing_importer(const FileBytes& file);

}  // namespace strake::io
