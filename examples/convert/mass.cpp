// SPDX-License-Identifier: Apache-2.0
// docs/patterns/convert.md, the third conversion: exact mass properties, by the sequential program
// and by teams; and what sums of doubles would have done.
#include "mass.hpp"

#include <bit>
#include <cstdio>
#include <set>

#include "everywhere.hpp"

namespace {

using namespace convert;

/// How many values the volume takes when it is added up in doubles, by 1 to 64 workers with an
/// equal range each, worker after worker.
std::size_t distinct_sums_of_doubles(const Masses& exact) {
  std::set<std::uint64_t> sums;
  const std::size_t n = exact.of_part.size();
  for (std::size_t workers = 1; workers <= 64; ++workers) {
    double total = 0;
    for (std::size_t w = 0; w < workers; ++w) {
      double range = 0;
      for (std::size_t p = n * w / workers; p < n * (w + 1) / workers; ++p)
        range += static_cast<double>(exact.of_part[p].volume_6) / 6;
      total += range;
    }
    sums.insert(std::bit_cast<std::uint64_t>(total));
  }
  return sums.size();
}

/// Moving a body moves its first moment by volume times way, to the last digit.
bool moves_exactly(const Model& model, const Sums& total, const Point& way) {
  Model moved = model;
  for (Part& part : moved)
    for (Point& p : part.points) p = {p.x + way.x, p.y + way.y, p.z + way.z};
  const Sums there = before::masses(moved).total;
  const std::array<std::int32_t, 3> by{way.x, way.y, way.z};
  for (std::size_t i = 0; i < 3; ++i)
    if (there.moment_24[i] != total.moment_24[i] + 4 * total.volume_6 * by[i]) return false;
  return there.volume_6 == total.volume_6;
}

void print(const Masses& masses) {
  const Sums& total = masses.total;
  std::printf("  volume %s / 6 mm3\n", text(total.volume_6).c_str());
  for (std::size_t i = 0; i < 3; ++i)
    std::printf(
        "  centroid %c %.6f mm\n", "xyz"[i],
        static_cast<double>(total.moment_24[i]) / (4 * static_cast<double>(total.volume_6)));
  for (std::size_t i = 0; i < 3; ++i) {
    const Int128 inertia = total.second_120[(i + 1) % 3] + total.second_120[(i + 2) % 3];
    std::printf("  inertia about %c %s / 120 mm5\n", "xyz"[i], text(inertia).c_str());
  }
  for (const std::uint32_t part : masses.open) std::printf("  part %u is not closed\n", part);
}

}  // namespace

int main() {
  const Model model = make_model(5000, 100);
  const Masses expected = before::masses(model);
  std::printf("%zu parts, %zu triangles\n", model.size(), triangles_of(model));
  print(expected);
  if (expected.open.size() != 1 || !moves_exactly(model, expected.total, {1234, -5678, 91}))
    return 1;
  const auto run = [&](const strake::parallel::Context& context) {
    return after::masses(model, context);
  };
  if (!same_everywhere(expected, run)) return 1;
  std::puts("the same bytes from 1, 2, 3, 8 and 64 workers");
  std::printf("in doubles, by 1 to 64 workers: %zu different volumes\n",
              distinct_sums_of_doubles(expected));
  return 0;
}
