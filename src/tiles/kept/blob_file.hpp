// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "project/model/blocks.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

/// Files of several blobs (project/codec/blob.hpp), each of which tells whether it is whole.
namespace strake::tiles {

using project::Blob;

/// What find_in_tile(), read_tile() and others say of a file that is not what was written there:
/// who has what it was made of makes it again.
inline constexpr const char* kLost = "is missing or damaged";

/// Writes a file, whole or not at all. Errors: output.
[[nodiscard]] Status write_blobs(const std::filesystem::path& file, std::span<const Blob> blobs);

/// Reads a file that has so many blobs at least. Errors: input, kLost.
[[nodiscard]] Result<std::vector<Blob>> read_blobs(const std::filesystem::path& file,
                                                   std::size_t at_least,
                                                   const parallel::Context& context);

/// Returns the error of a file that is not what was written there.
[[nodiscard]] Error lost(const std::filesystem::path& file);

}  // namespace strake::tiles
