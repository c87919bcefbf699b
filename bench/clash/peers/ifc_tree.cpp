// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fstream>
#include <string>

#include "peer_support/peer_program.hpp"
#include "peers/peer.hpp"

namespace strake::bench {

PeerAnswer ifc_tree_overlaps(const std::filesystem::path& scene, unsigned threads, double limit_s) {
  std::filesystem::path pairs = scene, log = scene;
  pairs.replace_extension(".ifc.pairs");
  log.replace_extension(".ifc.log");
  ProgramReply reply = run_program({"python3", STRAKE_CLASH_PEER_SCRIPTS "/ifc_tree.py",
                                    scene.string(), std::to_string(threads), pairs.string()},
                                   limit_s, log);
  PeerAnswer answer;
  answer.outcome = reply.outcome;
  answer.why = std::move(reply.why);
  if (answer.outcome == cli::kNotThere)
    answer.why += ": pip install ifcopenshell, in a virtual environment that comes first in PATH";
  answer.version = std::move(reply.version);
  answer.query_s = reply.cpu_s;
  answer.wall_s = reply.wall_s;
  answer.load_s = reply.load_s;
  if (answer.outcome != cli::kMeasured) return answer;
  std::ifstream in(pairs);
  for (geometry::IndexPair pair; in >> pair.first >> pair.second;) answer.pairs.push_back(pair);
  std::sort(answer.pairs.begin(), answer.pairs.end());
  return answer;
}

}  // namespace strake::bench
