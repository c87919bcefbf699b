// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

/// The geometry that some objects of a model file have, in a file of its own: of a tile, or of a
/// model file that is kept (decision 0119).
namespace strake::tiles {

/// What has to be known of such a file to read it. It is about objects [first, last) of a tile,
/// which are of the model's file `file`.
struct Section {
  std::uint32_t file = 0, first = 0, last = 0;
  std::uint64_t bodies = 0, shapes = 0;
  Hash128 hash;  ///< of what it holds
};

/// What a pack of meshes takes about, unpacked, so that packing takes not much more than they do.
inline constexpr std::uint64_t kBytesOfPack = std::uint64_t{1} << 26U;

/// Writes what some objects of a model file, which is alone in its model, have: ids and geometry,
/// no names, groups and attributes. `objects` are their numbers there, ascending; the section is of
/// as many, as those of file 0. Errors: output, memory.
[[nodiscard]] Result<Section> write_section(const std::filesystem::path& to,
                                            const model::Model& model,
                                            std::span<const std::uint32_t> objects,
                                            const parallel::Context& context,
                                            std::uint64_t bytes_of_pack = kBytesOfPack);

/// Puts what a section has behind what the model has. Errors: input where the file is not what was
/// written (kLost); memory.
[[nodiscard]] Status append_section(const std::filesystem::path& from, const Section& section,
                                    model::Model& model, const parallel::Context& context);

}  // namespace strake::tiles
