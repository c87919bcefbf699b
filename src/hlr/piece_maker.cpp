// SPDX-License-Identifier: Apache-2.0
#include "hlr/piece_maker.hpp"

namespace strake::hlr {

bool PieceMaker::begin(const AskedEdge& edge) {
  edge_ = edge;
  lo_ = Param::zero();
  hi_ = Param::one();
  whole_ = State::visible;
  const bool limited = edge.own->cut || edge.other->cut;
  if (edge.cut_away || !edge.clip(world_.job.window, lo_, hi_) ||
      (limited && !edge.clip(*world_.job.limits, lo_, hi_)))
    whole_ = State::clipped;
  else if (edge.projecting)
    whole_ = State::projecting;
  return whole_ == State::visible;
}

PieceMaker::Absent PieceMaker::finish(std::uint32_t number, std::span<const Hit> hits,
                                      std::vector<Piece>& out) {
  stretches_.clear();
  if (whole_ != State::visible) {
    stretches_.push_back({Param::zero(), Param::one(), whole_});
  } else {
    if (lo_.num > 0) stretches_.push_back({Param::zero(), lo_, State::clipped});
    if (hits.empty())
      stretches_.push_back({lo_, hi_, State::visible});
    else
      maker_.run(hits, lo_, hi_, stretches_);
    if (hi_.num < hi_.den) stretches_.push_back({hi_, Param::one(), State::clipped});
  }
  const geometry::Vec3l& origin = world_.job.origin;
  const std::size_t first = out.size();
  for (const Stretch& s : stretches_)
    out.push_back({model::ObjectId{edge_.own->object}, number, edge_.kind, s.state,
                   model::ObjectId{edge_.other->object}, edge_.at(s.lo, origin),
                   edge_.at(s.hi, origin)});
  const std::size_t specks = absorb_specks(rule_, first, out);
  return {leave_out_unasked(world_.job.options, first, out), specks};
}

}  // namespace strake::hlr
