// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "clash/narrow_part.hpp"

namespace strake::clash {

/// An order of parts by what they are and where they stand relative to each other, so that the
/// pair is worked on the same way round whichever is called a.
[[nodiscard]] bool in_canonical_order(const geometry::TreedPart& a, const geometry::TreedPart& b);

/// Points in steps of 2^-16 grid units: those of one part's coordinates become the other's without
/// rounding.
[[nodiscard]] geometry::Vec3d in_witness_steps(const geometry::Vec3d& p);
void put_in_steps(PartAnswer& answer);
void put_in_steps(FirstLook& look);

template <class Answer>
void put_in_steps(std::optional<Answer>& answer) {
  if (answer) put_in_steps(*answer);
}

/// An answer about (b, a) becomes one about (a, b).
void turn(PartAnswer& answer, const NarrowPart& a, const NarrowPart& b);
void turn(FirstLook& look, const NarrowPart& a, const NarrowPart& b);

template <class Answer>
void turn(std::optional<Answer>& answer, const NarrowPart& a, const NarrowPart& b) {
  if (answer) turn(*answer, a, b);
}

/// What judge(x, y) says of two parts in canonical order, as an answer about (a, b).
template <class Judge>
[[nodiscard]] auto in_order(const NarrowPart& a, const NarrowPart& b, Judge&& judge) {
  const bool ordered = in_canonical_order(a.treed, b.treed);
  auto answer = ordered ? judge(a, b) : judge(b, a);
  put_in_steps(answer);
  if (!ordered) turn(answer, a, b);
  return answer;
}

}  // namespace strake::clash
