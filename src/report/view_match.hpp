// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "report/view_places.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/view_diff.hpp"

namespace strake::report {

/// A piece of either drawing with its class in the comparison.
struct ClassedPiece {
  const ViewPiece* piece = nullptr;
  LineClass cls;
  bool after = false;
};

/// Which pieces have a twin in the other drawing: of one class, between the same ends.
[[nodiscard]] std::vector<std::uint8_t> find_twins(std::span<const ClassedPiece> pieces);

/// What lies on each piece that has no twin; `of` is the piece.
struct CoverOf {
  std::uint32_t of = 0;
  Cover cover;
};

/// By piece. Errors: input where too many lines are at one place; cancelled.
[[nodiscard]] Result<std::vector<CoverOf>> find_covers(std::span<const ClassedPiece> pieces,
                                                       std::span<const std::uint8_t> has_twin,
                                                       double tolerance_mm,
                                                       const parallel::Context& context);

}  // namespace strake::report
