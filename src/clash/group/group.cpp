// SPDX-License-Identifier: Apache-2.0
#include "strake/clash/group.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "clash/group/partition.hpp"
#include "clash/results/clash_key.hpp"
#include "core/number.hpp"
#include "model/assemblies.hpp"
#include "strake/core/hash.hpp"

namespace strake::clash {
namespace {

constexpr double kLeastDistanceMm = 1;
/// Where groups are their own parents a path has no end.
constexpr std::size_t kLongestPath = 65536;

std::vector<GroupingItem> items_of(const Findings& findings, bool contacts) {
  std::vector<GroupingItem> items;
  for (std::uint32_t t = 0; t < findings.tests.size(); ++t) {
    const std::vector<Pair>& pairs = findings.tests[t].pairs;
    for (std::uint32_t p = 0; p < pairs.size(); ++p)
      if (pairs[p].allowed < 0 && (contacts || pairs[p].cls != Class::contact))
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

/// Returns for each object the one that it counts as: itself, or the first of its assembly.
std::vector<model::ObjectId> stand_ins(const model::Model& model, GroupBy by) {
  std::vector<model::ObjectId> all(model.objects.size());
  for (std::uint32_t o = 0; o < all.size(); ++o) all[o] = model::ObjectId{o};
  if (by != GroupBy::assembly) return all;
  const std::vector<model::GroupId> assemblies = model::assemblies_of(model);
  std::map<model::GroupId, model::ObjectId> firsts;
  for (std::uint32_t o = 0; o < all.size(); ++o)
    if (assemblies[o] != model::GroupId::none)
      all[o] = firsts.try_emplace(assemblies[o], all[o]).first->second;
  return all;
}

Partition partition_of(std::span<const GroupingItem> items, const model::Model& model,
                       const GroupRules& rules) {
  switch (rules.by) {
    case GroupBy::element:
    case GroupBy::assembly:
      return by_element(items, stand_ins(model, rules.by));
    case GroupBy::proximity:
      return by_proximity(items, rules.distance_mm);
    case GroupBy::test:
      return by_value(items, [](const GroupingItem& item) { return item.test; });
    case GroupBy::files:
      return by_value(items, [&](const GroupingItem& item) { return files_of(model, *item.pair); });
  }
  return {};
}

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
  Namer(const Findings& findings, const model::Model& model, GroupBy by)
      : findings_(findings), model_(model) {
    if (by == GroupBy::assembly) assemblies_ = model::assemblies_of(model);
  }

  void name(Group& group, GroupBy by, const Partition& partition, std::size_t number) const {
    Hasher hasher;
    hasher.add(clash::name(by));
    const Report& test = findings_.tests[group.results.front().test];
    const Pair& pair = test.pairs[group.results.front().pair];
    if (by == GroupBy::element) {
      const model::Object& object = model_.object(partition.about[number]);
      hasher.add(model_.files[object.file].label).add(object.id);
      group.name = object.name.empty() ? object.id : object.name;
    } else if (by == GroupBy::assembly) {
      const model::ObjectId about = partition.about[number];
      const model::GroupId assembly = assemblies_[index(about)];
      hasher.add(model_.files[model_.object(about).file].label)
          .add(assembly == model::GroupId::none ? model_.object(about).id : path_of(assembly));
      group.name = called(about) + with_others(group, about);
    } else if (by == GroupBy::test) {
      hasher.add(test.name);
      group.name = test.name;
    } else if (by == GroupBy::files) {
      const Labels labels = files_of(model_, pair);
      hasher.add(labels.first).add(labels.second);
      group.name =
          labels.first == labels.second ? labels.first : labels.first + " and " + labels.second;
    } else {
      hasher.add(lowest_key(group));
      group.name = place_of(group.box_mm);
    }
    group.id = key_text(hasher.value());
  }

 private:
  /// Returns the name of the assembly that an object is of, or its own.
  [[nodiscard]] std::string called(model::ObjectId id) const {
    const model::GroupId assembly = assemblies_[index(id)];
    if (assembly != model::GroupId::none && !model_.groups[index(assembly)].name.empty())
      return model_.groups[index(assembly)].name;
    const model::Object& object = model_.object(id);
    return object.name.empty() ? object.id : object.name;
  }
  /// Returns the names of the groups down to an assembly, of which each ends.
  [[nodiscard]] std::string path_of(model::GroupId group) const {
    std::string path;
    for (model::GroupId g = group; g != model::GroupId::none && path.size() < kLongestPath;
         g = model_.groups[index(g)].parent)
      path += model_.groups[index(g)].name + '\n';
    return path;
  }
  /// Returns " and B" where all results of a group are with one other assembly, else how many
  /// others there are; nothing where they are within one.
  [[nodiscard]] std::string with_others(const Group& group, model::ObjectId about) const {
    const std::string own = called(about);
    std::set<std::string> others;
    for (const ResultRef& r : group.results) {
      const Pair& pair = findings_.tests[r.test].pairs[r.pair];
      for (const model::ObjectId id : {pair.a, pair.b})
        if (std::string name = called(id); name != own) others.insert(std::move(name));
    }
    if (others.empty()) return {};
    return " and " +
           (others.size() == 1 ? *others.begin() : std::to_string(others.size()) + " others");
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
  std::vector<model::GroupId> assemblies_;  ///< of each object, where groups are by assembly
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
                               const GroupRules& rules) {
  if (!(rules.distance_mm >= kLeastDistanceMm))
    return Error{ErrorCode::usage, "the distance of groups is less than a millimetre",
                 "group distance", "give a length such as 3m"};
  const std::vector<GroupingItem> items = items_of(findings, rules.contacts);
  const Partition partition = partition_of(items, model, rules);
  std::vector<Group> groups(partition.count);
  for (std::size_t i = 0; i < items.size(); ++i) add(groups[partition.group[i]], items[i]);
  const Namer namer(findings, model, rules.by);
  for (std::size_t g = 0; g < groups.size(); ++g) namer.name(groups[g], rules.by, partition, g);
  sort_groups(groups, rules.sort);
  return Grouping{rules, std::move(groups)};
}

std::string_view name(GroupBy by) {
  switch (by) {
    case GroupBy::element:
      return "element";
    case GroupBy::assembly:
      return "assembly";
    case GroupBy::proximity:
      return "proximity";
    case GroupBy::test:
      return "test";
    case GroupBy::files:
      return "files";
  }
  return "";
}

}  // namespace strake::clash
