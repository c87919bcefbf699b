// SPDX-License-Identifier: Apache-2.0
#include "model/string_sort.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/parting.hpp"
#include "strake/parallel/find.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/pieces.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::model {
namespace {

constexpr std::size_t kKeyBytes = 8;

/// Returns the eight bytes at `depth` as a number that compares as they do; zeros behind the end.
std::uint64_t key_at(std::string_view text, std::size_t depth) {
  std::uint64_t key = 0;
  const std::size_t count = std::min(kKeyBytes, text.size() - std::min(depth, text.size()));
  for (std::size_t i = 0; i < kKeyBytes; ++i)
    key = key << 8U | (i < count ? static_cast<unsigned char>(text[depth + i]) : 0U);
  return key;
}

/// A range of the order whose texts agree in their first `depth` bytes.
struct TextRange {
  std::size_t first = 0, last = 0, depth = 0;

  [[nodiscard]] std::size_t size() const { return last - first; }
};

struct KeyedText {
  std::uint64_t key = 0;
  std::uint32_t index = 0;

  friend bool operator<(const KeyedText& a, const KeyedText& b) {
    return std::tie(a.key, a.index) < std::tie(b.key, b.index);
  }
};

/// The texts, and the order that they come into.
struct Texts {
  std::span<const std::string_view> all;
  std::span<std::uint32_t> order;

  [[nodiscard]] std::span<std::uint32_t> places(const TextRange& range) const {
    return order.subspan(range.first, range.size());
  }
  [[nodiscard]] KeyedText keyed(std::size_t place, std::size_t depth) const {
    return {key_at(all[order[place]], depth), order[place]};
  }
};

/// Returns how many first bytes some texts of a range have in common with the first of it.
std::size_t shared_depth(const Texts& texts, const TextRange& range,
                         std::span<const std::uint32_t> some) {
  const std::string_view first = texts.all[texts.order[range.first]];
  std::size_t shared = first.size();
  for (const std::uint32_t i : some) {
    const std::string_view text = texts.all[i];
    shared = std::min(shared, text.size());
    std::size_t at = range.depth;
    while (at < shared && text[at] == first[at]) ++at;
    shared = at;
    if (shared == range.depth) break;
  }
  return shared;
}

/// Splits texts of one key: those that end within the key come first, the shorter before the
/// longer, as they differ from others of the same key by zero bytes only. Returns the rest, which
/// is left to be sorted by what follows, if any; `distinct` becomes false where two are equal.
std::optional<TextRange> split_equal(const Texts& texts, const TextRange& range, bool& distinct) {
  const std::span<std::uint32_t> order = texts.places(range);
  const auto size = [&](std::uint32_t i) { return texts.all[i].size(); };
  const std::size_t ended = part_by(order, [&](std::uint32_t i) { return size(i) <= range.depth; });
  const auto longer = order.begin() + static_cast<std::ptrdiff_t>(ended);
  std::sort(order.begin(), longer, [&](std::uint32_t a, std::uint32_t b) {
    return size(a) != size(b) ? size(a) < size(b) : a < b;
  });
  for (auto i = order.begin(); i != longer && i + 1 != longer; ++i)
    distinct = distinct && size(i[0]) != size(i[1]);
  const auto rest = static_cast<std::size_t>(order.end() - longer);
  if (rest <= 1) return std::nullopt;
  return TextRange{range.last - rest, range.last, range.depth};
}

/// Calls visit(range) for each run of equal keys among those of a range, sorted, from the place
/// `from` of them on to where a run begins that is not below `to`.
template <class Visit>
void for_each_equal(std::span<const KeyedText> keyed, const TextRange& range, std::size_t from,
                    std::size_t to, Visit&& visit) {
  for (std::size_t i = from, end = 0; i < to; i = end) {
    for (end = i + 1; end < keyed.size() && keyed[end].key == keyed[i].key;) ++end;
    if (end - i > 1) visit(TextRange{range.first + i, range.first + end, range.depth + kKeyBytes});
  }
}

/// Sorts ranges on one worker.
class RangeSorter {
 public:
  explicit RangeSorter(const Texts& texts) : texts_(texts) {}

  /// Returns whether no two texts are equal.
  bool sort(const TextRange& whole) {
    distinct_ = true;
    open_.assign(1, whole);
    while (!open_.empty()) {
      const TextRange range = open_.back();
      open_.pop_back();
      // Between 3 and 48 ships show no difference (decision 0073).
      constexpr std::size_t kFew = 12;
      if (range.size() <= kFew)
        sort_few(range);
      else
        sort_by_key(range);
    }
    return distinct_;
  }

 private:
  void sort_few(const TextRange& range) {
    const std::span<std::uint32_t> order = texts_.places(range);
    const auto rest = [&](std::uint32_t i) { return texts_.all[i].substr(range.depth); };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const int texts = rest(a).compare(rest(b));
      return texts != 0 ? texts < 0 : a < b;
    });
    for (std::size_t i = 1; i < order.size(); ++i)
      distinct_ = distinct_ && rest(order[i - 1]) != rest(order[i]);
  }

  void sort_by_key(TextRange range) {
    range.depth = shared_depth(texts_, range, texts_.places(range));
    keyed_.clear();
    for (std::size_t place = range.first; place < range.last; ++place)
      keyed_.push_back(texts_.keyed(place, range.depth));
    std::sort(keyed_.begin(), keyed_.end());
    const std::span<std::uint32_t> order = texts_.places(range);
    std::ranges::transform(keyed_, order.begin(), &KeyedText::index);
    for_each_equal(keyed_, range, 0, keyed_.size(), [&](const TextRange& equal) {
      if (const auto rest = split_equal(texts_, equal, distinct_)) open_.push_back(*rest);
    });
  }

  const Texts& texts_;
  std::vector<KeyedText> keyed_;
  std::vector<TextRange> open_;
  bool distinct_ = true;
};

/// Texts that a worker takes at once where all of them are gone through.
constexpr std::size_t kTextsPerRun = 16384;
/// A range of so many texts is worth a team.
constexpr std::size_t kManyTexts = 4 * kTextsPerRun;

/// A piece of what two neighbouring runs of sorted texts are merged into.
struct MergePiece {
  std::size_t first = 0, middle = 0, last = 0;  ///< of the two runs
  std::size_t from = 0, to = 0;                 ///< of the piece, counted from `first`
};

/// Merges a piece by itself: it is found in both runs, so that two long ones are merged by all
/// workers. No two texts are equal, as their indices differ.
void merge_piece(std::span<const KeyedText> runs, const MergePiece& piece,
                 std::span<KeyedText> merged) {
  const auto x = runs.subspan(piece.first, piece.middle - piece.first);
  const auto y = runs.subspan(piece.middle, piece.last - piece.middle);
  // Returns how many of the first k of both are of x.
  const auto of_x = [&](std::size_t k) {
    std::size_t least = k - std::min(k, y.size()), largest = std::min(k, x.size());
    while (least < largest) {
      const std::size_t middle = least + (largest - least) / 2;
      if (x[middle] < y[k - middle - 1])
        least = middle + 1;
      else
        largest = middle;
    }
    return least;
  };
  const std::size_t x0 = of_x(piece.from), x1 = of_x(piece.to);
  const auto own_x = x.subspan(x0, x1 - x0);
  const auto own_y = y.subspan(piece.from - x0, (piece.to - x1) - (piece.from - x0));
  std::merge(own_x.begin(), own_x.end(), own_y.begin(), own_y.end(),
             merged.subspan(piece.first + piece.from).begin());
}

/// Returns the pieces by which each run but the last of an odd number is merged with the next one;
/// `begin` has where runs begin, and the end, and then where the longer ones do.
std::vector<MergePiece> pair_runs(std::vector<std::size_t>& begin) {
  std::vector<MergePiece> pieces;
  std::vector<std::size_t> longer;
  for (std::size_t r = 0; r + 1 < begin.size(); r += 2) {
    const std::size_t last = begin[std::min(r + 2, begin.size() - 1)];
    parallel::cut_evenly(last - begin[r], kTextsPerRun, [&](std::size_t from, std::size_t to) {
      pieces.push_back({begin[r], begin[r + 1], last, from, to});
    });
    longer.push_back(begin[r]);
  }
  longer.push_back(begin.back());
  begin.swap(longer);
  return pieces;
}

/// Sorts keyed texts by all workers: runs by themselves, then two runs each into one.
Status sort_keyed(std::vector<KeyedText>& keyed, const parallel::Context& context) {
  std::vector<std::size_t> begin;
  for (std::size_t at = 0; at < keyed.size(); at += kTextsPerRun) begin.push_back(at);
  begin.push_back(keyed.size());
  Status status = parallel::for_each(
      context, {.name = "texts sorted", .n = begin.size() - 1}, [&](std::size_t r) {
        const auto run = std::span(keyed).subspan(begin[r], begin[r + 1] - begin[r]);
        std::sort(run.begin(), run.end());
      });
  if (!status) return status;
  auto made = parallel::unset_slots<KeyedText>(keyed.size(), context);
  if (!made) return made.error();
  std::vector<KeyedText> merged = std::move(*made);
  while (begin.size() > 2) {
    const std::vector<MergePiece> pieces = pair_runs(begin);
    status = parallel::for_each(context, {.name = "texts merged", .n = pieces.size()},
                                [&](std::size_t p) { merge_piece(keyed, pieces[p], merged); });
    if (!status) return status;
    keyed.swap(merged);
  }
  return {};
}

/// Sorts long ranges by all workers.
class TeamSorter {
 public:
  TeamSorter(const Texts& texts, const parallel::Context& context)
      : texts_(texts), context_(context) {}

  Result<bool> run() {
    std::vector<TextRange> open{{0, texts_.order.size(), 0}};
    while (!open.empty()) {
      const TextRange range = open.back();
      open.pop_back();
      if (range.size() < kManyTexts)
        short_.push_back(range);
      else if (const Status status = sort_long(range, open); !status)
        return status.error();
    }
    // Between 8 and 512 a ship of a million objects shows no difference.
    constexpr std::size_t kGrain = 64;
    std::vector<std::uint8_t> distinct(short_.size());
    const Status status = parallel::for_each_with(
        context_, {.name = "short ranges of texts", .n = short_.size(), .grain = kGrain},
        [&] { return RangeSorter(texts_); },
        [&](RangeSorter& sorter, std::size_t r) {
          distinct[r] = static_cast<std::uint8_t>(sorter.sort(short_[r]));
        });
    if (!status) return status.error();
    return distinct_ && std::ranges::find(distinct, 0) == distinct.end();
  }

 private:
  Status sort_long(TextRange range, std::vector<TextRange>& open) {
    const parallel::Region runs{.name = "runs of texts",
                                .n = (range.size() + kTextsPerRun - 1) / kTextsPerRun};
    std::vector<std::size_t> shared(runs.n);
    Status status = parallel::for_each(context_, runs, [&](std::size_t run) {
      const std::size_t first = run * kTextsPerRun;
      shared[run] = shared_depth(
          texts_, range,
          texts_.places(range).subspan(first, std::min(kTextsPerRun, range.size() - first)));
    });
    if (!status) return status;
    range.depth = *std::ranges::min_element(shared);
    auto made = parallel::unset_slots<KeyedText>(range.size(), context_);
    if (!made) return made.error();
    std::vector<KeyedText> keyed = std::move(*made);
    status = parallel::for_each(
        context_, {.name = "keys of texts", .n = keyed.size(), .grain = kTextsPerRun},
        [&](std::size_t k) { keyed[k] = texts_.keyed(range.first + k, range.depth); });
    if (!status) return status;
    if (status = sort_keyed(keyed, context_); !status) return status;
    return split_long(range, keyed, open);
  }

  /// Writes a sorted range back and splits its runs of equal keys; each belongs to the run of texts
  /// that it begins in.
  Status split_long(const TextRange& range, std::span<const KeyedText> keyed,
                    std::vector<TextRange>& open) {
    struct Rest {
      std::vector<TextRange> ranges;
      bool distinct = true;
    };
    const parallel::Region runs{.name = "runs of texts",
                                .n = (range.size() + kTextsPerRun - 1) / kTextsPerRun};
    std::vector<Rest> rests(runs.n);
    const std::span<std::uint32_t> order = texts_.places(range);
    Status status = parallel::for_each(
        context_, {.name = "texts in order", .n = keyed.size(), .grain = kTextsPerRun},
        [&](std::size_t k) { order[k] = keyed[k].index; });
    if (!status) return status;
    status = parallel::for_each(context_, runs, [&](std::size_t run) {
      const std::size_t end = std::min(range.size(), (run + 1) * kTextsPerRun);
      std::size_t first = run * kTextsPerRun;
      while (first > 0 && first < end && keyed[first].key == keyed[first - 1].key) ++first;
      Rest& rest = rests[run];
      for_each_equal(keyed, range, first, end, [&](const TextRange& equal) {
        if (const auto more = split_equal(texts_, equal, rest.distinct))
          rest.ranges.push_back(*more);
      });
    });
    if (!status) return status;
    for (const Rest& rest : rests) {
      open.insert(open.end(), rest.ranges.begin(), rest.ranges.end());
      distinct_ = distinct_ && rest.distinct;
    }
    return {};
  }

  const Texts& texts_;
  const parallel::Context& context_;
  std::vector<TextRange> short_;
  bool distinct_ = true;
};

}  // namespace

Result<bool> sort_strings(std::span<const std::string_view> texts, std::span<std::uint32_t> order,
                          const parallel::Context& context) {
  // Many programs write objects in the order of their ids.
  const auto sorted = parallel::all_of(
      context,
      {.name = "texts in order", .n = order.empty() ? 0 : order.size() - 1, .grain = kTextsPerRun},
      [&](std::size_t i) { return texts[order[i]] < texts[order[i + 1]]; });
  if (!sorted) return sorted.error();
  if (*sorted) return true;
  const Texts all{texts, order};
  if (order.size() < kManyTexts) return RangeSorter(all).sort({0, order.size(), 0});
  return TeamSorter(all, context).run();
}

}  // namespace strake::model
