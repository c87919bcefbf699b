// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "io/importer/map_place.hpp"
#include "strake/core/result.hpp"
#include "strake/io/importer.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::io {

/// A file that is alone in its model.
struct ReadFile {
  model::Model model;  ///< as read_models() returns it, but for what place_diagnostics() tells
  std::optional<MapPlace> map;  ///< where its importer says that it lies
};

/// Reads one of several files that are read one by one. Errors: those of read_models().
[[nodiscard]] Result<ReadFile> read_file(const FileToRead& file,
                                         const Result<ImportSettings>& settings,
                                         const parallel::Context& context);

}  // namespace strake::io
