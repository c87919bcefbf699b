// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "strake/parallel/deal.hpp"
#include "strake/parallel/distinct.hpp"

namespace strake::parallel::detail {

Result<HashLots> hash_lots(const Context& context, std::string_view name,
                           std::span<const std::uint64_t> hashes) {
  static_assert(kDistinctLots == 64);
  return deal<std::uint32_t, kDistinctLots>(
      context, name, hashes.size(),
      [&](std::size_t i) { return static_cast<std::size_t>(hashes[i] >> 58U); },
      [](std::size_t i) { return static_cast<std::uint32_t>(i); });
}

}  // namespace strake::parallel::detail
