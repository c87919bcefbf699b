// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "clash/pairs/pair_result.hpp"

namespace strake::clash {

/// Whether a comes before b in an order of parts by what they are and where they lie relative to
/// each other, so that a pair is evaluated the same way round whichever is called a.
[[nodiscard]] bool in_canonical_order(const geometry::PartWithBvh& a,
                                      const geometry::PartWithBvh& b);

/// Round points to steps of 2^-16 grid units: a point in one part's coordinates then becomes one in
/// the other's without rounding.
[[nodiscard]] geometry::Vec3d on_witness_grid(const geometry::Vec3d& p);
void round_to_witness_grid(PartPairResult& answer);
void round_to_witness_grid(PairEvaluation& evaluation);

template <class Answer>
void round_to_witness_grid(std::optional<Answer>& answer) {
  if (answer) round_to_witness_grid(*answer);
}

/// Turn a result about (b, a) into one about (a, b).
void swap_sides(PartPairResult& answer, const PairOperand& a, const PairOperand& b);
void swap_sides(PairEvaluation& evaluation, const PairOperand& a, const PairOperand& b);

template <class Answer>
void swap_sides(std::optional<Answer>& answer, const PairOperand& a, const PairOperand& b) {
  if (answer) swap_sides(*answer, a, b);
}

/// Returns what evaluate(x, y) gives for two parts in canonical order, as a result about (a, b).
template <class Evaluate>
[[nodiscard]] auto evaluate_in_canonical_order(const PairOperand& a, const PairOperand& b,
                                               Evaluate&& evaluate) {
  const bool ordered = in_canonical_order(a.treed, b.treed);
  auto answer = ordered ? evaluate(a, b) : evaluate(b, a);
  round_to_witness_grid(answer);
  if (!ordered) swap_sides(answer, a, b);
  return answer;
}

}  // namespace strake::clash
