// SPDX-License-Identifier: Apache-2.0
// What a report says of a region: here, that one item is three quarters of the work, so that no
// schedule can make two workers faster than four thirds of one.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/progress.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/team.hpp"

namespace {

std::uint64_t mixed(std::uint64_t x, std::size_t times) {
  for (std::size_t i = 0; i < times; ++i) x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x;
}

}  // namespace

int main() {
  using namespace strake::parallel;
  constexpr std::size_t kSmall = 1000, kCost = 10'000;
  Team team(2);
  Progress progress;
  RunReport report;
  const Context context{.team = &team, .progress = &progress, .report = &report};

  // Item 0 costs as much as 3,000 others, of which there are 1,000.
  std::vector<std::uint64_t> out(kSmall + 1);
  std::uint64_t total = 0;
  const auto status = for_each(context, {.name = "meshes", .n = out.size()}, [&](std::size_t i) {
    out[i] = mixed(i + 1, i == 0 ? 3 * kSmall * kCost : kCost);
    if (i == 0) total = progress.snapshot().total;
  });
  if (!status || total != out.size()) return 1;

  for (const RegionReport& region : report.regions())  // other numbers each time
    std::fprintf(stderr, "%s: %.3f s, load balance %.3f, bound %.3f\n", region.name.c_str(),
                 region.wall_s, region.load_balance(), region.bound());
  const RegionReport meshes = report.regions().front();
  const double balance = meshes.load_balance(), bound = meshes.bound();
  if (balance <= 0 || balance > 1 || bound <= 0.5 || bound > 0.8) return 1;
  std::printf("%llu items in region '%s' on %zu workers\n",
              static_cast<unsigned long long>(meshes.items), meshes.name.c_str(),
              meshes.busy_s.size());
  std::printf("the longest is %s: split it\n", bound < 0.8 ? "too long for two" : "no matter");
  return 0;
}
