// SPDX-License-Identifier: Apache-2.0
#include "cli/options/nearest_word.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace strake::cli {

namespace {

/// How many letters must be put in, taken out, replaced or swapped with the next to make one word
/// of the other (the optimal string alignment).
std::size_t changes_between(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> table((a.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& {
    return table[i * width + j];
  };
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        at(i, j) = i + j;
        continue;
      }
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1,
                           at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  return table.back();
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 64;  // nobody misspells more, and the table stays small
  std::string nearest;
  std::size_t fewest = word.size();
  for (const std::string& one : known) {
    if (word.size() > kLongest || one.size() > kLongest) continue;
    const std::size_t changes = changes_between(word, one);
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
