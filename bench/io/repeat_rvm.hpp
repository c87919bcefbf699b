// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "strake/core/result.hpp"

namespace strake::bench {

enum class Copies {
  alike,      ///< byte for byte, addresses apart
  different,  ///< every coordinate and length a few float spacings from the other copies'
};

/// A valid RVM file of at least `bytes` made of real ones: the HEAD and MODL of the first; then,
/// again and again, the groups of all of them (their CNTB to CNTE chunks, PRIM and the rest within)
/// inside a group "/COPY-n" that keeps their paths apart; then END. The address of the next chunk
/// that each chunk states is made right for its new place.
///
/// Alike, a reader that keeps equal parameters once has the shapes of one copy to make; different,
/// it has those of all, as in a file that is really that large.
[[nodiscard]] Result<std::string> repeat_rvm(std::span<const std::filesystem::path> samples,
                                             std::size_t bytes, Copies copies);

}  // namespace strake::bench
