// SPDX-License-Identifier: Apache-2.0
// The triangles round each vertex of a grid: lists of unequal length in one piece of memory, which
// is counted first and then filled. Then the kinds of such lists, each worked on once.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <vector>

#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/team.hpp"

namespace {

using namespace strake::parallel;

/// A grid of so many by so many vertices; each square of four is two triangles.
constexpr std::uint32_t kSide = 200;

/// Calls visit(triangle) for those round a vertex, ascending.
template <class Visit>
void round_vertex(std::size_t vertex, Visit&& visit) {
  const std::size_t row = vertex / kSide, column = vertex % kSide;
  const auto square = [](std::size_t r, std::size_t c) { return 2 * (r * (kSide - 1) + c); };
  const bool left = column > 0, right = column + 1 < kSide;
  if (row > 0 && left) visit(square(row - 1, column - 1) + 1);
  if (row > 0 && right) {
    visit(square(row - 1, column));
    visit(square(row - 1, column) + 1);
  }
  if (row + 1 < kSide && left) {
    visit(square(row, column - 1));
    visit(square(row, column - 1) + 1);
  }
  if (row + 1 < kSide && right) visit(square(row, column));
}

/// A list as seen from its vertex: those of most vertices look the same.
std::vector<std::size_t> steps_of(std::span<const std::uint32_t> list) {
  std::vector<std::size_t> steps;
  for (const std::uint32_t triangle : list) steps.push_back(triangle - list.front());
  return steps;
}

}  // namespace

int main() {
  constexpr std::size_t kVertices = std::size_t{kSide} * kSide;

  // Before: a vector for each vertex, which grows.
  std::vector<std::vector<std::uint32_t>> expected(kVertices);
  for (std::size_t v = 0; v < kVertices; ++v)
    round_vertex(v, [&](std::size_t t) { expected[v].push_back(static_cast<std::uint32_t>(t)); });

  for (const unsigned workers : {1U, 2U, 8U}) {
    Team team(workers);
    const Context context{.team = &team};

    // After: how many, then which.
    const auto lists = count_fill<std::uint32_t>(
        context, {.name = "lists", .n = kVertices, .grain = 256},
        [](std::size_t v) {
          std::size_t count = 0;
          round_vertex(v, [&](std::size_t) { ++count; });
          return count;
        },
        [](std::size_t v, std::span<std::uint32_t> out) {
          std::size_t next = 0;
          round_vertex(v, [&](std::size_t t) { out[next++] = static_cast<std::uint32_t>(t); });
        });
    if (!lists) return 1;
    for (std::size_t v = 0; v < kVertices; ++v)
      if (!std::ranges::equal((*lists)[v], expected[v])) return 1;

    // What is equal has one number, that of its first.
    const auto kinds = distinct(
        context, "kinds", kVertices,
        [&](std::size_t v) {
          std::uint64_t hash = 0;
          for (const std::size_t step : steps_of((*lists)[v])) hash = mixed(hash, step);
          return hash;
        },
        [&](std::size_t a, std::size_t b) {
          return steps_of((*lists)[a]) == steps_of((*lists)[b]);
        });
    if (!kinds) return 1;

    // A loop that writes two values an item: slots of its own for each.
    strake::Result<std::vector<std::uint32_t>> longest = slots<std::uint32_t>(kVertices, context);
    strake::Result<std::vector<std::uint8_t>> inner = slots<std::uint8_t>(kVertices, context);
    if (!longest || !inner) return 1;
    if (!for_each(context, {.name = "two values", .n = kVertices, .grain = 256},
                  [&](std::size_t v) {
                    (*longest)[v] = (*lists)[v].back() - (*lists)[v].front();
                    (*inner)[v] = (*lists)[v].size() == 6 ? 1 : 0;
                  }))
      return 1;
    std::size_t inside = 0;
    for (const std::uint8_t one : *inner) inside += one;
    if (workers == 1)
      std::printf("%zu lists of %zu triangles in all, %zu kinds of them, %zu inside\n",
                  lists->size(), lists->values.size(), kinds->first.size(), inside);
  }
  return 0;
}
