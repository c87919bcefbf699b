// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

/// Splits a large array of a JSON text between its elements, before the text is parsed.
namespace strake::io::gltf {

/// Neighbouring elements of an array.
struct ArrayPiece {
  std::string_view text;  ///< the elements and the commas between them
  std::size_t first = 0;  ///< number of the first one
  std::size_t count = 0;  ///< how many there are
};

/// An array that is a member of a text's outermost object, cut into pieces between its elements.
struct ArraySplit {
  std::size_t begin = 0, end = 0;  ///< what lies between its brackets
  std::vector<ArrayPiece> pieces;
  std::size_t count = 0;  ///< elements in all
};

/// Returns where the first member named `key` of the outermost object lies, when it is an array,
/// and pieces of it of about `piece_bytes`. They depend on the text and the size only. Nothing when
/// there is no such array, when the text is shorter than two pieces, or when its brackets do not
/// match; a text that is no JSON may give pieces that are of no use, but do no harm.
[[nodiscard]] Result<std::optional<ArraySplit>> split_array(std::string_view text,
                                                            std::string_view key,
                                                            std::size_t piece_bytes,
                                                            const parallel::Context& context);

}  // namespace strake::io::gltf
