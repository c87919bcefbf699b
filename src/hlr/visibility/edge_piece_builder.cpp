// SPDX-License-Identifier: Apache-2.0
#include "hlr/visibility/edge_piece_builder.hpp"

namespace strake::hlr {

bool EdgePieceBuilder::begin(const EdgeQuery& edge) {
  edge_ = edge;
  lo_ = RationalParam::zero();
  hi_ = RationalParam::one();
  whole_ = State::visible;
  const bool limited = edge.own->cut || edge.other->cut;
  if (edge.cut_away || !edge.clip(visibility_.job.window, lo_, hi_) ||
      (limited && !edge.clip(*visibility_.job.limits, lo_, hi_)))
    whole_ = State::clipped;
  else if (edge.projecting)
    whole_ = State::projecting;
  return whole_ == State::visible;
}

EdgePieceBuilder::Outcome EdgePieceBuilder::finish(std::uint32_t number,
                                                   std::span<const OcclusionInterval> intervals,
                                                   std::vector<EdgePiece>& out) {
  intervals_.clear();
  if (whole_ != State::visible) {
    intervals_.push_back({RationalParam::zero(), RationalParam::one(), whole_});
  } else {
    if (lo_.num > 0) intervals_.push_back({RationalParam::zero(), lo_, State::clipped});
    if (intervals.empty())
      intervals_.push_back({lo_, hi_, State::visible});
    else
      sweep_.run(intervals, lo_, hi_, intervals_);
    if (hi_.num < hi_.den) intervals_.push_back({hi_, RationalParam::one(), State::clipped});
  }
  const geometry::Vec3l& origin = visibility_.job.origin;
  const std::size_t first = out.size();
  for (const VisibilityInterval& s : intervals_)
    out.push_back({model::ObjectId{edge_.own->object}, number, edge_.kind, s.state,
                   model::ObjectId{edge_.other->object}, edge_.at(s.lo, origin),
                   edge_.at(s.hi, origin)});
  const std::size_t specks = absorb_specks(rule_, first, out);
  const UnwantedPieces left_out = leave_out_unwanted(visibility_.job.options, first, out);
  // It is asked here, where the pieces are in the cache: of a drawing of millions they no longer
  // are.
  return {left_out, specks, has_visible_specks(rule_, first, out)};
}

}  // namespace strake::hlr
