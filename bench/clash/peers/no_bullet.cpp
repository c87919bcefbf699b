// SPDX-License-Identifier: Apache-2.0
// Where Bullet is not installed.
#include "peers/peer.hpp"

namespace strake::bench {

PeerAnswer bullet_overlaps(std::span<const PeerObject> /*objects*/) {
  PeerAnswer answer;
  answer.outcome = cli::kNotThere;
  answer.why = "not installed: install libbullet-dev and build again";
  return answer;
}

}  // namespace strake::bench
