// SPDX-License-Identifier: Apache-2.0
// Sets and rules of every kind over a crowd of objects, with labels in any numbering.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "strake/clash/policy.hpp"
#include "strake/model/scene.hpp"

namespace strake::test {

/// One body of an object.
struct EditedBody {
  model::Shape shape;
  geometry::Placement placement;
  model::Category category = model::Category::physical;
  float precision_um = 0;
};

/// An object and all that rules may know of it.
struct EditedObject {
  std::string id;
  std::uint32_t file = 0;
  std::vector<EditedBody> bodies;
  std::array<int, 2> labels{-1, -1};
  int discipline = -1;
  clash::Level level = clash::Level::hard;
  double insulation_mm = 0;
  bool in_a = true, in_b = true, incomplete = false;
  std::array<bool, 6> picks{};
  std::vector<int> refers, answers;
};

/// The kinds of rules that a test has; each has a name and a limit that may change.
struct EditedRules {
  bool matrix = false, labels = false, links = false, between = false, levels = false,
       allowed = false, by_volume = false, by_relation = false, grouped = false, named = false,
       clearances = false, list_exempted = false, reporting = false, min_volume = false;
  double clearance_mm = 20, depth_mm = 3;
  clash::EngineOptions engine;
};

/// A model as clash detection takes it.
struct EditedInputs {
  std::unique_ptr<model::Model> model = std::make_unique<model::Model>();
  model::Scene scene;
  std::vector<std::string> identities;  ///< of each object, whatever its file is called
  clash::Sets sets;
  clash::Options options;
  clash::Policy policy;
};

/// Makes the rules that are in force; each call numbers labels anew.
class EditedRuleMaker {
 public:
  using Objects = std::vector<const EditedObject*>;

  EditedRuleMaker(const EditedRules& given, std::mt19937& shuffling)
      : rules_(given), shuffling_(shuffling) {}

  void make_rules(const Objects& all, EditedInputs& in) {
    clash::Options& options = in.options;
    options.engine = rules_.engine;
    options.tolerances.clearance_mm = rules_.clearance_mm;
    if (rules_.clearances) {
      clash::ObjectClearances own{
          "INSU", each<double>(all, [](const EditedObject& o) { return o.insulation_mm; })};
      options.tolerances.object_clearances = std::make_shared<clash::ObjectClearances>(own);
    }
    if (rules_.reporting)
      options.reporting.relations = {clash::Relation::separate, clash::Relation::interfere,
                                     clash::Relation::a_in_b};
    if (rules_.min_volume) options.reporting.min_volume_mm3 = 500;
    in.sets.in_a = each<bool>(all, [](const EditedObject& o) { return o.in_a; });
    in.sets.in_b = each<bool>(all, [](const EditedObject& o) { return o.in_b; });
    if (rules_.grouped) {
      const std::vector<std::uint32_t> numbered = numbers(3);
      in.sets.group =
          each<std::uint32_t>(all, [&](const EditedObject& o) { return numbered[o.file]; });
      in.sets.group_names = names_of(numbered);
    }
    clash::Policy& policy = in.policy;
    policy.list_exempted = rules_.list_exempted;
    if (rules_.matrix) make_matrix(all, policy);
    if (rules_.labels)
      for (const std::size_t which : {0U, 1U})
        policy.exemptions.push_back({"label " + std::to_string(which), same_label(all, which)});
    if (rules_.links) policy.exemptions.push_back({"links", linked(all)});
    if (rules_.between)
      for (const std::size_t pick : {0U, 1U})
        policy.exemptions.push_back({"between " + std::to_string(pick),
                                     clash::Between{picked(all, pick), picked(all, pick + 1)}});
    if (rules_.levels) make_levels(all, policy);
    if (rules_.allowed) make_allowed(all, policy);
  }

 private:
  template <class T, class Of>
  static std::vector<T> each(const Objects& all, const Of& of) {
    std::vector<T> values;
    for (const EditedObject* const o : all) values.push_back(of(*o));
    return values;
  }
  static std::vector<bool> picked(const Objects& all, std::size_t pick) {
    return each<bool>(all, [&](const EditedObject& o) { return o.picks[pick]; });
  }

  /// Returns so many numbers in any order.
  std::vector<std::uint32_t> numbers(std::size_t n) {
    std::vector<std::uint32_t> all(n);
    std::iota(all.begin(), all.end(), 0U);
    std::ranges::shuffle(all, shuffling_);
    return all;
  }
  std::vector<Hash128> names_of(const std::vector<std::uint32_t>& numbered) const {
    std::vector<Hash128> names;
    if (!rules_.named) return names;
    names.resize(numbered.size());
    for (std::size_t i = 0; i < numbered.size(); ++i) names[numbered[i]] = {7, i};
    return names;
  }

  clash::SameLabel same_label(const Objects& all, std::size_t which) {
    const std::vector<std::uint32_t> numbered = numbers(5);
    return {each<std::uint32_t>(all,
                                [&](const EditedObject& o) {
                                  const int label = o.labels[which];
                                  return label < 0 ? clash::kNoLabel
                                                   : numbered[static_cast<std::size_t>(label)];
                                }),
            names_of(numbered)};
  }

  clash::Linked linked(const Objects& all) {
    const std::vector<std::uint32_t> numbered = numbers(8);
    clash::Linked links{{{0}, {}}, {{0}, {}}, names_of(numbered)};
    const auto append = [&](clash::Linked::Lists& lists, const std::vector<int>& of) {
      std::vector<std::uint32_t> own;
      for (const int n : of) own.push_back(numbered[static_cast<std::size_t>(n)]);
      std::ranges::sort(own);
      own.erase(std::unique(own.begin(), own.end()), own.end());
      lists.numbers.insert(lists.numbers.end(), own.begin(), own.end());
      lists.first.push_back(static_cast<std::uint32_t>(lists.numbers.size()));
    };
    for (const EditedObject* const o : all) {
      append(links.refers_to, o->refers);
      append(links.answers_to, o->answers);
    }
    return links;
  }

  static void make_matrix(const Objects& all, clash::Policy& policy) {
    policy.tolerances.push_back({.clearance_mm = 40});
    clash::Matrix m;
    m.disciplines = {"hull", "pipe", "cable"};
    m.discipline = each<std::uint32_t>(
        all, [](const EditedObject& o) { return static_cast<std::uint32_t>(o.discipline); });
    constexpr std::uint32_t kUsual = clash::Matrix::kDefault, kNone = clash::Matrix::kNotChecked;
    m.cells = {kUsual, 0, kNone, 0, kUsual, 0, kNone, 0, kUsual};
    policy.matrix = m;
  }

  static void make_levels(const Objects& all, clash::Policy& policy) {
    clash::Levels levels;
    levels.object = each<clash::Level>(all, [](const EditedObject& o) { return o.level; });
    levels.left_out[1][2] = levels.left_out[2][1] = "soft and insulation";
    policy.levels = levels;
  }

  static clash::Allowed allowance(const char* rule, const Objects& all, std::size_t pick) {
    clash::Allowed allowed;
    allowed.rule = rule;
    allowed.a = picked(all, pick);
    allowed.b = picked(all, pick + 1);
    return allowed;
  }

  void make_allowed(const Objects& all, clash::Policy& policy) const {
    clash::Allowed deep = allowance("deep", all, 2);
    deep.max_depth_mm = rules_.depth_mm;
    clash::Allowed here = allowance("here", all, 3);
    here.region_mm = geometry::Box3d{{0, 0, 0}, {90, 90, 90}};
    clash::Allowed rest = allowance("rest", all, 4);
    if (rules_.by_volume) rest.max_volume_mm3 = 2000;
    if (rules_.by_relation)
      deep.relations = {clash::Relation::abut_outside, clash::Relation::interfere};
    rest.max_depth_mm = 8;
    policy.allowed = {deep, here, rest, deep};
    policy.allowed.back().rule = "deep again";
  }

  const EditedRules& rules_;
  std::mt19937& shuffling_;
};

}  // namespace strake::test
