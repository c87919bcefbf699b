// SPDX-License-Identifier: Apache-2.0
#include "hlr/peers/peer.hpp"

#include <fmt/core.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "hlr/peers/process.hpp"

namespace strake::bench {
namespace {

/// What a script exits with where its program is not installed.
constexpr int kNotInstalled = 77;
constexpr std::string_view kMark = "RESULT ";

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

/// What the line with the result says.
std::optional<PeerAnswer> answer_in(std::string_view output) {
  const std::size_t begin = output.find(kMark);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::string_view line = output.substr(begin + kMark.size());
  const auto json = nlohmann::json::parse(line.substr(0, line.find('\n')), nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  PeerAnswer answer;
  answer.version = json.at("version");
  answer.hide = {json.at("hide_cpu_s"), json.at("hide_s")};
  answer.load_s = json.at("load_s");
  return answer;
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

Result<PeerAnswer> ask(const Peer& peer, const Question& question) {
  const std::filesystem::path stem = question.scratch / peer.name;
  const std::string lines = stem.string() + ".lines";
  const Ended ended =
      run_to_end(command_of(peer, question, lines), question.limit_s, stem.string() + ".log");
  const auto fault = [](std::string message) {
    return Error{ErrorCode::input, std::move(message), {}, {}};
  };
  if (ended.how == Ended::How::not_found ||
      (ended.how == Ended::How::exited && ended.code == kNotInstalled))
    return fault("not installed");
  if (ended.how == Ended::How::over_limit)
    return fault(fmt::format("gave up after {} s", question.limit_s));
  auto answer = answer_in(ended.output);
  if (ended.how == Ended::How::exited && ended.code == 0 && answer) {
    answer->lines = read_lines(lines);
    return std::move(*answer);
  }
  constexpr std::size_t kTail = 300;
  const std::size_t size = ended.output.size();
  return fault("failed: " + ended.output.substr(size > kTail ? size - kTail : 0));
}

}  // namespace strake::bench
