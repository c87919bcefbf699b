// SPDX-License-Identifier: Apache-2.0
// Other programs at hidden lines: each runs for itself, on an OBJ file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "peer_support/peer_program.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::bench {

struct Seconds {
  double cpu = 0;  ///< of all threads
  double wall = 0;
};

/// Beside visible sharp edges and contours.
struct MoreLines {
  hlr::Intersections intersections = hlr::Intersections::off;
  hlr::Smooth smooth = hlr::Smooth::off;  ///< edges of curved faces
  bool hidden = true;                     ///< hidden lines of all kinds
  friend bool operator==(const MoreLines&, const MoreLines&) = default;
};

struct Peer {
  std::string_view name, title;
  MoreLines draws;  ///< what it draws whether one wants it or not, or what it can
  /// Kinds that are compared, together: not all peers distinguish them alike.
  std::vector<std::string_view> compared;
};

/// Those that there are.
[[nodiscard]] const std::vector<Peer>& peers();

struct Question {
  std::filesystem::path scene;  ///< OBJ, millimetres
  geometry::Vec3l direction;    ///< to the viewer
  double sharp_deg = 20;
  unsigned threads = 1;
  double limit_s = 0;             ///< patience
  std::filesystem::path scratch;  ///< folder for what the peer writes
};

/// A visible line: its kind ("sharp", "contour", "intersection") and two points of the model, mm,
/// that lie before, on or behind its ends.
struct PeerLine {
  std::string kind;
  geometry::Vec3d a, b;
};

struct PeerAnswer {
  ProgramReply reply;  ///< of hiding alone, the scene in memory
  std::vector<PeerLine> lines;
};

[[nodiscard]] PeerAnswer run_peer(const Peer& peer, const Question& question);

}  // namespace strake::bench
