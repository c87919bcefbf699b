// SPDX-License-Identifier: Apache-2.0
#include "drawing/account.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "strake/parallel/reduce.hpp"

namespace strake::drawing {

namespace {

/// Of a run of lines, which are by object.
struct Tally {
  std::array<std::uint64_t, kLineStates> count{};
  std::vector<model::ObjectId> seen;  ///< objects with visible lines, each once in a row
};

}  // namespace

Status count_lines(NeutralDrawing& drawing, const parallel::Context& context) {
  const auto see = [](Tally& tally, model::ObjectId object) {
    if (tally.seen.empty() || tally.seen.back() != object) tally.seen.push_back(object);
  };
  const Result<Tally> tally = parallel::reduce(
      context, {.name = "account of lines", .n = drawing.lines.size(), .grain = 65536}, Tally{},
      [&](Tally& partial, std::size_t i) {
        const Line& line = drawing.lines[i];
        ++partial.count[static_cast<std::size_t>(line.state)];
        if (line.state == LineState::visible) see(partial, line.object);
      },
      [&](Tally& into, const Tally& partial) {
        for (std::size_t s = 0; s < kLineStates; ++s) into.count[s] += partial.count[s];
        for (const model::ObjectId object : partial.seen) see(into, object);
      });
  if (!tally) return tally.error();
  drawing.count = tally->count;

  hlr::Account& account = drawing.account;
  auto seen = tally->seen.begin();
  for (std::uint32_t object = 0; object < account.fates.size(); ++object) {
    const bool on_paper = seen != tally->seen.end() && model::index(*seen) == object;
    if (on_paper) ++seen;
    if (account.fates[object] != hlr::Fate::drawn || on_paper) continue;
    account.fates[object] = hlr::Fate::coincident;
    --account.count[static_cast<std::size_t>(hlr::Fate::drawn)];
    ++account.count[static_cast<std::size_t>(hlr::Fate::coincident)];
  }
  return {};
}

}  // namespace strake::drawing
