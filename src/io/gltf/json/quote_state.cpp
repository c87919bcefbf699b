// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/json/quote_state.hpp"

#include <algorithm>

#include "strake/parallel/transform.hpp"

namespace strake::io::gltf {
namespace {

/// Returns the state behind a block that begins outside strings. Backslashes occur in strings only,
/// so it does not matter here where they are.
QuoteState state_behind(std::string_view block, bool escaped) {
  QuoteState place{false, escaped};
  if (!escaped && block.find('\\') == std::string_view::npos) {
    place.in_string = std::count(block.begin(), block.end(), '"') % 2 != 0;
    return place;
  }
  for (const char c : block) place.pass(c);
  return place;
}

}  // namespace

Result<std::vector<QuoteState>> quote_states(std::string_view text, std::size_t block_bytes,
                                             const parallel::Context& context) {
  const std::size_t blocks = text.size() / block_bytes;
  const auto block = [&](std::size_t k) { return text.substr(k * block_bytes, block_bytes); };
  Result<std::vector<QuoteState>> behind =
      parallel::transform(context, {.name = "find glTF strings", .n = blocks},
                          [&](std::size_t k) { return state_behind(block(k), false); });
  if (!behind) return behind.error();
  std::vector<QuoteState> begins(blocks);
  for (std::size_t k = 1; k < blocks; ++k) {
    const QuoteState before = begins[k - 1];
    // A block that begins behind a backslash is rare enough to look at twice.
    const QuoteState change = before.escaped ? state_behind(block(k - 1), true) : (*behind)[k - 1];
    begins[k] = {before.in_string != change.in_string, change.escaped};
  }
  return begins;
}

}  // namespace strake::io::gltf
