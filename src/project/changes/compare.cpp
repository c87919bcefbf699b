// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "project/changes/displaced_bodies.hpp"
#include "project/changes/fingerprints.hpp"
#include "project/changes/pair_objects.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"
#include "strake/project/update.hpp"

namespace strake::project {
namespace {

constexpr std::array<std::string_view, kChangeKinds> kChangeNames{
    "added", "removed", "moved", "reshaped", "reattributed", "renamed"};

constexpr std::uint8_t bit(ChangeKind kind) {
  return static_cast<std::uint8_t>(1U << static_cast<unsigned>(kind));
}

/// Whether the name of an object was made of an id that only counts.
bool is_named_by_count(const model::Object& object) {
  return object.positional_id && object.name == object.id;
}

/// Returns the kinds of change of an object that is in both models.
std::uint8_t kinds_of(const PrintedModel& then, std::uint32_t before, const PrintedModel& now,
                      std::uint32_t after) {
  const Fingerprint &old_print = then.prints[before], &print = now.prints[after];
  const model::Object &old_object = then.model.objects[before], &object = now.model.objects[after];
  std::uint8_t kinds = 0;
  const bool same_shapes = old_print.shapes == print.shapes;
  const bool same_bodies = same_shapes || is_displaced(then.model, old_object, now.model, object);
  if (!same_bodies)
    kinds |= bit(ChangeKind::reshaped);
  else if (!same_shapes || old_print.places != print.places)
    kinds |= bit(ChangeKind::moved);
  const bool other_id = old_object.id != object.id;
  if (other_id && !(old_object.positional_id && object.positional_id))
    kinds |= bit(ChangeKind::renamed);
  const bool same_paints =
      same_bodies ? old_print.paints == print.paints : old_print.appearance == print.appearance;
  // Another id mostly comes with another name or path, which is one change and not two.
  const bool same_naming = (kinds & bit(ChangeKind::renamed)) != 0 ||
                           old_print.naming == print.naming ||
                           (is_named_by_count(old_object) && is_named_by_count(object));
  if (old_print.facts != print.facts || !same_paints || !same_naming)
    kinds |= bit(ChangeKind::reattributed);
  return kinds;
}

ObjectChange::Name name_of(const model::Model& model, std::uint32_t object) {
  const model::Object& o = model.objects[object];
  return {model.files[o.file].label, o.id, o.name};
}

/// Whether an object of the old model stands before one of the new in the list of changes.
bool comes_first(const model::Model& then, std::uint32_t before, const model::Model& now,
                 std::uint32_t after) {
  const model::Object &x = then.objects[before], &y = now.objects[after];
  return std::tie(then.files[x.file].label, x.id) <= std::tie(now.files[y.file].label, y.id);
}

/// Returns what changed in the order of the list, without names.
std::vector<ObjectChange> listed_changes(const model::Model& then, const model::Model& now,
                                         const ObjectPairs& pairs,
                                         const std::vector<std::uint8_t>& kinds) {
  std::vector<ObjectChange> changes;
  std::uint32_t removed = 0;
  const auto next_removed = [&] {
    while (removed < pairs.of_then.size() && pairs.of_then[removed] != kNoPartner) ++removed;
    return removed < pairs.of_then.size();
  };
  const auto take_removed = [&] {
    changes.push_back({bit(ChangeKind::removed), removed++, ObjectChange::kNone, {}, {}});
  };
  for (std::uint32_t o = 0; o < kinds.size(); ++o) {
    if (kinds[o] == 0) continue;
    while (next_removed() && comes_first(then, removed, now, o)) take_removed();
    changes.push_back({kinds[o], pairs.of_now[o], o, {}, {}});
  }
  while (next_removed()) take_removed();
  return changes;
}

std::array<std::uint64_t, kChangeKinds> counts_of(const std::vector<ObjectChange>& changes) {
  std::array<std::uint64_t, kChangeKinds> counts{};
  for (const ObjectChange& change : changes)
    for (std::size_t k = 0; k < kChangeKinds; ++k)
      counts[k] += change.is(static_cast<ChangeKind>(k)) ? 1U : 0U;
  return counts;
}

}  // namespace

std::string_view change_name(ChangeKind kind) {
  return kChangeNames[static_cast<std::size_t>(kind)];
}

Result<Changes> compare(const model::Model& then, const model::Model& now,
                        report::FileMatches files, const parallel::Context& context) {
  const Result<std::vector<Fingerprint>> old_prints = fingerprints(then, context);
  if (!old_prints) return old_prints.error();
  const Result<std::vector<Fingerprint>> prints = fingerprints(now, context);
  if (!prints) return prints.error();
  const PrintedModel before{then, *old_prints}, after{now, *prints};
  const ObjectPairs pairs = pair_objects(before, after, files);
  const Result<std::vector<std::uint8_t>> kinds = parallel::transform(
      context, {.name = "changes of objects", .n = now.objects.size(), .grain = 1024},
      [&](std::size_t o) -> std::uint8_t {
        const auto object = static_cast<std::uint32_t>(o);
        const std::uint32_t partner = pairs.of_now[o];
        return partner == kNoPartner ? bit(ChangeKind::added)
                                     : kinds_of(before, partner, after, object);
      });
  if (!kinds) return kinds.error();
  Changes changes;
  changes.files = std::move(files);
  changes.objects = listed_changes(then, now, pairs, *kinds);
  changes.unchanged = static_cast<std::uint64_t>(std::ranges::count(*kinds, std::uint8_t{0}));
  changes.counts = counts_of(changes.objects);
  const Status named = parallel::for_each(
      context, {.name = "names of changes", .n = changes.objects.size(), .grain = 256},
      [&](std::size_t c) {
        ObjectChange& change = changes.objects[c];
        if (change.then != ObjectChange::kNone) change.before = name_of(then, change.then);
        if (change.now != ObjectChange::kNone) change.after = name_of(now, change.now);
      });
  if (!named) return named.error();
  return changes;
}

}  // namespace strake::project
