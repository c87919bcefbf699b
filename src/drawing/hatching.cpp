// SPDX-License-Identifier: Apache-2.0
#include "strake/drawing/hatching.hpp"

namespace strake::drawing {

void Hatching::add(const hlr::Hatch& hatch, const std::vector<bool>& picked) {
  hatches_.resize(objects_);
  known_.resize(objects_, false);
  for (std::size_t o = 0; o < objects_; ++o) {
    if (known_[o] || (!picked.empty() && !picked[o])) continue;
    known_[o] = true;
    hatches_[o] = hatch;
  }
}

}  // namespace strake::drawing
