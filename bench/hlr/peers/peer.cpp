// SPDX-License-Identifier: Apache-2.0
#include "hlr/peers/peer.hpp"

#include <fmt/core.h>

#include <fstream>

namespace strake::bench {
namespace {

std::vector<std::string> command_of(const Peer& peer, const Question& q, const std::string& lines) {
  const std::string scene = q.scene, scripts = STRAKE_PEER_SCRIPTS;
  const std::string toward = fmt::format("{},{},{}", q.direction.x, q.direction.y, q.direction.z);
  const std::string sharp = std::to_string(q.sharp_deg);
  if (peer.name == "occt")
    return {STRAKE_PEER_PROGRAMS "/peer_occt_poly", scene, toward, sharp, lines};
  if (peer.name == "tech_draw")
    return {"/usr/bin/python3", scripts + "/tech_draw.py", scene, toward, lines};
  std::string kinds = "contour,sharp";
  if (peer.draws.intersections != hlr::Intersections::off) kinds += ",intersection";
  return {"blender",
          "-b",
          "--factory-startup",
          "-t",
          std::to_string(q.threads),
          "-P",
          scripts + "/line_art.py",
          "--",
          scene,
          toward,
          sharp,
          lines,
          kinds};
}

std::vector<PeerLine> read_lines(const std::filesystem::path& path) {
  std::vector<PeerLine> lines;
  std::ifstream in(path);
  for (PeerLine l; in >> l.kind >> l.a.x >> l.a.y >> l.a.z >> l.b.x >> l.b.y >> l.b.z;)
    lines.push_back(l);
  return lines;
}

}  // namespace

const std::vector<Peer>& peers() {
  static const std::vector<Peer> all{
      // Contours come out among its smooth lines, which only the sharp ones are told from.
      {"occt", "OCCT PolyAlgo", {}, {"sharp"}},
      // An edge that is both is a contour to it.
      {"line_art_edges",
       "Blender Line Art, no intersections",
       {.hidden = false},
       {"sharp", "contour"}},
      {"line_art",
       "Blender Line Art",
       {.intersections = hlr::Intersections::objects, .hidden = false},
       {"sharp", "contour"}},
      // Every edge between two faces of a mesh is sharp to it.
      {"tech_draw",
       "FreeCAD TechDraw",
       {.smooth = hlr::Smooth::all},
       {"sharp", "contour", "smooth"}}};
  return all;
}

PeerAnswer run_peer(const Peer& peer, const Question& question) {
  const std::filesystem::path stem = question.scratch / peer.name;
  const std::string lines = stem.string() + ".lines";
  PeerAnswer answer{
      run_program(command_of(peer, question, lines), question.limit_s, stem.string() + ".log"), {}};
  if (answer.reply.outcome == cli::kMeasured) answer.lines = read_lines(lines);
  return answer;
}

}  // namespace strake::bench
