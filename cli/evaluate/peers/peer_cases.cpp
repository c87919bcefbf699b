// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/peers/peer_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "strake/generate/ship.hpp"

namespace strake::cli {

namespace {

// Drawings as large as bench_hidden_lines_peers has them by default: what hides lines by pairs of
// faces is not through with more in an hour.
constexpr std::array<PeerCase, 10> kPeers{{
    {"pairs-strake", "Strake, overlaps alone", PeerJob::pairs, "strake", 100'000},
    {"pairs-embree", "Embree", PeerJob::pairs, "embree", 100'000},
    {"pairs-fcl", "FCL", PeerJob::pairs, "fcl", 100'000},
    {"pairs-cgal", "CGAL", PeerJob::pairs, "cgal", 100'000},
    {"pairs-bullet", "Bullet", PeerJob::pairs, "bullet", 100'000},
    {"pairs-ifcopenshell", "IfcOpenShell", PeerJob::pairs, "ifcopenshell", 10'000},
    {"drawing-occt", "OCCT PolyAlgo", PeerJob::drawing, "occt", 3'000},
    {"drawing-line-art-edges", "Blender Line Art, no intersections", PeerJob::drawing,
     "line_art_edges", 10'000},
    {"drawing-line-art", "Blender Line Art", PeerJob::drawing, "line_art", 10'000},
    {"drawing-tech-draw", "FreeCAD TechDraw", PeerJob::drawing, "tech_draw", 1'000},
}};

}  // namespace

std::span<const PeerCase> peer_cases() { return kPeers; }

std::string_view peer_program(PeerJob job) {
  return job == PeerJob::pairs ? "bench_clash_peers" : "bench_hidden_lines_peers";
}

std::uint64_t peer_objects(const PeerCase& one, double scale) {
  constexpr double kMin = 500;
  const auto largest = static_cast<double>(generate::ShipOptions::kMaxObjects);
  return static_cast<std::uint64_t>(std::clamp(one.full_objects * scale, kMin, largest));
}

std::vector<std::string> peer_question(const PeerCase& one, double scale) {
  const std::uint64_t objects = peer_objects(one, scale);
  if (one.job == PeerJob::pairs) return {"meshes", std::to_string(objects), std::string(one.peer)};
  return {fmt::format("ship:{}", objects), "--peer", std::string(one.peer)};
}

}  // namespace strake::cli
