// SPDX-License-Identifier: Apache-2.0
#include "drawing/strokes/join_lines.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace strake::drawing {

namespace {

/// A point of the sheet in whole micrometres: points that are written alike are equal.
struct Key {
  std::int64_t x, y;
  friend auto operator<=>(const Key&, const Key&) = default;
};

Key key_of(const PaperPoint& p) { return {std::llround(p.x * 1000), std::llround(p.y * 1000)}; }

class Joiner {
 public:
  explicit Joiner(std::span<const Line* const> lines) : lines_(lines), used_(lines.size(), false) {
    for (std::uint32_t i = 0; i < lines.size(); ++i) {
      const Key a = key_of(lines[i]->a_paper), b = key_of(lines[i]->b_paper);
      used_[i] = a == b;
      if (used_[i]) continue;
      ends_.emplace_back(a, i);
      ends_.emplace_back(b, i);
    }
    std::sort(ends_.begin(), ends_.end());
  }

  std::vector<JoinedLines> join() {
    for (const bool free_ends : {true, false})
      for (std::uint32_t i = 0; i < lines_.size(); ++i) {
        if (used_[i]) continue;
        const bool from_a = degree(key_of(lines_[i]->a_paper)) != 2;
        if (free_ends && !from_a && degree(key_of(lines_[i]->b_paper)) == 2) continue;
        follow(i, from_a || !free_ends);
      }
    return std::move(chains_);
  }

 private:
  using End = std::pair<Key, std::uint32_t>;

  [[nodiscard]] std::pair<std::vector<End>::const_iterator, std::vector<End>::const_iterator> at(
      const Key& key) const {
    return {std::lower_bound(ends_.begin(), ends_.end(), End(key, 0)),
            std::upper_bound(ends_.begin(), ends_.end(), End(key, 0xffffffffU))};
  }
  [[nodiscard]] std::ptrdiff_t degree(const Key& key) const {
    const auto [first, last] = at(key);
    return last - first;
  }

  void follow(std::uint32_t line, bool from_a) {
    JoinedLines chain{{from_a ? lines_[line]->a_paper : lines_[line]->b_paper}, {}};
    for (;;) {
      used_[line] = true;
      const PaperPoint& next = from_a ? lines_[line]->b_paper : lines_[line]->a_paper;
      chain.points.push_back(next);
      chain.lines.push_back(lines_[line]);
      const Key key = key_of(next);
      const auto [first, last] = at(key);
      const auto found = std::find_if(first, last, [&](const End& e) { return !used_[e.second]; });
      if (found == last) break;
      line = found->second;
      from_a = key_of(lines_[line]->a_paper) == key;
    }
    chains_.push_back(std::move(chain));
  }

  std::span<const Line* const> lines_;
  std::vector<bool> used_;
  std::vector<End> ends_;
  std::vector<JoinedLines> chains_;
};

}  // namespace

std::vector<JoinedLines> join_lines(std::span<const Line* const> lines) {
  return Joiner(lines).join();
}

}  // namespace strake::drawing
