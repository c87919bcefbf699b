// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/detail/large_pages.hpp"

#include <algorithm>
#include <cstdint>

#include "strake/parallel/for_each.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace strake::parallel::detail {

namespace {

constexpr std::size_t kSmallPage = 4096, kLargePage = std::size_t{2} << 20U;
constexpr std::size_t kWorthIt = 32 * kLargePage;

/// Returns the number of bytes up to the first large page.
std::size_t bytes_before(const char* memory) {
  return (kLargePage - reinterpret_cast<std::uintptr_t>(memory) % kLargePage) % kLargePage;
}

void prefer_large(char* first, std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  // This is a request: the answer of the system changes nothing.
  (void)madvise(first, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
#else
  (void)first;
  (void)bytes;
#endif
}

}  // namespace

Status provide_pages(const Context& context, void* memory, std::size_t bytes) {
  if (bytes < kWorthIt) return {};
  // No item ends within a large page: two workers would clear it, one in vain.
  const std::size_t before = bytes_before(static_cast<char*>(memory));
  char* const first = static_cast<char*>(memory) + before;
  const std::size_t size = bytes - before;
  prefer_large(first, size);
  if (context.team == nullptr) return {};
  return for_each(context, {.name = "pages of memory", .n = (size + kLargePage - 1) / kLargePage},
                  [&](std::size_t i) {
                    const std::size_t end = std::min(size, (i + 1) * kLargePage);
                    for (std::size_t at = i * kLargePage; at < end; at += kSmallPage)
                      *static_cast<volatile char*>(first + at) = 0;
                  });
}

}  // namespace strake::parallel::detail
