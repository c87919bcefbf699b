// SPDX-License-Identifier: Apache-2.0
#include "rules/exemptions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/glob.hpp"
#include "core/number.hpp"
#include "core/seeded_hash.hpp"
#include "model/assemblies.hpp"
#include "model/attributes.hpp"
#include "model/ends/end_joints.hpp"
#include "model/hierarchy.hpp"
#include "strake/core/hash.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::rules {
namespace {

using clash::kNoLabel;
using clash::SameLabel;
using model::Assemblies;
using model::GroupId;
using model::Hierarchy;
using model::listed_values_of;
using model::Model;
using model::Object;
using model::values_of;

/// Numbers texts by their first appearance.
class Numbers {
 public:
  std::uint32_t of(std::string_view text) {
    const auto next = static_cast<std::uint32_t>(numbers_.size());
    const auto [at, is_new] = numbers_.try_emplace(std::string(text), next);
    if (is_new) names_.push_back(name_of(text));
    return at->second;
  }

  /// Returns what stays the same of each number from run to run: the text.
  [[nodiscard]] std::vector<Hash128> names() && { return std::move(names_); }

  static Hash128 name_of(std::string_view text) {
    return hash_bytes(std::as_bytes(std::span(text)));
  }

 private:
  std::unordered_map<std::string, std::uint32_t, SeededHash> numbers_;
  std::vector<Hash128> names_;
};

/// Names groups of a hierarchy by their file, their path and, where several have the same, by which
/// of these they are.
class GroupNames {
 public:
  GroupNames(const Model& model, const Hierarchy& hierarchy)
      : model_(model), hierarchy_(hierarchy), names_(model.groups.size()), named_(names_.size()) {}

  /// Names the group at the end of a path of an object.
  void name(const Object& object, std::span<const GroupId> path) {
    const std::size_t group = index(path.back());
    if (named_[group]) return;
    named_[group] = true;
    std::string text = model_.files[object.file].label;
    for (const GroupId g : path) text += '\0' + std::string(hierarchy_.name(g));
    names_[group] = Hasher().add(std::string_view(text)).add(of_path_[text]++).value();
  }

  [[nodiscard]] std::vector<Hash128> names() && { return std::move(names_); }

 private:
  const Model& model_;
  const Hierarchy& hierarchy_;
  std::vector<Hash128> names_;
  std::vector<bool> named_;
  std::unordered_map<std::string, std::uint32_t, SeededHash> of_path_;
};

/// Finds the objects for which references that groups state hold: a branch names what it connects
/// its ends to, and its components inherit that.
class ConnectedReferences {
 public:
  ConnectedReferences(const Model& model, const ConnectedRule& rule) : model_(model), rule_(rule) {
    if (rule.heirs != Heirs::ends || model.group_attributes.empty()) return;
    ends_.resize(rule.references.size());
    for (std::uint32_t o = 0; o < model.objects.size(); ++o)
      for (std::size_t a = 0; a < ends_.size(); ++a) {
        const Model::Stated stated = model.stated(model.objects[o], rule.references[a].attribute);
        if (stated.group == GroupId::none) continue;
        GroupEnds& ends = ends_[a].try_emplace(stated.group, GroupEnds{o, o}).first->second;
        if (place(o) < place(ends.first)) ends.first = o;
        if (place(o) >= place(ends.last)) ends.last = o;
      }
  }

  /// Returns what object `o` refers to.
  [[nodiscard]] std::vector<std::string_view> of(std::uint32_t o) const {
    std::vector<std::string_view> values;
    for (std::size_t a = 0; a < rule_.references.size(); ++a) {
      const std::string& attribute = rule_.references[a].attribute;
      const Model::Stated stated = model_.stated(model_.objects[o], attribute);
      if (stated.attributes == nullptr) continue;
      if (stated.group != GroupId::none && !speaks(o, a, stated.group)) continue;
      const auto more = listed_values_of(*stated.attributes, attribute, rule_.separator);
      values.insert(values.end(), more.begin(), more.end());
    }
    return values;
  }

 private:
  struct GroupEnds {
    std::uint32_t first = 0, last = 0;
  };
  [[nodiscard]] std::uint32_t place(std::uint32_t o) const { return model_.objects[o].place; }
  [[nodiscard]] bool speaks(std::uint32_t o, std::size_t reference, GroupId group) const {
    if (rule_.heirs != Heirs::ends) return rule_.heirs == Heirs::all;
    const GroupEnds& ends = ends_[reference].at(group);
    const ReferenceEnd end = rule_.references[reference].end;
    return (end != ReferenceEnd::tail && o == ends.first) ||
           (end != ReferenceEnd::head && o == ends.last);
  }

  const Model& model_;
  const ConnectedRule& rule_;
  std::vector<std::map<GroupId, GroupEnds>> ends_;  ///< by reference
};

SameLabel unlabelled(const RuleContext& rule_context) {
  return {std::vector<std::uint32_t>(rule_context.objects(), kNoLabel), {}};
}

/// Fills in the labels of one kind of rule.
struct Labelling {
  const ExemptingRule& rule;
  RuleContext& rule_context;
  std::vector<bool> among;

  using Test = decltype(clash::Exemption::test);

  Test operator()(const UnitRule& units) const {
    const std::vector<Object>& objects = rule_context.model().objects;
    std::vector<std::int64_t> unit(objects.size(), -1);
    std::vector<bool> labelled(objects.size());
    for (const UnitRule::UnitGroup& group : units.groups) {
      const std::vector<bool> picked = rule_context.pick(group.chooser);
      rule_context.check_shadow(
          picked, [&](std::size_t o) { return !labelled[o]; }, group.chooser.where,
          "every object that it picks is in an earlier group");
      for (std::size_t o = 0; o < objects.size(); ++o) {
        if (!picked[o] || labelled[o]) continue;
        labelled[o] = true;
        unit[o] = group.number;
      }
    }
    bool some = units.attribute.empty();
    for (std::size_t o = 0; o < objects.size() && !units.attribute.empty(); ++o) {
      const auto values = values_of(rule_context.model(), objects[o], units.attribute);
      some = some || !values.empty();
      if (labelled[o]) continue;
      for (const std::string_view value : values) {
        if (const auto number = parse_integer(value))
          unit[o] = *number;
        else
          rule_context.diagnostics().add(Severity::warning, "unit-not-a-number",
                                         "the attribute '" + units.attribute + "' is '" +
                                             std::string(value) + "'; the object is in no unit",
                                         objects[o].id);
        labelled[o] = true;
        break;
      }
    }
    if (!some)
      rule_context.warn_no_match(rule.where,
                                 "no object has the attribute '" + units.attribute + "'");
    Numbers numbers;
    SameLabel test = unlabelled(rule_context);
    for (std::size_t o = 0; o < objects.size(); ++o)
      if (unit[o] >= 0 && among[o]) test.label[o] = numbers.of(std::to_string(unit[o]));
    test.names = std::move(numbers).names();
    return test;
  }

  Test operator()(const AssemblyRule& assembly) const {
    const Hierarchy hierarchy(rule_context.model());
    std::optional<Assemblies> assemblies;
    if (assembly.by_type) assemblies.emplace(rule_context.model());
    SameLabel test = unlabelled(rule_context);
    Numbers paths;
    GroupNames groups(rule_context.model(), hierarchy);
    bool some = false;
    for (std::size_t o = 0; o < test.label.size(); ++o) {
      const Object& object = rule_context.model().objects[o];
      if (!among[o]) continue;
      const std::vector<GroupId> path = hierarchy.path(object);
      const std::size_t depth =
          assemblies ? assemblies->depth(path) : depth_of(assembly, object, path, hierarchy);
      if (depth == 0) continue;
      some = true;
      if (!assembly.across_files) {
        test.label[o] = index(path[depth - 1]);
        groups.name(object, std::span(path).first(depth));
        continue;
      }
      std::string text;
      for (std::size_t g = 0; g < depth; ++g) text += hierarchy.name(path[g]) + '\0';
      // An object without a name is not the same as another without one.
      if (hierarchy.name(path[depth - 1]).empty()) text += std::to_string(index(path[depth - 1]));
      test.label[o] = paths.of(text);
    }
    test.names = assembly.across_files ? std::move(paths).names() : std::move(groups).names();
    if (!some)
      rule_context.warn_no_match(rule.where, assembly.by_type
                                                 ? "neither the attribute Type nor a name as "
                                                   "'BOX 1 of EQUIPMENT /P-101' tells what is an "
                                                   "equipment, a structure or a branch"
                                                 : "no object lies in such a group");
    return test;
  }

  /// Returns how many groups of the path lead to the assembly; 0 if it has none.
  static std::size_t depth_of(const AssemblyRule& assembly, const Object& object,
                              const std::vector<GroupId>& path, const Hierarchy& hierarchy) {
    if (assembly.level > 0) return assembly.level <= path.size() ? assembly.level : 0;
    for (std::size_t depth = path.size(); depth > 0; --depth)
      if (assembly.parent ? path[depth - 1] == object.parent
                          : glob_match(assembly.group, hierarchy.name(path[depth - 1])))
        return depth;
    return 0;
  }

  Test operator()(const AttributeRule& same) const {
    SameLabel test = unlabelled(rule_context);
    Numbers values;
    bool some = false;
    for (std::size_t o = 0; o < test.label.size(); ++o) {
      const auto found =
          values_of(rule_context.model(), rule_context.model().objects[o], same.attribute);
      if (found.empty() || !among[o]) continue;
      test.label[o] = values.of(found.front());
      some = true;
    }
    test.names = std::move(values).names();
    if (!some)
      rule_context.warn_no_match(rule.where,
                                 "no object has the attribute '" + same.attribute + "'");
    return test;
  }

  Test operator()(const FileRule&) const {
    SameLabel test = unlabelled(rule_context);
    for (std::size_t o = 0; o < test.label.size(); ++o)
      if (among[o]) test.label[o] = rule_context.model().objects[o].file;
    for (const model::SourceFile& file : rule_context.model().files)
      test.names.push_back(Numbers::name_of(file.label));
    return test;
  }

  Test operator()(const ExemptRule& exempt) const {
    return clash::Between{rule_context.pick(exempt.a), rule_context.pick(exempt.b)};
  }

  Test operator()(const ConnectedRule& connected) const {
    const Hierarchy hierarchy(rule_context.model());
    const ConnectedReferences references(rule_context.model(), connected);
    Numbers texts;
    clash::Linked test{{{0}, {}}, {{0}, {}}, {}};
    for (std::uint32_t o = 0; o < rule_context.objects(); ++o) {
      const Object& object = rule_context.model().objects[o];
      std::vector<std::uint32_t> refers, answers;
      if (among[o]) {
        for (const std::string_view value : references.of(o)) refers.push_back(texts.of(value));
        answers = connected.node ? refers : names(object, connected, hierarchy, texts);
      }
      append(test.refers_to, std::move(refers));
      append(test.answers_to, std::move(answers));
    }
    test.names = std::move(texts).names();
    if (test.refers_to.numbers.empty())
      rule_context.warn_no_match(rule.where, "no object has one of the attributes with a value");
    return test;
  }

  Test operator()(const EndsRule& ends) const {
    clash::Linked test{{{0}, {}}, {{0}, {}}, {}};
    std::vector<std::vector<std::uint32_t>> refers(rule_context.objects()), answers = refers;
    const std::vector<model::ObjectEnd> all = rule_context.ends(among);
    const auto joints = model::joints_of(all, std::llround(ends.within_mm * geometry::kGridPerMm),
                                         rule_context.context());
    if (!joints) rule_context.fail(joints.error());
    const std::size_t count = joints ? joints->size() : 0;
    // Each joint is a number of its own, which the one refers to and the other answers to.
    for (std::uint32_t joint = 0; joint < count; ++joint) {
      refers[(*joints)[joint].first].push_back(joint);
      answers[(*joints)[joint].second].push_back(joint);
      test.names.push_back(joint_name((*joints)[joint].first, (*joints)[joint].second));
    }
    for (std::size_t o = 0; o < refers.size(); ++o) {
      append(test.refers_to, std::move(refers[o]));
      append(test.answers_to, std::move(answers[o]));
    }
    if (count == 0)
      rule_context.warn_no_match(
          rule.where, all.empty() ? "no object has an end that is known"
                                  : "no two of " + std::to_string(all.size()) + " ends meet");
    return test;
  }

  /// Names a joint by the two objects that it is of.
  [[nodiscard]] Hash128 joint_name(std::uint32_t first, std::uint32_t second) const {
    Hasher name;
    for (const std::uint32_t o : {first, second}) {
      const Object& object = rule_context.model().objects[o];
      name.add(std::string_view(rule_context.model().files[object.file].label))
          .add(std::string_view(object.id));
    }
    return name.value();
  }

  static std::vector<std::uint32_t> names(const Object& object, const ConnectedRule& connected,
                                          const Hierarchy& hierarchy, Numbers& texts) {
    std::vector<std::uint32_t> numbers;
    for (const std::string& text : {object.id, object.name})
      if (!text.empty()) numbers.push_back(texts.of(text));
    for (const std::string_view value : values_of(object.attributes, "Name"))
      numbers.push_back(texts.of(value));
    if (!connected.groups) return numbers;
    for (const GroupId group : hierarchy.path(object)) {
      if (!hierarchy.name(group).empty()) numbers.push_back(texts.of(hierarchy.name(group)));
      const model::Attributes* const stated = hierarchy.attributes(group);
      if (stated == nullptr) continue;
      for (const char* const attribute : {"Name", "RefNo"})
        for (const std::string_view value : values_of(*stated, attribute))
          numbers.push_back(texts.of(value));
    }
    return numbers;
  }

  static void append(clash::Linked::Lists& lists, std::vector<std::uint32_t> numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    lists.numbers.insert(lists.numbers.end(), numbers.begin(), numbers.end());
    lists.first.push_back(static_cast<std::uint32_t>(lists.numbers.size()));
  }
};

}  // namespace

clash::Exemption exemption_of(const ExemptingRule& rule, RuleContext& rule_context) {
  return {rule.name,
          std::visit(Labelling{rule, rule_context, rule_context.pick(rule.among)}, rule.rule)};
}

}  // namespace strake::rules
