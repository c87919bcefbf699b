// SPDX-License-Identifier: Apache-2.0
// A thousand small meshes and one of a million triangles: as one flat range, as pieces, and as
// items of which the giant has the team to itself.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "strake/parallel/heavy.hpp"
#include "strake/parallel/nested.hpp"
#include "strake/parallel/pieces.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"

namespace {

constexpr std::size_t kMeshes = 1001, kGiant = 500;

std::size_t triangles_of(std::size_t mesh) { return mesh == kGiant ? 1'000'000 : 20 + mesh % 13; }

/// Twice the area of a triangle, say: whole numbers, so that sums do not round.
std::uint64_t area(std::size_t mesh, std::size_t triangle) {
  return (mesh * 31 + triangle * 17) % 1009;
}

}  // namespace

int main() {
  // Before: with the meshes as items, one worker has the giant and the others wait.
  std::vector<std::uint64_t> expected(kMeshes, 0);
  for (std::size_t m = 0; m < kMeshes; ++m)
    for (std::size_t t = 0; t < triangles_of(m); ++t) expected[m] += area(m, t);

  using namespace strake::parallel;
  for (const unsigned workers : {1U, 2U, 3U, 8U, 64U}) {
    Team team(workers);
    const Context context{.team = &team};

    // After, where each element has a place of its own.
    std::vector<std::vector<std::uint64_t>> areas(kMeshes);
    for (std::size_t m = 0; m < kMeshes; ++m) areas[m].resize(triangles_of(m));
    if (!for_each_nested(context, {.name = "areas", .grain = 1024}, kMeshes, triangles_of,
                         [&](std::size_t m, std::size_t t) { areas[m][t] = area(m, t); }))
      return 1;

    // After, where a mesh has one result: by piece first, then by mesh.
    const auto work = pieces(kMeshes, triangles_of, 4096);
    if (!work) return 1;
    const auto sums = transform(context, {.name = "sums", .n = work->size()}, [&](std::size_t k) {
      const Piece& piece = (*work)[k];
      std::uint64_t sum = 0;
      for (std::size_t t = piece.first; t < piece.last; ++t) sum += areas[piece.item][t];
      return sum;
    });
    if (!sums) return 1;
    std::vector<std::uint64_t> by_mesh(kMeshes, 0);
    for (std::size_t k = 0; k < work->size(); ++k) by_mesh[(*work)[k].item] += (*sums)[k];
    if (by_mesh != expected) return 1;

    // After, where a mesh is an algorithm of its own with a loop inside: short loops run on the
    // spot, that of the giant has the team.
    std::vector<std::uint64_t> by_item(kMeshes, 0);
    const strake::Status status = for_each_by_weight(
        context, {.name = "meshes", .n = kMeshes}, 50'000, triangles_of,
        [&](std::size_t m) -> strake::Status {
          const auto sum = reduce(
              context,
              {.name = "triangles", .n = triangles_of(m), .grain = 4096, .alone_below = 16384},
              std::uint64_t{0},
              [&](std::uint64_t& partial, std::size_t t) { partial += areas[m][t]; },
              [](std::uint64_t& into, std::uint64_t partial) { into += partial; });
          if (!sum) return sum.error();
          by_item[m] = *sum;
          return {};
        });
    if (!status || by_item != expected) return 1;

    if (workers == 1)
      std::printf("%zu meshes, %zu pieces, the giant's area %llu\n", kMeshes, work->size(),
                  static_cast<unsigned long long>(by_mesh[kGiant]));
  }
  return 0;
}
