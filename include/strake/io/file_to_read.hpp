// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "strake/io/reader.hpp"

namespace strake::io {

/// A file, and what the user says about this one.
struct FileToRead {
  std::filesystem::path path;
  ReadOptions options;
};

/// As the other read_models(), each file by options of its own.
[[nodiscard]] Result<model::Model> read_models(std::span<const FileToRead> files,
                                               const parallel::Context& context);

}  // namespace strake::io
