// SPDX-License-Identifier: Apache-2.0
#include "clash/tiles/some_objects.hpp"

#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace strake::clash {
namespace {

using Objects = std::span<const std::uint32_t>;

/// A list that is empty says nothing of any object.
template <class T>
std::vector<T> entries_of(const std::vector<T>& all, Objects objects) {
  std::vector<T> some;
  if (all.empty()) return some;
  some.reserve(objects.size());
  for (const std::uint32_t o : objects) some.push_back(all[o]);
  return some;
}

Linked::Lists lists_of(const Linked::Lists& all, Objects objects) {
  Linked::Lists some{{0}, {}};
  for (const std::uint32_t o : objects) {
    some.numbers.insert(some.numbers.end(), all.numbers.begin() + all.first[o],
                        all.numbers.begin() + all.first[o + 1]);
    some.first.push_back(static_cast<std::uint32_t>(some.numbers.size()));
  }
  return some;
}

/// Tolerances of one policy share what objects add to clearances, and those of some objects do.
Tolerances tolerances_of_some(const Tolerances& all, Objects objects) {
  Tolerances some = all;
  if (!all.object_clearances) return some;
  auto clearances = std::make_shared<ObjectClearances>();
  clearances->attribute = all.object_clearances->attribute;
  clearances->mm = entries_of(all.object_clearances->mm, objects);
  some.object_clearances = std::move(clearances);
  return some;
}

struct TestOfSome {
  Objects objects;

  decltype(Exemption::test) operator()(const SameLabel& test) const {
    return SameLabel{entries_of(test.label, objects), {}};
  }
  decltype(Exemption::test) operator()(const Linked& test) const {
    return Linked{lists_of(test.answers_to, objects), lists_of(test.refers_to, objects), {}};
  }
  decltype(Exemption::test) operator()(const Between& test) const {
    return Between{entries_of(test.a, objects), entries_of(test.b, objects)};
  }
};

}  // namespace

Sets sets_of(const Sets& all, Objects objects) {
  Sets some;
  some.in_a = entries_of(all.in_a, objects);
  some.in_b = entries_of(all.in_b, objects);
  some.group = entries_of(all.group, objects);
  some.name_a = all.name_a;
  some.name_b = all.name_b;
  return some;
}

Options options_of(const Options& all, Objects objects) {
  Options some = all;
  some.tolerances = tolerances_of_some(all.tolerances, objects);
  return some;
}

Policy policy_of(const Policy& all, Objects objects) {
  Policy some;
  for (const Tolerances& t : all.tolerances)
    some.tolerances.push_back(tolerances_of_some(t, objects));
  some.matrix = all.matrix;
  if (some.matrix) some.matrix->discipline = entries_of(all.matrix->discipline, objects);
  for (const Exemption& e : all.exemptions)
    some.exemptions.push_back({e.rule, std::visit(TestOfSome{objects}, e.test)});
  some.levels = all.levels;
  if (some.levels) some.levels->object = entries_of(all.levels->object, objects);
  for (const Allowed& rule : all.allowed) {
    Allowed& one = some.allowed.emplace_back(rule);
    one.a = entries_of(rule.a, objects);
    one.b = entries_of(rule.b, objects);
  }
  some.list_exempted = all.list_exempted;
  return some;
}

}  // namespace strake::clash
