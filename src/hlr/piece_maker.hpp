// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hlr/asked_edge.hpp"
#include "hlr/occlusion.hpp"
#include "hlr/specks.hpp"
#include "hlr/stretches.hpp"
#include "hlr/world.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// Makes the pieces of one edge after another from what hides them. For one worker; it keeps its
/// memory from edge to edge.
class PieceMaker {
 public:
  PieceMaker(const World& world, const SpeckRule& rule) : world_(world), rule_(rule) {}

  /// Takes an edge in hand. True when what hides it between lo() and hi() is to be told; else all
  /// of it is clipped, or a point on paper.
  [[nodiscard]] bool begin(const AskedEdge& edge);
  [[nodiscard]] const Param& lo() const { return lo_; }
  [[nodiscard]] const Param& hi() const { return hi_; }

  /// What finish() did not append.
  struct Absent {
    bool left_out = false;   ///< hidden pieces
    std::size_t specks = 0;  ///< that other pieces took over
  };
  /// Appends the pieces of the edge in hand, which has this number within its object.
  Absent finish(std::uint32_t number, std::span<const Hit> hits, std::vector<Piece>& out);

 private:
  const World& world_;
  AskedEdge edge_;
  Param lo_ = Param::zero(), hi_ = Param::one();
  State whole_ = State::visible;  ///< or what all of the edge is
  std::vector<Stretch> stretches_;
  StretchMaker maker_;
  const SpeckRule& rule_;
};

}  // namespace strake::hlr
