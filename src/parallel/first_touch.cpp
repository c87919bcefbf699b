// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/detail/first_touch.hpp"

#include <algorithm>
#include <cstdint>

#include "strake/parallel/for_each.hpp"

namespace strake::parallel::detail {

namespace {

constexpr std::size_t kPage = 4096, kItem = std::size_t{2} << 20U;
constexpr std::size_t kWorthIt = 4 * kItem;

}  // namespace

Status provide_pages(const Context& context, void* memory, std::size_t bytes) {
  if (bytes < kWorthIt || context.team == nullptr) return {};
  // Wherever in a page the memory begins, a step of a page misses none but perhaps the last.
  auto* const first = static_cast<char*>(memory);
  return for_each(context, {.name = "pages of memory", .n = (bytes + kItem - 1) / kItem},
                  [&](std::size_t i) {
                    const std::size_t end = std::min(bytes, (i + 1) * kItem);
                    for (std::size_t at = i * kItem; at < end; at += kPage)
                      *static_cast<volatile char*>(first + at) = 0;
                  });
}

}  // namespace strake::parallel::detail
