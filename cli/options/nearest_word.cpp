// SPDX-License-Identifier: Apache-2.0
#include "cli/options/nearest_word.hpp"

#include <cstddef>
#include <utility>

#include "core/text/edit_distance.hpp"

namespace strake::cli {

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 64;  // nobody misspells more, and the table stays small
  std::string nearest;
  std::size_t fewest = word.size();
  for (const std::string& one : known) {
    if (word.size() > kLongest || one.size() > kLongest) continue;
    const std::size_t changes = edit_distance(word, one);
    if (changes >= fewest || 3 * changes >= one.size()) continue;
    fewest = changes;
    nearest = one;
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known,
                         std::string otherwise) {
  const std::string nearest = nearest_word(word, known);
  return nearest.empty() ? std::move(otherwise) : "did you mean '" + nearest + "'?";
}

}  // namespace strake::cli
