// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/gltf/json/json.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

/// Indexes a JSON text fragment by fragment, so that a team can work on it.
namespace strake::io::gltf {

/// Returns where to split a JSON text into pieces of about `piece_bytes`: offsets behind commas
/// that lie outside strings, ascending. They depend on the text and the size only, and take a
/// fraction of the time of an index: whether a block of the text begins within a string follows
/// from the number of quotes before it. In a text that is no JSON the offsets are of no use, but do
/// no harm.
[[nodiscard]] Result<std::vector<std::size_t>> json_split_points(std::string_view text,
                                                                 std::size_t piece_bytes,
                                                                 const parallel::Context& context);

/// The index of a fragment of a JSON text. A fragment begins at the beginning of the text or behind
/// a comma between two items, and ends at the end of the text or behind another such comma. What
/// encloses a later fragment is not known while it is indexed, only what it closes of it.
struct JsonFragment {
  /// The end, in this fragment, of an array or object that an earlier one opened.
  struct Close {
    JsonType type = JsonType::absent;
    std::uint32_t text_end = 0;
    std::uint32_t entries = 0;  ///< entries of this fragment that come before it
  };
  std::vector<JsonEntry> entries;  ///< offsets are of the whole text, `next` of this fragment
  std::vector<Close> closes;
  std::vector<std::uint32_t> open;  ///< entries that are still open at the end, outermost first
  /// The type of the innermost array or object that was open before the fragment and still is at
  /// its end; absent: nothing in the fragment tells.
  JsonType outer = JsonType::absent;
  std::size_t deepest = 0;        ///< most values open at once, not counting those opened before
  bool behind_comma = false;      ///< an item is expected next
  const char* message = nullptr;  ///< describes a fault at text offset `at`; null: none
  std::size_t at = 0;
};

/// Indexes text[begin, end).
[[nodiscard]] JsonFragment index_json_fragment(std::string_view text, std::size_t begin,
                                               std::size_t end);

}  // namespace strake::io::gltf
