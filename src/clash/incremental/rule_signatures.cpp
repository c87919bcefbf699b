// SPDX-License-Identifier: Apache-2.0
#include "clash/incremental/rule_signatures.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "clash/rules/rule_matcher.hpp"
#include "clash/rules/tolerance_lengths.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/core/version.hpp"

namespace strake::clash {
namespace {

void add_relations(WordHash& hash, const RelationSet& relations) {
  std::uint64_t bits = 0;
  for (const Relation relation : kRelations)
    bits = (bits << 1U) | (relations.contains(relation) ? 1U : 0U);
  hash.add(bits);
}

// What these take apart has to be taken apart anew where it gets another member, so that none is
// forgotten in the signatures.

void add_tolerances(WordHash& hash, const Tolerances& t) {
  const auto& [clearance, gap, overlap, cap, clearances] = t;
  for (const ToleranceLength& length : kToleranceLengths) hash.add(t.*length.value_mm);
  hash.add(static_cast<std::uint8_t>(cap)).add(clearances != nullptr);
  if (clearances) hash.add(std::string_view(clearances->attribute));
}

void add_engine(WordHash& hash, const EngineOptions& e) {
  // The broad phase, the log and what is kept change no result.
  const auto& [broad, narrow, spheres, volumes, curves, contacts, regions, log, keep, pairs] = e;
  hash.add(static_cast<std::uint8_t>(narrow))
      .add(spheres)
      .add(static_cast<std::uint8_t>(volumes))
      .add(static_cast<std::uint8_t>(curves))
      .add(static_cast<std::uint8_t>(contacts))
      .add(regions)
      .add(pairs);
}

void add_matrix(WordHash& hash, const Matrix& matrix) {
  hash.add(std::string_view(matrix.rule)).add(matrix.disciplines.size());
  for (const std::string& name : matrix.disciplines) hash.add(std::string_view(name));
  for (const std::uint32_t cell : matrix.cells) hash.add(cell);
}

void add_levels(WordHash& hash, const Levels& levels) {
  hash.add(static_cast<std::uint8_t>(levels.obstruction_bodies));
  hash.add(std::string_view(levels.no_obstruction_rule));
  for (const auto& row : levels.left_out)
    for (const std::string& rule : row) hash.add(std::string_view(rule));
}

void add_point(WordHash& hash, const geometry::Vec3d& p) { hash.add(p.x).add(p.y).add(p.z); }

void add_limit(WordHash& hash, const std::optional<double>& limit) {
  hash.add(limit.has_value()).add(limit.value_or(0));
}

void add_allowed(WordHash& hash, const Allowed& rule) {
  // Which objects it concerns stands in their own signatures.
  const auto& [name, a, b, region, cavity, max_depth, relations, max_volume] = rule;
  hash.add(std::string_view(name)).add(region.has_value());
  if (region) {
    add_point(hash, region->lo);
    add_point(hash, region->hi);
  }
  hash.add(cavity.size());
  for (const HalfSpace& side : cavity) {
    add_point(hash, side.point_mm);
    add_point(hash, side.normal);
  }
  add_limit(hash, max_depth);
  add_relations(hash, relations);
  add_limit(hash, max_volume);
}

/// Names each number by its first object, which no other number has.
std::vector<Hash128> named_by_first(const std::vector<std::uint32_t>& numbers,
                                    const ElementHashes& elements) {
  std::uint32_t largest = 0;
  for (const std::uint32_t n : numbers)
    if (n != kNoLabel) largest = std::max(largest, n + 1);
  std::vector<Hash128> names(largest);
  std::vector<bool> named(largest, false);
  for (std::uint32_t o = 0; o < numbers.size(); ++o) {
    const std::uint32_t n = numbers[o];
    if (n == kNoLabel || named[n]) continue;
    named[n] = true;
    names[n] = elements.of(o);
  }
  return names;
}

/// Adds to each number's name the objects of some lists.
void name_by_holders(const Linked::Lists& lists, const ElementHashes& elements, std::uint64_t side,
                     std::vector<Hash128>& names) {
  for (std::uint32_t o = 0; o + 1 < lists.first.size(); ++o) {
    if (lists.first[o] == lists.first[o + 1]) continue;
    const Hash128 holder = WordHash().add(elements.of(o)).add(side).value();
    for (std::uint32_t i = lists.first[o]; i < lists.first[o + 1]; ++i)
      names[lists.numbers[i]] = sum(names[lists.numbers[i]], holder);
  }
}

std::vector<Hash128> named_by_holders(const Linked& linked, const ElementHashes& elements) {
  std::uint32_t largest = 0;
  for (const Linked::Lists* const lists : {&linked.answers_to, &linked.refers_to})
    for (const std::uint32_t n : lists->numbers) largest = std::max(largest, n + 1);
  std::vector<Hash128> names(largest);
  name_by_holders(linked.answers_to, elements, 1, names);
  name_by_holders(linked.refers_to, elements, 2, names);
  return names;
}

/// Returns a hash of an object's numbers by their names, in whatever order they are listed.
Hash128 sum_of_names(const Linked::Lists& lists, const std::vector<Hash128>& names,
                     std::uint32_t object) {
  Hash128 all;
  for (std::uint32_t i = lists.first[object]; i < lists.first[object + 1]; ++i)
    all = sum(all, WordHash().add(names[lists.numbers[i]]).value());
  return all;
}

/// Adds a flag of each object, many to a word.
void add_flags(WordHash& hash, const std::vector<bool>& flags) {
  hash.add(flags.size());
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    word = word << 1U | (flags[i] ? 1U : 0U);
    if (i % 64 == 63) hash.add(std::exchange(word, 0));
  }
  hash.add(word);
}

/// Adds the values of a list, whose type has no padding, as they lie in memory.
template <class T>
void add_values(WordHash& hash, const std::vector<T>& values) {
  static_assert(std::has_unique_object_representations_v<T> || std::is_same_v<T, double>);
  hash.add(values.size()).add(hash_bytes(std::as_bytes(std::span(values))));
}

/// Adds what an exemption says of each object, by its numbers.
struct ExemptionInputs {
  WordHash& hash;

  void operator()(const Between& test) const {
    add_flags(hash, test.a);
    add_flags(hash, test.b);
  }
  void operator()(const SameLabel& test) const {
    add_values(hash, test.label);
    add_values(hash, test.names);
  }
  void operator()(const Linked& test) const {
    for (const Linked::Lists* const lists : {&test.answers_to, &test.refers_to}) {
      add_values(hash, lists->first);
      add_values(hash, lists->numbers);
    }
    add_values(hash, test.names);
  }
};

}  // namespace

Hash128 settings_signature(const model::Scene& scene, const Sets& sets, const Options& options,
                           const Policy& policy) {
  WordHash hash;
  hash.add(version()).add(scene.sag_mm).add(scene.weld_mm);
  hash.add(std::string_view(sets.name_a)).add(std::string_view(sets.name_b));
  hash.add(sets.group.empty());
  add_tolerances(hash, options.tolerances);
  hash.add(options.contact_distance_mm);
  add_engine(hash, options.engine);
  add_relations(hash, options.reporting.relations);
  hash.add(options.reporting.min_volume_mm3);
  hash.add(policy.tolerances.size());
  for (const Tolerances& t : policy.tolerances) add_tolerances(hash, t);
  hash.add(policy.matrix.has_value());
  if (policy.matrix) add_matrix(hash, *policy.matrix);
  hash.add(policy.exemptions.size());
  for (const Exemption& exemption : policy.exemptions)
    hash.add(std::string_view(exemption.rule)).add(exemption.test.index());
  hash.add(policy.levels.has_value());
  if (policy.levels) add_levels(hash, *policy.levels);
  hash.add(policy.allowed.size());
  for (const Allowed& rule : policy.allowed) add_allowed(hash, rule);
  return hash.add(policy.list_exempted).value();
}

Hash128 hash_of_inputs(const model::Scene& scene, const Sets& sets, const Options& options,
                       const Policy& policy) {
  WordHash hash;
  hash.add(settings_signature(scene, sets, options, policy));
  add_flags(hash, sets.in_a);
  add_flags(hash, sets.in_b);
  add_values(hash, sets.group);
  add_values(hash, sets.group_names);
  for (const Exemption& exemption : policy.exemptions)
    std::visit(ExemptionInputs{hash}, exemption.test);
  for (const Allowed& rule : policy.allowed) {
    add_flags(hash, rule.a);
    add_flags(hash, rule.b);
  }
  if (policy.matrix) add_values(hash, policy.matrix->discipline);
  if (policy.levels) add_values(hash, policy.levels->object);
  for (const Tolerances& t : all_tolerances(policy, options))
    if (t.object_clearances) add_values(hash, t.object_clearances->mm);
  return hash.value();
}

RuleSignatures::RuleSignatures(const Sets& sets, const Options& options, const Policy& policy,
                               const ElementHashes& elements)
    : sets_(sets),
      policy_(policy),
      groups_(sets.group_names.empty() ? named_by_first(sets.group, elements) : sets.group_names),
      names_(policy.exemptions.size()) {
  for (const Tolerances& t : all_tolerances(policy, options))
    if (t.object_clearances) clearances_.push_back(t.object_clearances.get());
  for (std::size_t e = 0; e < policy.exemptions.size(); ++e) {
    const auto& test = policy.exemptions[e].test;
    if (const auto* const same = std::get_if<SameLabel>(&test))
      names_[e] = same->names.empty() ? named_by_first(same->label, elements) : same->names;
    if (const auto* const linked = std::get_if<Linked>(&test))
      names_[e] = linked->names.empty() ? named_by_holders(*linked, elements) : linked->names;
  }
}

void RuleSignatures::add(std::uint32_t object, WordHash& hash) const {
  std::uint64_t bits = (sets_.in_a[object] ? 1U : 0U) | (sets_.in_b[object] ? 2U : 0U);
  unsigned used = 2;
  const auto add_bits = [&](bool a, bool b) {
    if (used == 64) {
      hash.add(bits);
      bits = used = 0;
    }
    bits |= (std::uint64_t{a} | (std::uint64_t{b} << 1U)) << used;
    used += 2;
  };
  for (const Allowed& rule : policy_.allowed) add_bits(rule.a[object], rule.b[object]);
  for (std::size_t e = 0; e < policy_.exemptions.size(); ++e) {
    const auto& test = policy_.exemptions[e].test;
    if (const auto* const between = std::get_if<Between>(&test)) {
      add_bits(between->a[object], between->b[object]);
    } else if (const auto* const same = std::get_if<SameLabel>(&test)) {
      const std::uint32_t label = same->label[object];
      hash.add(label != kNoLabel).add(label == kNoLabel ? Hash128{} : names_[e][label]);
    } else {
      add_linked(object, std::get<Linked>(test), names_[e], hash);
    }
  }
  hash.add(bits);
  if (!sets_.group.empty()) hash.add(groups_[sets_.group[object]]);
  if (policy_.matrix) hash.add(policy_.matrix->discipline[object]);
  if (policy_.levels) hash.add(static_cast<std::uint8_t>(policy_.levels->object[object]));
  for (const ObjectClearances* const clearances : clearances_) hash.add(clearances->mm[object]);
}

void RuleSignatures::add_linked(std::uint32_t object, const Linked& linked,
                                const std::vector<Hash128>& names, WordHash& hash) const {
  for (const Linked::Lists* const lists : {&linked.answers_to, &linked.refers_to})
    hash.add(sum_of_names(*lists, names, object))
        .add(lists->first[object + 1] - lists->first[object]);
}

}  // namespace strake::clash
