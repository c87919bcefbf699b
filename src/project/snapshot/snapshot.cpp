// SPDX-License-Identifier: Apache-2.0
#include "project/snapshot/snapshot.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {
namespace {

/// An identity and the object that has it.
struct Identified {
  std::uint64_t identity = 0;
  std::uint32_t object = 0;
};

/// The objects of one state by lots of their identities: each lot is sorted by one worker.
class IdentityLots {
 public:
  static constexpr std::size_t kLots = 256;

  IdentityLots() = default;
  explicit IdentityLots(const std::vector<std::uint64_t>& identities) : items_(identities.size()) {
    for (const std::uint64_t identity : identities) ++begin_[lot_of(identity) + 1];
    for (std::size_t lot = 0; lot < kLots; ++lot) begin_[lot + 1] += begin_[lot];
    std::array<std::size_t, kLots + 1> next = begin_;
    for (std::size_t i = 0; i < identities.size(); ++i)
      items_[next[lot_of(identities[i])]++] = {identities[i], static_cast<std::uint32_t>(i)};
  }

  /// Returns the objects of a lot by their identities.
  [[nodiscard]] std::span<const Identified> sorted(std::size_t lot) {
    const std::span<Identified> items(items_.data() + begin_[lot], begin_[lot + 1] - begin_[lot]);
    std::ranges::sort(items, {},
                      [](const Identified& i) { return std::pair(i.identity, i.object); });
    return items;
  }

 private:
  [[nodiscard]] static std::size_t lot_of(std::uint64_t identity) { return identity >> 56U; }
  std::array<std::size_t, kLots + 1> begin_{};
  std::vector<Identified> items_;
};

/// Returns how many objects at the front have one identity.
std::size_t count_equal(std::span<const Identified> items) {
  std::size_t count = 1;
  while (count < items.size() && items[count].identity == items[0].identity) ++count;
  return count;
}

/// Writes into `now_of` which object is which, of those of one lot.
void join(std::span<const Identified> then, std::span<const Identified> now, const Snapshot& before,
          const Snapshot& after, std::vector<std::uint32_t>& now_of) {
  while (!then.empty() && !now.empty()) {
    if (then[0].identity < now[0].identity) {
      then = then.subspan(1);
      continue;
    }
    if (now[0].identity < then[0].identity) {
      now = now.subspan(1);
      continue;
    }
    const std::size_t as_then = count_equal(then), as_now = count_equal(now);
    const std::uint32_t a = then[0].object, b = now[0].object;
    if (as_then == 1 && as_now == 1 && before.signatures[a] == after.signatures[b]) now_of[a] = b;
    then = then.subspan(as_then);
    now = now.subspan(as_now);
  }
}

/// Objects are ordered by what identities are hashes of: where all of these are as they were, so
/// are their numbers.
std::vector<std::uint32_t> unchanged_in_place(const Snapshot& then, const Snapshot& now,
                                              const std::vector<bool>& stand) {
  constexpr std::size_t kRange = clash::Signatures::kObjectsPerRange;
  std::vector<std::uint32_t> now_of(then.identities.size());
  std::iota(now_of.begin(), now_of.end(), 0U);
  for (std::size_t first = 0; first < now_of.size(); first += kRange) {
    if (first / kRange < stand.size() && stand[first / kRange]) continue;
    const std::size_t last = std::min(now_of.size(), first + kRange);
    for (std::size_t o = first; o < last; ++o)
      if (then.signatures[o] != now.signatures[o]) now_of[o] = model::kNoObject;
  }
  return now_of;
}

}  // namespace

std::vector<bool> ranges_that_stand(const Snapshot& then, const Snapshot& now) {
  const bool are_known = is_same_known(then.names, now.names) && then.whole == now.whole &&
                         then.ranges.size() == now.ranges.size() &&
                         then.identities.size() == now.identities.size();
  std::vector<bool> stand(are_known ? now.ranges.size() : 0);
  for (std::size_t k = 0; k < stand.size(); ++k) stand[k] = then.ranges[k] == now.ranges[k];
  return stand;
}

void rename_objects(Snapshot& snapshot, const NewIdentities& renamed) {
  for (std::uint64_t& identity : snapshot.identities)
    if (const auto at = renamed.find(identity); at != renamed.end()) identity = at->second;
  snapshot.names = snapshot.source = {};
  snapshot.ranges.clear();
}

Result<std::vector<std::uint64_t>> identities(const model::Model& model,
                                              const parallel::Context& context) {
  return parallel::transform(
      context, {.name = "identities", .n = model.objects.size(), .grain = 1024},
      [&](std::size_t i) {
        return clash::element_hash(model, model::ObjectId{static_cast<std::uint32_t>(i)});
      });
}

Result<std::vector<std::uint32_t>> unchanged(const Snapshot& then, const Snapshot& now,
                                             const parallel::Context& context) {
  if (then.identities.size() != then.signatures.size() ||
      now.identities.size() != now.signatures.size())
    return Error{ErrorCode::internal, "a snapshot has not as many signatures as objects", {}, {}};
  const std::vector<bool> stand = ranges_that_stand(then, now);
  // Where names are known, identities need not be compared.
  if (!stand.empty() || then.identities == now.identities)
    return unchanged_in_place(then, now, stand);
  Result<std::vector<IdentityLots>> lots = parallel::transform(
      context, {.name = "identities by lots", .n = 2},
      [&](std::size_t side) { return IdentityLots(side == 0 ? then.identities : now.identities); });
  if (!lots) return lots.error();
  std::vector<std::uint32_t> now_of(then.identities.size(), model::kNoObject);
  const Status status = parallel::for_each(
      context, {.name = "unchanged objects", .n = IdentityLots::kLots}, [&](std::size_t lot) {
        join((*lots)[0].sorted(lot), (*lots)[1].sorted(lot), then, now, now_of);
      });
  if (!status) return status.error();
  return now_of;
}

void write(BlobWriter& out, const Snapshot& snapshot) {
  out.hash(snapshot.whole);
  out.column(std::span<const std::uint64_t>(snapshot.identities));
  out.column(std::span<const Hash128>(snapshot.signatures));
}

Snapshot read_snapshot(BlobReader& in) {
  Snapshot snapshot;
  snapshot.whole = in.hash();
  snapshot.identities = in.column<std::uint64_t>();
  snapshot.signatures = in.column<Hash128>();
  if (snapshot.identities.size() == snapshot.signatures.size()) return snapshot;
  in.refuse("it has not as many signatures as objects");
  return {};
}

}  // namespace strake::project
