// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0009 says why rules are asked about objects and answers about parts.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/pairs/common_volume.hpp"
#include "clash/pairs/pair_tasks.hpp"
#include "geometry/bvh/scene_bvh.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/policy.hpp"

/// Applies the rules of a policy to pairs of objects.
namespace strake::clash {

/// Rules of the form "one of A and one of B" as bits of each object, so that all rules are applied
/// to a pair at once.
class RuleBitmasks {
 public:
  explicit RuleBitmasks(std::size_t objects, std::size_t rules)
      : words_((rules + kBits - 1) / kBits), bits_(objects * words_) {}

  /// Sets the bits of a rule, of some objects only where they are given.
  void set(std::size_t rule, const std::vector<bool>& a, const std::vector<bool>& b,
           std::optional<std::span<const std::uint32_t>> only) {
    const std::size_t word = rule / kBits;
    const std::uint64_t bit = std::uint64_t{1} << (rule % kBits);
    const auto set_of = [&](std::size_t o) {
      Bits& bits = bits_[o * words_ + word];
      if (a[o]) bits.a |= bit;
      if (b[o]) bits.b |= bit;
    };
    if (only) {
      for (const std::uint32_t o : *only) set_of(o);
    } else {
      for (std::size_t o = 0; o < a.size(); ++o) set_of(o);
    }
  }

  /// Calls `take(rule)` for each rule that concerns the two, in order, until it returns true.
  template <class Take>
  void each(std::uint32_t x, std::uint32_t y, Take&& take) const {
    for (std::size_t w = 0; w < words_; ++w) {
      const Bits &p = bits_[x * words_ + w], &q = bits_[y * words_ + w];
      for (std::uint64_t both = (p.a & q.b) | (p.b & q.a); both != 0; both &= both - 1)
        if (take(w * kBits + static_cast<std::size_t>(std::countr_zero(both)))) return;
    }
  }

 private:
  static constexpr std::size_t kBits = 64;
  struct Bits {
    std::uint64_t a = 0, b = 0;
  };
  std::size_t words_;
  std::vector<Bits> bits_;  ///< words_ entries of each object
};

/// The number of pairs of each class, without those that a rule allows.
struct ClassCounts {
  std::uint64_t hit = 0, contact = 0, clearance_violation = 0, allowed = 0;

  void add(const Pair& pair) {
    if (pair.allowed >= 0)
      ++allowed;
    else if (pair.cls == Class::hit)
      ++hit;
    else if (pair.cls == Class::contact)
      ++contact;
    else if (pair.cls == Class::clearance_violation)
      ++clearance_violation;
  }
  void add(const ClassCounts& o) {
    hit += o.hit;
    contact += o.contact;
    clearance_violation += o.clearance_violation;
    allowed += o.allowed;
  }
};

/// What is counted over the pairs of a report.
struct ClassTotals {
  ClassCounts all;
  std::vector<std::uint64_t> by_rule;  ///< pairs that each rule allows
  std::vector<ClassCounts> by_cell;

  ClassTotals(std::size_t rules, std::size_t cells) : by_rule(rules, 0), by_cell(cells) {}
  ClassTotals() = default;

  void add(const Pair& pair, std::size_t cell) {
    all.add(pair);
    if (pair.allowed >= 0) ++by_rule[static_cast<std::size_t>(pair.allowed)];
    if (cell < by_cell.size()) by_cell[cell].add(pair);
  }
  void add(const ClassTotals& o) {
    all.add(o.all);
    for (std::size_t r = 0; r < by_rule.size(); ++r) by_rule[r] += o.by_rule[r];
    for (std::size_t c = 0; c < by_cell.size(); ++c) by_cell[c].add(o.by_cell[c]);
  }
};

// The following functions apply one rule of a policy by itself.

/// Returns a usage error for a policy whose lists do not have one entry per object.
[[nodiscard]] Status check(const Policy& policy, std::size_t objects);

/// Returns a usage error where rules or the test request relations or volumes, which the baseline
/// does not show.
[[nodiscard]] Status check_narrow_phase(const Policy& policy, const Options& options);

/// Returns the cell of two objects in a matrix.
[[nodiscard]] std::uint32_t cell_of(const Matrix& matrix, std::uint32_t a, std::uint32_t b);

/// Returns how far apart, in mm, two objects may be and still be a result, where they add so much
/// to the clearance.
[[nodiscard]] double reach_of(const Tolerances& t, double added_mm);

/// Whether the rule leaves out pairs of these two objects.
[[nodiscard]] bool exempts(const Between& test, std::uint32_t a, std::uint32_t b);
[[nodiscard]] bool exempts(const SameLabel& test, std::uint32_t a, std::uint32_t b);
[[nodiscard]] bool exempts(const Linked& test, std::uint32_t a, std::uint32_t b);

/// Whether a result of two objects that a rule concerns is meant, by its depth, its relation and
/// its point. `moved_mm` is what the snap accounts for in its bracket.
[[nodiscard]] bool allows(const Allowed& rule, const Pair& pair, double moved_mm);
/// Whether the bracket of a result that is meant reaches as deep as the rule allows.
[[nodiscard]] bool is_as_deep_as_allowed(const Allowed& rule, const Pair& pair);

/// Whether every point of a box lies within the rule's region and cavity.
[[nodiscard]] bool contains_box(const Allowed& rule, const geometry::Box3d& box);

/// Returns the tolerances of a test: its own first, then the policy's.
[[nodiscard]] std::vector<Tolerances> all_tolerances(const Policy& policy, const Options& options);

/// Sets the tolerances of the cells of a report to those of the matrix, if there is one.
void set_cell_tolerances(const Policy& policy, std::span<const Tolerances> all, Report& report);

/// Returns how far apart parts may be for a test with these tolerances to check them: as far as the
/// widest reach, and for each object what it may add to a clearance.
[[nodiscard]] SearchReach search_reach(std::span<const Tolerances> all);

/// Returns the index of a pair's cell in Report::cells; kNoCell where it has none.
[[nodiscard]] std::size_t cell_number(const Report& report, model::ObjectId x, model::ObjectId y);
inline constexpr std::size_t kNoCell = ~std::size_t{0};

/// The rules of a policy, prepared to be applied to pairs of objects.
class RuleMatcher {
 public:
  /// The policy must outlive this. `only`: it is asked about pairs of these objects alone.
  RuleMatcher(const Policy& policy, const Options& options, const model::Model& model,
              std::optional<std::span<const std::uint32_t>> only = {});

  /// The tolerances of pairs: all() has the test's own first, then the policy's.
  [[nodiscard]] const std::vector<Tolerances>& all() const { return tolerances_; }
  [[nodiscard]] std::size_t tolerances(std::uint32_t a, std::uint32_t b) const;
  /// Returns what the two objects of a pair add to its clearance, mm.
  [[nodiscard]] double added_clearance_mm(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] SearchReach reach() const { return search_reach(tolerances_); }

  [[nodiscard]] Level level(const ScenePart& part) const;

  /// Removes exempted pairs, and pairs within reach() but beyond the reach of their own
  /// tolerances. `pairs` is by objects.
  [[nodiscard]] Status exempt(const ScenePartList& list, std::vector<geometry::IndexPair>& pairs,
                              const parallel::Context& context, Report& report) const;

  /// Counts the pairs of objects that went on, for the rules that may allow them, and keeps them
  /// where the report does.
  [[nodiscard]] Status count_candidates(const EvaluatedPairs& evaluated, const ObjectPairs& objects,
                                        const parallel::Context& context, Report& report) const;
  [[nodiscard]] bool may_allow(std::uint32_t a, std::uint32_t b) const;
  /// Whether a rule that concerns the two allows by the volume that they have in common.
  [[nodiscard]] bool limits_volume(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool limits_volumes() const;  ///< whether a rule does, whatever it concerns

  /// What is known of a result beside its numbers.
  struct PairContext {
    /// Encloses the region; if absent, it may be anywhere between the two parts.
    std::optional<geometry::Box3d> extent_mm;
    const CommonVolume* common = nullptr;  ///< not null where limits_volume()
  };
  /// Sets Pair::allowed by the first rule that allows the result, flagged uncertain where the
  /// region may reach beyond what the rule allows, or where the volume in common leaves open
  /// whether one does.
  void allow(const ScenePart& a, const ScenePart& b, const PairContext& known, Pair& pair) const;

  /// Names the rules in force, with counts of 0, and the disciplines of the sets.
  void begin_report(const Sets& sets, Report& report) const;
  /// Counts the pairs by class, rule and cell.
  [[nodiscard]] Status finish_report(const parallel::Context& context, Report& report) const;

 private:
  /// What becomes of one pair of parts.
  struct Verdict {
    std::uint32_t rule = kNoLabel;  ///< the rule that exempts it; kNoLabel: none
    bool far = false;               ///< beyond the reach of its own tolerances
  };
  [[nodiscard]] Verdict verdict(const ScenePart& a, const ScenePart& b) const;
  [[nodiscard]] std::uint32_t object_rule(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] std::uint32_t level_rule(Level a, Level b) const;
  [[nodiscard]] double own_reach(const ScenePart& a, const ScenePart& b) const;
  [[nodiscard]] bool within_own_reach(const ScenePart& a, const ScenePart& b) const;
  void number_level_rules();

  const Policy& policy_;
  const model::Model& model_;
  std::vector<Tolerances> tolerances_;
  bool one_reach_ = true;
  RuleBitmasks between_, allowed_;
  std::vector<std::uint32_t> between_rule_;  ///< the exemption of each Between
  std::vector<std::string> level_rules_;     ///< distinct, after the exemptions in reports
};

}  // namespace strake::clash
