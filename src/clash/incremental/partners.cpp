// SPDX-License-Identifier: Apache-2.0
#include "clash/incremental/partners.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

namespace strake::clash {
namespace {

/// Whether an object of a block changed or is gone.
bool has_changed(const ObjectMap& map, std::size_t block) {
  const std::size_t first = block * PartnerBlocks::kObjects;
  const std::size_t last = std::min<std::size_t>(map.now.size(), first + PartnerBlocks::kObjects);
  const std::span<const std::uint32_t> of_block(map.now.data() + first, last - first);
  return std::ranges::find(of_block, model::kNoObject) != of_block.end();
}

}  // namespace

std::vector<std::uint32_t> partners_of(std::span<const Pair> pairs) {
  std::vector<std::uint32_t> blocks;
  for (const Pair& pair : pairs) {
    const std::uint32_t block = index(pair.b) / PartnerBlocks::kObjects;
    if (blocks.empty() || blocks.back() != block) blocks.push_back(block);
  }
  std::ranges::sort(blocks);
  const auto repeated = std::ranges::unique(blocks);
  blocks.erase(repeated.begin(), repeated.end());
  return blocks;
}

std::size_t count_blocks(std::size_t objects) {
  return (objects + PartnerBlocks::kObjects - 1) / PartnerBlocks::kObjects;
}

std::vector<bool> blocks_of_changes(const PartnerBlocks& partners, const ObjectMap& map) {
  std::vector<bool> changed(partners.of.size());
  for (std::size_t block = 0; block < changed.size(); ++block)
    changed[block] = has_changed(map, block);
  std::vector<bool> concerned = changed;
  for (std::size_t block = 0; block < changed.size(); ++block)
    for (const std::uint32_t partner : partners.of[block])
      if (changed[partner]) concerned[block] = true;
  return concerned;
}

}  // namespace strake::clash
