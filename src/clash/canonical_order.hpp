// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "clash/narrow_part.hpp"

namespace strake::clash {

/// An order of parts by what they are and where they stand relative to each other, so that the
/// pair is worked on the same way round whichever is called a.
[[nodiscard]] bool in_canonical_order(const geometry::TreedPart& a, const geometry::TreedPart& b);

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
  if (in_canonical_order(a.treed, b.treed)) return judge(a, b);
  auto answer = judge(b, a);
  turn(answer, a, b);
  return answer;
}

}  // namespace strake::clash
