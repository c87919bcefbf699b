// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "io/importer/map_place.hpp"
#include "strake/core/result.hpp"
#include "strake/io/importer.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "tiles/kept/section.hpp"

namespace strake::tiles {

/// Reads model files one at a time, each alone in its model and finished. What was read of one is
/// needed again when it is cut: by then it has made room for the others, and lies in a folder
/// (decision 0119).
class FileReader {
 public:
  /// `folder` is where files are kept; empty: nowhere, so that they are read twice.
  FileReader(std::vector<io::FileToRead> files, Result<io::ImportSettings> settings,
             std::filesystem::path folder = {})
      : files_(std::move(files)),
        settings_(std::move(settings)),
        folder_(std::move(folder)),
        kept_(files_.size()) {}

  [[nodiscard]] const std::vector<io::FileToRead>& files() const { return files_; }
  /// Returns the model of one file, which lasts until the next call. Errors: those of
  /// io::read_models().
  [[nodiscard]] Result<const model::Model*> read(std::size_t file,
                                                 const parallel::Context& context);
  /// Returns where the importer of the last one says that it lies on a map.
  [[nodiscard]] const std::optional<io::MapPlace>& map() const { return map_; }
  /// Keeps the model of the file that was read last, and frees it; an only file stays where it is.
  /// Errors: output, memory.
  [[nodiscard]] Status keep(std::size_t file, const parallel::Context& context);
  /// Returns the model of a file that was read before, as read() does. Of one that was kept it has
  /// the ids and the geometry alone; what was kept and is lost is read from the file itself.
  [[nodiscard]] Result<const model::Model*> read_again(std::size_t file,
                                                       const parallel::Context& context);
  /// Frees the last one.
  void forget() { last_.reset(); }

 private:
  [[nodiscard]] std::filesystem::path kept_file(std::size_t file) const;

  std::vector<io::FileToRead> files_;
  Result<io::ImportSettings> settings_;
  std::filesystem::path folder_;
  std::vector<std::optional<Section>> kept_;  ///< by file
  std::size_t number_ = 0;
  std::optional<model::Model> last_;
  std::optional<io::MapPlace> map_;
};

}  // namespace strake::tiles
