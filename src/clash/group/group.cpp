// SPDX-License-Identifier: Apache-2.0
#include "strake/clash/group.hpp"

#include <algorithm>
#include <compare>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "clash/group/partition.hpp"
#include "clash/results/clash_key.hpp"
#include "core/number.hpp"
#include "strake/core/hash.hpp"

namespace strake::clash {
namespace {

std::vector<GroupingItem> items_of(const Findings& findings, bool contacts,
                                   const LeavesOut& leaves_out) {
  std::vector<GroupingItem> items;
  for (std::uint32_t t = 0; t < findings.tests.size(); ++t) {
    const std::vector<Pair>& pairs = findings.tests[t].pairs;
    for (std::uint32_t p = 0; p < pairs.size(); ++p)
      if (pairs[p].allowed < 0 && (contacts || pairs[p].cls != Class::contact) &&
          !(leaves_out && leaves_out({t, p})))
        items.push_back({&pairs[p], t, p});
  }
  return items;
}

using Labels = std::pair<std::string, std::string>;

Labels files_of(const model::Model& model, const Pair& pair) {
  const auto label = [&](model::ObjectId id) { return model.files[model.object(id).file].label; };
  return std::minmax(label(pair.a), label(pair.b));
}

/// Groups items by a value of each, numbered in the order of the values.
template <class Value>
Partition by_value(std::span<const GroupingItem> items, Value&& value) {
  std::map<std::decay_t<decltype(value(items.front()))>, std::uint32_t> numbers;
  for (const GroupingItem& item : items) numbers.try_emplace(value(item), 0);
  Partition partition;
  for (auto& entry : numbers) entry.second = partition.count++;
  for (const GroupingItem& item : items) partition.group.push_back(numbers.at(value(item)));
  return partition;
}

Partition partition_of(std::span<const GroupingItem> items, const model::Model& model,
                       const model::ObjectAssemblies* assemblies, const GroupRules& rules) {
  switch (rules.by) {
    case GroupBy::element:
      return by_element(items);
    case GroupBy::proximity:
      return by_proximity(items, rules.distance_mm);
    case GroupBy::test:
      return by_value(items, [](const GroupingItem& item) { return item.test; });
    case GroupBy::files:
      return by_value(items, [&](const GroupingItem& item) { return files_of(model, *item.pair); });
    case GroupBy::assembly:
      return by_assembly(items, model, *assemblies);
  }
  return {};
}

/// Whether groups by something else than proximity are split by it.
bool splits(const GroupRules& rules) { return rules.apart && rules.by != GroupBy::proximity; }

void add(Group& group, const GroupingItem& item) {
  const Pair& pair = *item.pair;
  if (group.results.empty()) group.box_mm = geometry::empty_box<double>();
  if (group.results.empty() || pair.cls > group.worst ||
      (pair.cls == group.worst && pair.d_mm < group.d_mm))
    group.d_mm = pair.d_mm;
  group.worst = std::max(group.worst, pair.cls);
  if (pair.cls == Class::hit) ++group.count_hit;
  if (pair.cls == Class::contact) ++group.count_contact;
  if (pair.cls == Class::clearance_violation) ++group.count_clearance;
  if (pair.volume_mm3) group.volume_mm3 = group.volume_mm3.value_or(0) + *pair.volume_mm3;
  group.box_mm.include(pair.point_mm);
  group.results.push_back({item.test, item.number});
}

/// Returns "at 12.3 4.5 6.7 m": the middle of the box.
std::string place_of(const geometry::Box3d& box) {
  std::string text = "at";
  const geometry::Vec3d middle = (box.lo + box.hi) * 0.5;
  for (int k = 0; k < 3; ++k) text += ' ' + fixed(middle[k] / 1000, 1);
  return text + " m";
}

class Namer {
 public:
  /// `assemblies` may be null where groups are not by assembly.
  Namer(const Findings& findings, const model::Model& model,
        const model::ObjectAssemblies* assemblies)
      : findings_(findings), model_(model), assemblies_(assemblies) {}

  void name(Group& group, const GroupRules& rules, const Partition& partition,
            std::size_t number) const {
    Hasher hasher;
    hasher.add(clash::name(rules.by));
    const Report& test = findings_.tests[group.results.front().test];
    if (rules.by == GroupBy::element) {
      const model::Object& object = model_.object(partition.about[number]);
      hasher.add(model_.files[object.file].label).add(object.id);
      group.name = object.name.empty() ? object.id : object.name;
    } else if (rules.by == GroupBy::test) {
      hasher.add(test.name);
      group.name = test.name;
    } else if (rules.by == GroupBy::files) {
      const Labels labels = files_of(model_, pair_of(group));
      hasher.add(labels.first).add(labels.second);
      group.name =
          labels.first == labels.second ? labels.first : labels.first + " and " + labels.second;
    } else if (rules.by == GroupBy::assembly) {
      name_by_assembly(group, hasher);
    } else {
      hasher.add(lowest_key(group));
      group.name = place_of(group.box_mm);
    }
    if (splits(rules)) {
      hasher.add(lowest_key(group));
      group.name += (group.name.empty() ? "" : " ") + place_of(group.box_mm);
    }
    group.id = key_text(hasher.value());
  }

  /// Gives groups by assembly of one name their paths, and an id of its own to each of those that
  /// paths do not distinguish.
  void make_names_unique(std::vector<Group>& groups, const GroupRules& rules) const {
    std::map<std::string, std::size_t> names, ids;
    for (const Group& group : groups) ++names[group.name], ++ids[group.id];
    for (Group& group : groups) {
      if (names[group.name] > 1) {
        group.name = name_of(wholes_of(group), true);
        if (splits(rules)) group.name += " " + place_of(group.box_mm);
      }
      if (ids[group.id] > 1)
        group.id = key_text(Hasher().add(group.id).add(lowest_key(group)).value());
    }
  }

 private:
  /// An assembly, or a file: ordered by what lasts. Neighbours of one name differ in `group`.
  struct AssemblyOrFile {
    std::string file, path, name;
    model::GroupId group = model::GroupId::none;
    friend auto operator<=>(const AssemblyOrFile&, const AssemblyOrFile&) = default;
  };

  [[nodiscard]] AssemblyOrFile whole_of(model::ObjectId id) const {
    const std::string& file = model_.files[model_.object(id).file].label;
    const model::GroupId assembly = assemblies_->of(id);
    if (assembly == model::GroupId::none) return {file, {}, file, assembly};
    return {file, assemblies_->path(assembly), model_.groups[index(assembly)].name, assembly};
  }

  [[nodiscard]] std::pair<AssemblyOrFile, AssemblyOrFile> wholes_of(const Group& group) const {
    const Pair& pair = pair_of(group);
    return std::minmax(whole_of(pair.a), whole_of(pair.b));
  }

  [[nodiscard]] static std::string name_of(const std::pair<AssemblyOrFile, AssemblyOrFile>& wholes,
                                           bool by_path) {
    const auto text = [by_path](const AssemblyOrFile& whole) {
      return by_path && !whole.path.empty() ? whole.path : whole.name;
    };
    return wholes.first == wholes.second ? "within " + text(wholes.first)
                                         : text(wholes.first) + " and " + text(wholes.second);
  }

  void name_by_assembly(Group& group, Hasher& hasher) const {
    const std::pair<AssemblyOrFile, AssemblyOrFile> wholes = wholes_of(group);
    for (const AssemblyOrFile& whole : {wholes.first, wholes.second})
      hasher.add(whole.file).add(whole.path);
    group.name = name_of(wholes, false);
  }

  [[nodiscard]] const Pair& pair_of(const Group& group) const {
    return findings_.tests[group.results.front().test].pairs[group.results.front().pair];
  }

  [[nodiscard]] std::string lowest_key(const Group& group) const {
    std::string lowest;
    for (const ResultRef& r : group.results) {
      const Report& test = findings_.tests[r.test];
      std::string key = pair_key(test.name, model_, test.pairs[r.pair].a, test.pairs[r.pair].b);
      if (lowest.empty() || key < lowest) lowest = std::move(key);
    }
    return lowest;
  }

  const Findings& findings_;
  const model::Model& model_;
  const model::ObjectAssemblies* assemblies_;
};

void sort_groups(std::vector<Group>& groups, SortBy by) {
  const auto rank = [by](const Group& g) {
    const double first = by == SortBy::volume ? -g.volume_mm3.value_or(0)
                         : by == SortBy::size ? -static_cast<double>(g.results.size())
                                              : 0;
    return std::tuple(first, -static_cast<int>(g.worst), g.d_mm, std::cref(g.id));
  };
  std::ranges::sort(groups, [&](const Group& x, const Group& y) {
    const auto [vx, cx, dx, ix] = rank(x);
    const auto [vy, cy, dy, iy] = rank(y);
    return std::tie(vx, cx, dx, ix.get()) < std::tie(vy, cy, dy, iy.get());
  });
}

}  // namespace

Result<Grouping> group_results(const Findings& findings, const model::Model& model,
                               const GroupRules& rules, const LeavesOut& leaves_out) {
  if (!(rules.distance_mm >= kMinGroupDistanceMm))
    return Error{ErrorCode::usage, "the distance of groups is less than a millimetre",
                 "group distance", "give a length such as 3m"};
  const std::vector<GroupingItem> items = items_of(findings, rules.contacts, leaves_out);
  std::optional<model::ObjectAssemblies> assemblies;
  if (rules.by == GroupBy::assembly) assemblies.emplace(model);
  const model::ObjectAssemblies* const known = assemblies ? &*assemblies : nullptr;
  Partition partition = partition_of(items, model, known, rules);
  if (splits(rules)) partition = apart(items, partition, rules.distance_mm);
  std::vector<Group> groups(partition.count);
  for (std::size_t i = 0; i < items.size(); ++i) add(groups[partition.group[i]], items[i]);
  const Namer namer(findings, model, known);
  for (std::size_t g = 0; g < groups.size(); ++g) namer.name(groups[g], rules, partition, g);
  if (rules.by == GroupBy::assembly) namer.make_names_unique(groups, rules);
  sort_groups(groups, rules.sort);
  return Grouping{rules, std::move(groups)};
}

std::string_view name(GroupBy by) {
  switch (by) {
    case GroupBy::element:
      return "element";
    case GroupBy::proximity:
      return "proximity";
    case GroupBy::test:
      return "test";
    case GroupBy::files:
      return "files";
    case GroupBy::assembly:
      return "assembly";
  }
  return "";
}

}  // namespace strake::clash
