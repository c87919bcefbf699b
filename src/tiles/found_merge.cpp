// SPDX-License-Identifier: Apache-2.0
#include "tiles/found_merge.hpp"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "clash/results/reported.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::tiles {
namespace {

/// The objects of a pair, a before b, as one number.
using Key = std::uint64_t;

Key key_of(std::uint32_t a, std::uint32_t b) { return (Key{a} << 32U) | b; }

/// The results of one tile, in their order.
class Source {
 public:
  Source(const FoundFile& file, std::size_t test) : file_(file), test_(test) {}

  /// Whether nothing is left.
  [[nodiscard]] bool is_done() const { return !is_unpacked() && next_part_ == parts().size(); }
  /// Whether the next pair is unpacked.
  [[nodiscard]] bool is_unpacked() const { return part_ < batch_.size(); }
  /// The key of the next pair; one that is not greater where it is not unpacked.
  [[nodiscard]] Key key() const {
    if (!is_unpacked()) return key_of(file_.objects()[next_part_ * project::kObjectsPerPart], 0);
    const clash::Pair& next = batch_[part_].pairs[pair_];
    return key_of(file_.objects()[index(next.a)], file_.objects()[index(next.b)]);
  }

  /// Unpacks a few parts.
  Status unpack(const parallel::Context& context) {
    const std::size_t count =
        std::min<std::size_t>(parallel::workers_of(context), parts().size() - next_part_);
    Result<std::vector<project::DecodedPart>> batch =
        parallel::transform(context, {.name = "decode results", .n = count},
                            [&](std::size_t k) { return file_.part(test_, next_part_ + k); });
    if (!batch) return batch.error();
    next_part_ += count;
    batch_ = std::move(*batch);
    part_ = pair_ = 0;
    skip_empty();
    return {};
  }

  /// Appends the next pair, which is unpacked.
  void append_to(clash::TileJoin& join, const clash::Options& options) {
    const project::DecodedPart& part = batch_[part_];
    clash::Pair pair = part.pairs[pair_];
    pair.a = model::ObjectId{file_.objects()[index(pair.a)]};
    pair.b = model::ObjectId{file_.objects()[index(pair.b)]};
    // decode_part() has seen to it that they are there.
    const std::uint32_t listed = clash::listed_regions(pair, options);
    const auto regions = listed == 0
                             ? std::span<const clash::Region>()
                             : std::span(part.regions).subspan(pair.first_region - 1, listed);
    join.append(std::move(pair), regions);
    if (++pair_ < part.pairs.size()) return;
    ++part_;
    pair_ = 0;
    skip_empty();
  }

 private:
  [[nodiscard]] const std::vector<Blob>& parts() const { return file_.test(test_).parts; }

  void skip_empty() {
    while (part_ < batch_.size() && batch_[part_].pairs.empty()) ++part_;
    if (part_ < batch_.size()) return;
    batch_ = {};
    part_ = 0;
  }

  const FoundFile& file_;
  std::size_t test_, next_part_ = 0, part_ = 0, pair_ = 0;
  std::vector<project::DecodedPart> batch_;
};

/// A source by what comes next of it. Of equal keys those go first that are not unpacked, since
/// theirs may be greater.
struct Waiting {
  Key key = 0;
  bool unpacked = false;
  std::size_t source = 0;

  friend auto operator<=>(const Waiting&, const Waiting&) = default;
};

}  // namespace

Status merge_found(std::span<const FoundFile> found, std::size_t test, clash::TileJoin& join,
                   const parallel::Context& context) {
  std::vector<Source> sources;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
  const auto wait = [&](std::size_t s) {
    if (!sources[s].is_done()) waiting.push({sources[s].key(), sources[s].is_unpacked(), s});
  };
  for (const FoundFile& file : found) {
    sources.emplace_back(file, test);
    wait(sources.size() - 1);
  }
  while (!waiting.empty()) {
    const Waiting first = waiting.top();
    waiting.pop();
    Source& source = sources[first.source];
    if (!first.unpacked) {
      if (const Status s = source.unpack(context); !s) return s;
      wait(first.source);
      continue;
    }
    const clash::Options& options = found[first.source].test(test).tile.report.options;
    do {
      source.append_to(join, options);
    } while (source.is_unpacked() && (waiting.empty() || source.key() < waiting.top().key));
    wait(first.source);
  }
  return {};
}

}  // namespace strake::tiles
