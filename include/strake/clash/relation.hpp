// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>

namespace strake::clash {

/// How one object stands to another; docs/clash.md defines each.
enum class Relation : std::uint8_t {
  separate,
  abut_outside,
  abut_inside,
  interfere,
  a_in_b,
  b_in_a,
  duplicate,
  cross,
};

inline constexpr std::array kRelations{
    Relation::separate, Relation::abut_outside, Relation::abut_inside, Relation::interfere,
    Relation::a_in_b,   Relation::b_in_a,       Relation::duplicate,   Relation::cross};

/// Returns the relation of b to a where that of a to b is given.
[[nodiscard]] constexpr Relation reversed(Relation relation) {
  if (relation == Relation::a_in_b) return Relation::b_in_a;
  return relation == Relation::b_in_a ? Relation::a_in_b : relation;
}

/// Some of the relations. Those with a direction are about the a and the b of whatever holds the
/// set, a rule or a test, which a result may name the other way round.
class RelationSet {
 public:
  constexpr RelationSet() = default;
  constexpr RelationSet(std::initializer_list<Relation> relations) {
    for (const Relation relation : relations) add(relation);
  }
  constexpr void add(Relation relation) { bits_ |= bit(relation); }
  constexpr void add(RelationSet others) { bits_ |= others.bits_; }
  [[nodiscard]] constexpr bool contains(Relation relation) const {
    return (bits_ & bit(relation)) != 0;
  }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  /// Whether the set has the relation that a result states: `forward` where the result's a is of
  /// the set's a and its b of the set's b, `backward` where they are so the other way round.
  [[nodiscard]] constexpr bool contains(Relation relation, bool forward, bool backward) const {
    return (forward && contains(relation)) || (backward && contains(reversed(relation)));
  }
  friend constexpr bool operator==(RelationSet, RelationSet) = default;

 private:
  [[nodiscard]] static constexpr std::uint32_t bit(Relation relation) {
    return std::uint32_t{1} << static_cast<std::uint32_t>(relation);
  }
  std::uint32_t bits_ = 0;
};

}  // namespace strake::clash
