// SPDX-License-Identifier: Apache-2.0
#include "model/attribute_uses.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "core/text/edit_distance.hpp"
#include "core/text_encoding.hpp"

namespace strake::model {
namespace {

class AttributeCounter {
 public:
  explicit AttributeCounter(const Model& model)
      : model_(model), stated_(model.group_attributes.size()) {}

  void add(const Object& object) {
    ++object_;
    level_ = 0;
    for (const auto& [name, value] : object.attributes) {
      const std::uint32_t use = number_of(name);
      if (takes(use)) add_value(use, value);
    }
    GroupId at = object.parent;
    for (std::size_t steps = 0; index(at) < model_.groups.size() && steps < model_.groups.size();
         ++steps) {
      const Group& group = model_.groups[index(at)];
      ++level_;
      if (group.attributes < stated_.size()) add_group(group.attributes);
      at = group.parent;
    }
  }

  [[nodiscard]] std::vector<AttributeUse> uses() const {
    std::vector<AttributeUse> out;
    for (const auto& [name, number] : numbers_) {
      const Use& use = uses_[number];
      if (use.objects > 0) out.push_back({name, use.objects, use.values.size(), use.examples});
    }
    return out;
  }

 private:
  struct Use {
    std::uint64_t objects = 0;
    std::set<std::string_view> values;
    std::vector<std::string_view> examples;
    /// The last object that stated it, counted from 1, and where: 0 itself, 1 its parent, ...
    std::uint64_t last_object = 0, last_level = 0;
  };
  /// What a group states, worked out once for all objects below.
  struct Statement {
    std::uint32_t use = 0;
    std::string_view value;
    bool counted = false;  ///< whether the value is known already
  };

  std::uint32_t number_of(std::string_view name) {
    const auto [at, is_new] = numbers_.try_emplace(name, static_cast<std::uint32_t>(uses_.size()));
    if (is_new) uses_.emplace_back();
    return at->second;
  }

  /// Whether what stands at this level is what the object states: nothing nearer says otherwise. A
  /// name that stands there twice counts for one object.
  bool takes(std::uint32_t number) {
    Use& use = uses_[number];
    if (use.last_object == object_) return use.last_level == level_;
    use.last_object = object_;
    use.last_level = level_;
    ++use.objects;
    return true;
  }

  void add_value(std::uint32_t number, std::string_view value) {
    Use& use = uses_[number];
    if (!use.values.insert(value).second) return;
    if (use.examples.size() < AttributeUse::kMaxExamples) use.examples.push_back(value);
  }

  void add_group(std::uint32_t attributes) {
    std::optional<std::vector<Statement>>& stated = stated_[attributes];
    if (!stated) {
      stated.emplace();
      for (const auto& [name, value] : model_.group_attributes[attributes])
        stated->push_back({number_of(name), value, false});
    }
    for (Statement& statement : *stated) {
      if (!takes(statement.use) || std::exchange(statement.counted, true)) continue;
      add_value(statement.use, statement.value);
    }
  }

  const Model& model_;
  std::map<std::string_view, std::uint32_t> numbers_;
  std::vector<Use> uses_;
  std::vector<std::optional<std::vector<Statement>>> stated_;
  std::uint64_t object_ = 0, level_ = 0;
};

/// Returns the names that are spelt alike but for case, the nearest first.
std::vector<std::string_view> spelt_alike(std::string_view name,
                                          std::span<const AttributeUse> uses) {
  constexpr std::size_t kLongest = 64;  // nobody misspells more
  const std::string sought = lowered(name);
  std::vector<std::pair<std::size_t, std::string_view>> near;
  for (const AttributeUse& use : uses) {
    if (name.size() > kLongest || use.name.size() > kLongest) continue;
    const std::string known = lowered(use.name);
    const std::size_t distance = edit_distance(sought, known);
    const bool holds = known.find(sought) != std::string::npos;
    if (holds || distance <= name.size() / 3) near.emplace_back(distance, use.name);
  }
  std::ranges::sort(near);
  std::vector<std::string_view> names;
  for (const auto& [distance, spelt] : near) names.push_back(spelt);
  return names;
}

std::vector<std::string_view> most_used(std::span<const AttributeUse> uses) {
  std::vector<const AttributeUse*> order;
  for (const AttributeUse& use : uses) order.push_back(&use);
  // Of equally many those come first that are first in the list.
  std::ranges::sort(order, [](const AttributeUse* x, const AttributeUse* y) {
    return x->objects != y->objects ? x->objects > y->objects : std::less<>()(x, y);
  });
  std::vector<std::string_view> names;
  for (const AttributeUse* const use : order) names.push_back(use->name);
  return names;
}

}  // namespace

std::vector<AttributeUse> attribute_uses(const Model& model, std::size_t from, std::size_t to) {
  AttributeCounter counter(model);
  for (const Object& object : model.objects)
    if (object.file >= from && object.file < to) counter.add(object);
  return counter.uses();
}

std::string no_object_states(std::string_view name, std::span<const AttributeUse> uses) {
  constexpr std::size_t kMaxNear = 3, kMaxListed = 12;
  std::string text = "no object states @" + printable(name);
  if (uses.empty()) return text + ", nor any other attribute";
  std::vector<std::string_view> names = spelt_alike(name, uses);
  const bool near = !names.empty();
  if (!near) names = most_used(uses);
  names.resize(std::min(names.size(), near ? kMaxNear : kMaxListed));
  text += near ? "; spelt alike: " : "; there are ";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i > 0 ? ", @" : "@") + printable(names[i]);
  if (names.size() < uses.size() && !near)
    text += " and " + std::to_string(uses.size() - names.size()) + " more";
  return text;
}

}  // namespace strake::model
