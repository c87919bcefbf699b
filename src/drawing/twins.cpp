// SPDX-License-Identifier: Apache-2.0
#include "drawing/twins.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>

#include "strake/parallel/for_each.hpp"

namespace strake::drawing {

namespace {

constexpr std::uint32_t kGone = 0xffffffffU;

struct Entry {
  Ends ends;
  double reach = 0;
  std::uint32_t line = 0;
  Keyed* key = nullptr;

  [[nodiscard]] auto twins() const { return std::tie(ends, reach); }
};

/// Of lines with one key.
void take_out(std::vector<Entry>& run, std::span<const Flat> lines, const OverlapRule& rule,
              parallel::Marks& gone) {
  std::sort(run.begin(), run.end(), [&](const Entry& a, const Entry& b) {
    if (a.twins() != b.twins()) return a.twins() < b.twins();
    return stays(lines, a.line, b.line);
  });
  for (std::size_t i = 1, first = 0; i < run.size(); ++i) {
    const Flat& line = lines[run[i].line];
    if (run[i - 1].twins() != run[i].twins()) first = i;
    if (first == i || !may_cover(lines[run[first].line], rule) || !may_go(line, rule)) continue;
    if (!(line.length() > rule.least)) continue;
    gone.set(run[i].line);
    run[i].key->item = kGone;
  }
}

}  // namespace

Status drop_twins(std::vector<Keyed>& keys, std::span<const Flat> lines, const OverlapRule& rule,
                  parallel::Marks& gone, const parallel::Context& context) {
  const Status status = parallel::for_each_with(
      context, {.name = "lines with the same ends", .n = keys.size(), .grain = 8192},
      [] { return std::vector<Entry>{}; },
      [&](std::vector<Entry>& run, std::size_t i) {
        if (i > 0 && keys[i - 1].key == keys[i].key) return;
        std::size_t end = i + 1;
        while (end < keys.size() && keys[end].key == keys[i].key) ++end;
        if (end == i + 1) return;
        run.clear();
        for (std::size_t k = i; k < end; ++k) {
          const Flat& line = lines[keys[k].item];
          run.push_back({line.ends(), line.reach, keys[k].item, &keys[k]});
        }
        take_out(run, lines, rule, gone);
      });
  if (!status) return status;
  std::erase_if(keys, [](const Keyed& k) { return k.item == kGone; });
  return {};
}

}  // namespace strake::drawing
