// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/json_cuts.hpp"

#include <algorithm>
#include <cstdint>

#include "strake/parallel/transform.hpp"

namespace strake::io::gltf {
namespace {

/// Where a text stands between two of its bytes.
struct Place {
  bool in_string = false;
  bool escaped = false;  ///< behind a backslash that the next byte belongs to
};

/// From a place outside strings before the block to the place behind it. Backslashes occur in
/// strings only, so it does not matter here where they stand.
Place pass(std::string_view block, bool escaped) {
  Place place{false, escaped};
  if (!escaped && block.find('\\') == std::string_view::npos) {
    place.in_string = std::count(block.begin(), block.end(), '"') % 2 != 0;
    return place;
  }
  for (const char c : block) {
    place.in_string ^= c == '"' && !place.escaped;
    place.escaped = c == '\\' && !place.escaped;
  }
  return place;
}

/// Behind the first comma of the block that is not in a string; 0 when there is none.
std::size_t first_cut(std::string_view text, std::size_t begin, std::size_t end, Place place) {
  for (std::size_t at = begin; at < end; ++at) {
    const char c = text[at];
    if (c == ',' && !place.in_string) return at + 1;
    place.in_string ^= c == '"' && !place.escaped;
    place.escaped = c == '\\' && !place.escaped;
  }
  return 0;
}

}  // namespace

Result<std::vector<std::size_t>> json_cuts(std::string_view text, std::size_t piece_bytes,
                                           const parallel::Context& context) {
  const std::size_t blocks = text.size() / piece_bytes;
  if (blocks < 2) return std::vector<std::size_t>{};
  const auto block = [&](std::size_t k) { return text.substr(k * piece_bytes, piece_bytes); };
  const Result<std::vector<Place>> passed =
      parallel::transform(context, {.name = "find glTF strings", .n = blocks},
                          [&](std::size_t k) { return pass(block(k), false); });
  if (!passed) return passed.error();
  std::vector<Place> begins(blocks);
  for (std::size_t k = 1; k < blocks; ++k) {
    const Place before = begins[k - 1];
    // A block that begins behind a backslash is rare enough to look at twice.
    const Place change = before.escaped ? pass(block(k - 1), true) : (*passed)[k - 1];
    begins[k] = {before.in_string != change.in_string, change.escaped};
  }
  Result<std::vector<std::size_t>> cuts =
      parallel::transform(context, {.name = "cut glTF text", .n = blocks}, [&](std::size_t k) {
        if (k == 0) return std::size_t{0};
        return first_cut(text, k * piece_bytes, (k + 1) * piece_bytes, begins[k]);
      });
  if (cuts) std::erase(*cuts, std::size_t{0});
  return cuts;
}

}  // namespace strake::io::gltf
