// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clash/candidate.hpp"
#include "clash/object_pairs.hpp"
#include "clash/parts.hpp"
#include "clash/set_masks.hpp"
#include "strake/clash/policy.hpp"
#include "strake/geometry/bvh.hpp"

namespace strake::clash {

/// The rules of a policy as a pair of objects is asked about them.
class PairRules {
 public:
  /// The policy must outlive this.
  PairRules(const Policy& policy, const Options& options, const model::Model& model);

  /// What a pair is judged by: all() has the test's own tolerances first, then the policy's.
  [[nodiscard]] const std::vector<Tolerances>& all() const { return tolerances_; }
  [[nodiscard]] std::size_t tolerances(std::uint32_t a, std::uint32_t b) const;
  /// How far apart parts may be for the test to look at them, mm.
  [[nodiscard]] double reach_mm() const;

  [[nodiscard]] Level level(const PartRef& part) const;

  /// Takes out what is exempted, and what is nearer than reach_mm() but not than the pair's own
  /// tolerances ask. `pairs` is by objects.
  [[nodiscard]] Status exempt(const PartList& list, std::vector<geometry::IndexPair>& pairs,
                              const parallel::Context& context, Report& report) const;

  /// Counts the pairs of objects that went on for the rules that may allow them.
  [[nodiscard]] Status count_candidates(const Judged& judged, const ObjectPairs& objects,
                                        const parallel::Context& context, Report& report) const;
  [[nodiscard]] bool may_allow(std::uint32_t a, std::uint32_t b) const;
  /// Pair::allowed by the first rule that allows the result; flagged uncertain where the place may
  /// reach beyond what the rule allows. `extent_mm` holds the place; none: it may be anywhere
  /// between the two parts.
  void allow(const PartRef& a, const PartRef& b, const std::optional<geometry::Box3d>& extent_mm,
             Pair& pair) const;

  /// Names the rules in force, with counts of 0, and the disciplines of the sets.
  void open(const Sets& sets, Report& report) const;
  /// Counts the pairs by class, rule and cell.
  [[nodiscard]] Status close(const parallel::Context& context, Report& report) const;

 private:
  /// What becomes of one pair of parts.
  struct Verdict {
    std::uint32_t rule = kNoLabel;  ///< kNoLabel: none exempts it
    bool far = false;               ///< out of the reach of its own tolerances
  };
  /// Pairs of parts and their verdicts.
  struct Verdicts {
    const PartList& list;
    const std::vector<geometry::IndexPair>& pairs;
    const std::vector<Verdict>& verdicts;
  };
  [[nodiscard]] Verdict verdict(const PartRef& a, const PartRef& b) const;
  [[nodiscard]] std::uint32_t object_rule(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] std::uint32_t level_rule(Level a, Level b) const;
  [[nodiscard]] std::uint32_t cell(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] double own_reach(const PartRef& a, const PartRef& b) const;
  [[nodiscard]] bool within_own_reach(const PartRef& a, const PartRef& b) const;
  void number_level_rules();
  // Of rules that do nothing: whether that is because earlier ones have done it.
  [[nodiscard]] Status note_shadowed(const Verdicts& all, const parallel::Context& context,
                                     Report& report) const;
  [[nodiscard]] Status note_shadowed_allowances(const parallel::Context& context,
                                                Report& report) const;
  /// The place of a pair's cell in Report::cells, or kNoCell.
  [[nodiscard]] std::size_t cell_number(const Pair& pair) const;
  static constexpr std::size_t kNoCell = ~std::size_t{0};

  const Policy& policy_;
  const model::Model& model_;
  std::vector<Tolerances> tolerances_;
  bool one_reach_ = true;
  SetMasks between_, allowed_;
  std::vector<std::uint32_t> between_rule_;  ///< per Between: its exemption
  std::vector<std::string> level_rules_;     ///< distinct, after the exemptions in reports
};

}  // namespace strake::clash
