// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/json/array_split.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "io/gltf/json/quote_state.hpp"
#include "io/gltf/json/structure_masks.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::io::gltf {
namespace {

constexpr std::size_t kNowhere = std::string_view::npos;
/// How many brackets are open between the elements of an array in the outermost object.
constexpr std::int64_t kElementDepth = 2;

/// The commas between elements in a stretch of text.
struct Separators {
  std::size_t first = kNowhere, count = 0;

  void add(std::size_t at) {
    if (count++ == 0) first = at;
  }
};

/// What a block of the text says about the array; places are offsets in the whole text.
struct BlockView {
  std::size_t begin = kNowhere;       ///< behind the bracket that opens the array
  std::size_t end_behind = kNowhere;  ///< the bracket that closes it, where the block opens it
  std::size_t first_end = kNowhere;   ///< the first bracket that leaves element depth
  Separators before, behind;          ///< up to `first_end`; from `begin` to `end_behind`
};

/// Whether the text before a bracket ends with a key and its colon.
bool ends_with_key(std::string_view text, std::string_view key) {
  const auto trim = [&] {
    while (!text.empty() && std::string_view(" \t\r\n").find(text.back()) != kNowhere)
      text.remove_suffix(1);
  };
  trim();
  if (!text.ends_with(':')) return false;
  text.remove_suffix(1);
  trim();
  if (!text.ends_with('"')) return false;
  text.remove_suffix(1);
  return text.ends_with(key) && text.size() > key.size() &&
         text[text.size() - key.size() - 1] == '"';
}

/// Looks at a block whose first byte is `depth` brackets deep.
class BlockScan {
 public:
  BlockScan(std::string_view text, std::string_view key, std::int64_t depth)
      : text_(text), key_(key), depth_(depth) {}

  /// `offset` is that of 64 bytes in the text.
  void scan_masks(std::size_t offset, const StructureMasks& masks) {
    // Most bytes lie deeper than anything that matters.
    if (depth_ - std::popcount(masks.closes) > kElementDepth) {
      depth_ += masks.depth_change();
      return;
    }
    for (std::uint64_t left = masks.opens | masks.closes | masks.commas; left != 0;
         left &= left - 1) {
      const std::uint64_t bit = left & (~left + 1);
      const std::size_t at = offset + static_cast<std::size_t>(std::countr_zero(left));
      if ((masks.commas & bit) != 0)
        separator(at);
      else if ((masks.opens & bit) != 0)
        open(at);
      else
        close(at);
    }
  }
  [[nodiscard]] const BlockView& view() const { return view_; }

 private:
  void separator(std::size_t at) {
    if (depth_ != kElementDepth) return;
    if (view_.first_end == kNowhere) view_.before.add(at);
    if (view_.begin != kNowhere && view_.end_behind == kNowhere) view_.behind.add(at);
  }
  void open(std::size_t at) {
    if (++depth_ != kElementDepth || view_.begin != kNowhere || text_[at] != '[') return;
    if (ends_with_key(text_.substr(0, at), key_)) view_.begin = at + 1;
  }
  void close(std::size_t at) {
    if (--depth_ != kElementDepth - 1) return;
    if (view_.first_end == kNowhere) view_.first_end = at;
    if (view_.begin != kNowhere && view_.end_behind == kNowhere) view_.end_behind = at;
  }

  std::string_view text_, key_;
  std::int64_t depth_;
  BlockView view_;
};

/// A text in blocks of equal size, the last one longer.
struct Blocks {
  std::string_view text;
  std::size_t bytes = 0;

  [[nodiscard]] std::size_t count() const { return text.size() / bytes; }
  [[nodiscard]] std::string_view operator[](std::size_t k) const {
    return text.substr(k * bytes, k + 1 == count() ? kNowhere : bytes);
  }
};

Result<std::vector<BlockView>> view_blocks(const Blocks& blocks, std::string_view key,
                                           const parallel::Context& context) {
  const Result<std::vector<QuoteState>> states = quote_states(blocks.text, blocks.bytes, context);
  if (!states) return states.error();
  Result<std::vector<std::int64_t>> depths = parallel::transform(
      context, {.name = "count glTF brackets", .n = blocks.count()}, [&](std::size_t k) {
        std::int64_t change = 0;
        scan_structure(blocks[k], (*states)[k], [&](std::size_t, const StructureMasks& masks) {
          change += masks.depth_change();
        });
        return change;
      });
  if (!depths) return depths.error();
  std::int64_t depth = 0;
  for (std::int64_t& d : *depths) depth += std::exchange(d, depth);
  return parallel::transform(context, {.name = "find glTF nodes", .n = blocks.count()},
                             [&](std::size_t k) {
                               BlockScan scan(blocks.text, key, (*depths)[k]);
                               scan_structure(blocks[k], (*states)[k],
                                              [&](std::size_t offset, const StructureMasks& masks) {
                                                scan.scan_masks(k * blocks.bytes + offset, masks);
                                              });
                               return scan.view();
                             });
}

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

/// Cuts the array behind the first separator of each block.
void cut(std::string_view text, const std::vector<Separators>& separators, ArraySplit& split) {
  if (is_blank(text.substr(split.begin, split.end - split.begin))) return;
  std::size_t begin = split.begin, count = 1;
  const auto end_piece = [&](std::size_t end) {
    split.pieces.push_back({text.substr(begin, end - begin), split.count, count});
    split.count += count;
  };
  for (std::size_t k = 0; k < separators.size(); ++k) {
    const Separators& s = separators[k];
    if (s.count == 0) continue;
    if (k == 0) {
      count += s.count;
      continue;
    }
    end_piece(s.first);
    begin = s.first + 1;
    count = s.count;
  }
  end_piece(split.end);
}

}  // namespace

Result<std::optional<ArraySplit>> split_array(std::string_view text, std::string_view key,
                                              std::size_t piece_bytes,
                                              const parallel::Context& context) {
  const Blocks blocks{text, piece_bytes};
  std::optional<ArraySplit> split;
  if (blocks.count() < 2) return split;
  const Result<std::vector<BlockView>> views = view_blocks(blocks, key, context);
  if (!views) return views.error();
  const auto first =
      std::ranges::find_if(*views, [](const BlockView& view) { return view.begin != kNowhere; });
  if (first == views->end()) return split;
  std::vector<Separators> separators{first->behind};
  std::size_t end = first->end_behind;
  for (auto block = first + 1; end == kNowhere && block != views->end(); ++block) {
    separators.push_back(block->before);
    end = block->first_end;
  }
  if (end == kNowhere) return split;
  split = ArraySplit{first->begin, end, {}, 0};
  cut(text, separators, *split);
  return split;
}

}  // namespace strake::io::gltf
