// SPDX-License-Identifier: Apache-2.0
// bench_hidden_lines_peers [SCENE[@X,Y,Z]]... [--limit SECONDS] [--rays N] [--scenes FOLDER]
// [--json FILE] [--peer occt|line_art|line_art_edges|tech_draw|none]...: the hidden lines of one
// view through Strake, and through OCCT's PolyAlgo, Blender's Line Art and FreeCAD's TechDraw on
// the same triangles out of the same OBJ file. A scene is ship:OBJECTS, boxes:SIDE, pipes:SIDE or
// an OBJ file; X,Y,Z points to the viewer. Without a scene those that each peer can finish, with
// the ratios that are requested.
//
// Seconds are of hiding alone: every program has the scene in memory before. Strake's are medians
// of several runs, with the kinds of lines that the peer has; peers run once. Before a time counts
// exact rays through Strake's pieces must find none wrong, and the peer's lines must lie where
// Strake's do, but for a share of their length that is stated with each (Asked).
//
// --scenes keeps the scenes as OBJ and GLB; --json is for 'strake evaluate --peers'.
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/evaluate/peers/peer_rows.hpp"
#include "clocks.hpp"
#include "hlr/line_coverage.hpp"
#include "hlr/peers/peer.hpp"
#include "hlr/synthetic_scenes.hpp"
#include "hlr/view/projection.hpp"
#include "peer_support/run_options.hpp"
#include "peer_support/work_folder.hpp"
#include "strake/generate/ship.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"
#include "support/ray_check.hpp"

namespace {

using namespace strake;
using bench::Peer;
using bench::PeerAnswer;
using bench::Seconds;
using geometry::Vec3d;
using geometry::Vec3l;
namespace fs = std::filesystem;

constexpr int kRuns = 5;
constexpr unsigned kThreads = 2;
constexpr double kSharp_deg = 20;

/// How many times a peer should need what Strake needs; 0: not requested.
struct PeerTarget {
  std::string_view peer;
  double cpu = 0, wall = 0;
  /// How much of the lines on paper may be missing, or too many.
  double tolerance_percent = 5;
};

struct Subject {
  std::string scene;
  /// Not an isometric one, in which whole families of edges lie on each other on paper.
  Vec3l direction{5, -7, 4};
  std::vector<PeerTarget> target{
      {"occt"}, {"line_art_edges"}, {"line_art"}, {"tech_draw", 0, 0, 10}};
};

std::vector<Subject> usual_subjects() {
  return {
      {"ship:1000", {5, -7, 4}, {{"tech_draw", 0, 500, 10}}},
      {"ship:3000", {5, -7, 4}, {{"occt", 60, 100}}},
      {"ship:10000", {5, -7, 4}, {{"line_art", 0, 50}, {"line_art_edges"}}},
      {"boxes:20", {0, 0, 1}, {{"occt", 0, 50}, {"line_art_edges", 0, 50}, {"line_art", 0, 50}}},
      {"pipes:24", {1, 0, 0}, {{"occt", 0, 50}, {"line_art_edges", 0, 50}, {"line_art", 0, 50}}}};
}

struct Arguments {
  std::vector<Subject> subjects;
  std::vector<std::string> peers;  ///< empty: all
  std::uint64_t rays = 2000;
  bench::RunOptions run;

  [[nodiscard]] bool wants(std::string_view peer) const {
    return peers.empty() || std::ranges::find(peers, peer) != peers.end();
  }
};

Subject subject_of(const std::string& word) {
  Subject s;
  const std::size_t at = word.find('@');
  s.scene = word.substr(0, at);
  if (at != std::string::npos)
    std::sscanf(word.c_str() + at + 1, "%ld,%ld,%ld", &s.direction.x, &s.direction.y,
                &s.direction.z);
  return s;
}

std::optional<Arguments> parse(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    const auto value = [&] { return i + 1 < argc ? argv[++i] : "0"; };
    if (i + 1 < argc && a.run.take(key, argv[i + 1]))
      ++i;
    else if (key == "--peer")
      a.peers.emplace_back(value());
    else if (key == "--rays")
      a.rays = std::strtoull(value(), nullptr, 10);
    else
      a.subjects.push_back(subject_of(key));
  }
  for (const std::string& name : a.peers)
    if (name != "none" &&
        std::ranges::find(bench::peers(), name, &Peer::name) == bench::peers().end())
      return fmt::print(stderr, "there is no peer '{}'\n", name), std::nullopt;
  if (a.subjects.empty()) a.subjects = usual_subjects();
  return a;
}

/// The OBJ file of a scene: made in the folder, or what the word names.
Result<fs::path> file_of(const std::string& scene, const bench::WorkFolder& folder,
                         const parallel::Context& context) {
  const std::size_t colon = scene.find(':');
  if (colon == std::string::npos) return fs::path(scene);
  const std::string kind = scene.substr(0, colon);
  const auto number =
      static_cast<std::uint32_t>(std::strtoul(scene.c_str() + colon + 1, nullptr, 10));
  constexpr std::uint32_t kLayers = 50, kLengths = 2;
  model::Model model;
  if (kind == "ship") {
    auto ship = generate::generate_ship({number, 1, false}, context);
    if (!ship) return ship.error();
    model = std::move(ship->model);
  } else if (kind == "boxes") {
    model = bench::stacked_boxes(number, kLayers);
  } else if (kind == "pipes") {
    model = bench::pipe_bundle(number, kLengths);
  } else {
    return Error{ErrorCode::usage, "no such scene", scene, "ship:N, boxes:N, pipes:N or a file"};
  }
  return folder.write_scene(model, fmt::format("drawing-{}-{}", kind, number), context);
}

template <class Number>
Number median(std::vector<Number> all) {
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

std::string_view common_kind(hlr::EdgeKind kind) {
  switch (kind) {
    case hlr::EdgeKind::contour:
      return "contour";
    case hlr::EdgeKind::intersection:
      return "intersection";
    case hlr::EdgeKind::smooth:
      return "smooth";
    default:
      return "sharp";
  }
}

struct PaperLine {
  std::string_view kind;
  drawing::PlaneSegment at;  ///< mm
};

/// The paper of a view.
class Paper {
 public:
  explicit Paper(const Vec3l& direction)
      : axes_(hlr::axes_of({.direction = direction, .limits = {}})) {}

  [[nodiscard]] std::vector<PaperLine> visible(const hlr::Drawing& drawing) const {
    std::vector<PaperLine> lines;
    for (const hlr::EdgePiece& p : drawing.pieces)
      if (p.state == hlr::State::visible)
        lines.push_back({common_kind(p.kind), flat(geometry::to_mm(p.a), geometry::to_mm(p.b))});
    return lines;
  }
  /// The kinds are the answer's own text.
  [[nodiscard]] std::vector<PaperLine> visible(const PeerAnswer& answer) const {
    std::vector<PaperLine> lines;
    for (const bench::PeerLine& l : answer.lines) lines.push_back({l.kind, flat(l.a, l.b)});
    return lines;
  }

 private:
  [[nodiscard]] drawing::PlaneSegment flat(const Vec3d& a, const Vec3d& b) const {
    return {.ax = dot(a, axes_.right),
            .ay = dot(a, axes_.up),
            .bx = dot(b, axes_.right),
            .by = dot(b, axes_.up)};
  }
  hlr::ViewAxes axes_;
};

std::vector<drawing::PlaneSegment> of_kinds(const std::vector<PaperLine>& lines,
                                            const std::vector<std::string_view>& kinds) {
  std::vector<drawing::PlaneSegment> some;
  for (const PaperLine& l : lines)
    if (std::ranges::find(kinds, l.kind) != kinds.end()) some.push_back(l.at);
  return some;
}

/// "contour 470.3, sharp 405.8 m".
std::string lengths_of(const std::vector<PaperLine>& lines) {
  std::map<std::string_view, double> sum;
  for (const PaperLine& l : lines) sum[l.kind] += l.at.length();
  std::string text;
  for (const auto& [kind, mm] : sum)
    text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", kind, mm / 1000);
  return text + " m";
}

struct Ours {
  Seconds one, team;  ///< on one thread, and on kThreads
  hlr::Counters counters;
  std::size_t pieces = 0;
  std::vector<PaperLine> visible;
  test::RayCheck check;

  /// An exact ray found a wrong piece, or none could be asked.
  [[nodiscard]] bool is_wrong() const { return check.wrong > 0 || check.rays == 0; }
  [[nodiscard]] double ns_per_face_test() const {
    return one.cpu * 1e9 / static_cast<double>(std::max<std::uint64_t>(1, counters.face_tests));
  }
};

/// A scene in memory, drawn by Strake.
class Drawn {
 public:
  Drawn(const model::Scene& scene, const Vec3l& direction, std::uint64_t rays)
      : scene_(scene), direction_(direction), rays_(rays) {}

  [[nodiscard]] Result<Ours> ours(const bench::MoreLines& with) const {
    Ours ours;
    const hlr::View view{.direction = direction_, .limits = {}};
    const hlr::Options options{.sharp_angle_deg = kSharp_deg,
                               .smooth = with.smooth,
                               .intersections = with.intersections,
                               .hidden = with.hidden};
    for (const unsigned threads : {1U, kThreads}) {
      parallel::Team team(threads);
      const parallel::Context context{.team = threads > 1 ? &team : nullptr, .stop = {}};
      std::vector<double> cpu_s, wall_s;
      for (int i = 0; i < kRuns; ++i) {
        bench::Lap lap;
        bench::CpuLap cpu;
        const auto drawing = hlr::draw(scene_, {}, view, options, context);
        cpu_s.push_back(cpu());
        wall_s.push_back(lap());
        if (!drawing) return drawing.error();
        if (i > 0 || threads > 1) continue;
        ours.counters = drawing->counters;
        ours.pieces = drawing->pieces.size();
        ours.visible = Paper(direction_).visible(*drawing);
        ours.check = test::check_by_rays(scene_, *drawing, rays_, 1);
      }
      Seconds& seconds = threads > 1 ? ours.team : ours.one;
      seconds = {median(cpu_s), median(wall_s)};
    }
    return ours;
  }

 private:
  const model::Scene& scene_;
  Vec3l direction_;
  std::uint64_t rays_;
};

void print(const Ours& ours, const bench::MoreLines& with) {
  std::string more;
  if (with.intersections != hlr::Intersections::off) more += ", intersections too";
  if (with.smooth != hlr::Smooth::off) more += ", smooth too";
  if (!with.hidden) more += ", visible only";
  if (ours.is_wrong()) {
    fmt::print("  Strake{:<35}ERROR: {} of {} rays wrong: {}\n", more, ours.check.wrong,
               ours.check.rays, ours.check.first_wrong);
    return;
  }
  fmt::print(
      "  Strake{:<35}{:>9.3f} s CPU {:>9.3f} s wall on 1 thread, {:.3f} s CPU {:.3f} s wall on {}\n"
      "    {} edges, {} pieces, {} face tests of {:.0f} ns; visible: {}; {} of {} rays wrong\n",
      more, ours.one.cpu, ours.one.wall, ours.team.cpu, ours.team.wall, kThreads,
      ours.counters.feature_edges, ours.pieces, ours.counters.face_tests, ours.ns_per_face_test(),
      lengths_of(ours.visible), ours.check.wrong, ours.check.rays);
  std::fflush(stdout);
}

std::string target_text(double times) {
  return times > 0 ? fmt::format(" (asked: {})", times) : std::string();
}

/// A peer's lines beside Strake's.
struct Compared {
  const Peer& peer;
  const PeerTarget& target;
  const Ours& ours;
  const PeerAnswer& theirs;
  bench::Common common;

  [[nodiscard]] double percent() const { return 100 / common.ours; }
  [[nodiscard]] bool same() const {
    return std::max(common.missing, common.extra) * percent() <= target.tolerance_percent;
  }
  [[nodiscard]] std::string text() const {
    return fmt::format(
        "of the kinds in common, each place once, {:.1f} m for {:.1f} m: {:.2f} % are missing, "
        "{:.2f} % too many",
        common.theirs / 1000, common.ours / 1000, common.missing * percent(),
        common.extra * percent());
  }
  /// Returns how much may be, where it is more.
  [[nodiscard]] std::string known() const {
    return fmt::format(", {} % are known", target.tolerance_percent);
  }
  void print(const std::vector<PaperLine>& visible) const {
    const bench::ProgramReply& r = theirs.reply;
    fmt::print(
        "  {:<41}{:>9.2f} s CPU {:>9.2f} s wall; {}, loaded in {:.1f} s\n"
        "    {} lines, visible: {}; {}{}\n",
        peer.title, r.cpu_s, r.wall_s, r.version, r.load_s, visible.size(), lengths_of(visible),
        text(), same() ? "" : ": ERROR" + known());
    if (same())
      fmt::print("    times Strake's: {:.0f} CPU{}, {:.0f} wall{}\n", r.cpu_s / ours.one.cpu,
                 target_text(target.cpu), r.wall_s / ours.team.wall, target_text(target.wall));
  }
};

/// "ship:1000" as a reader has it.
std::string title_of(const std::string& scene) {
  const std::size_t colon = scene.find(':');
  if (colon == std::string::npos) return fs::path(scene).filename().string();
  return fmt::format("{} of {}{}", scene.substr(0, colon), scene.substr(colon + 1),
                     scene.starts_with("ship:") ? " objects" : " a side");
}

/// What a peer draws, beside visible sharp edges and contours.
std::string answers_of(const Peer& peer) {
  std::string text = peer.draws.hidden ? "visible and hidden lines" : "visible lines";
  if (peer.draws.intersections != hlr::Intersections::off) text += ", intersections";
  if (peer.draws.smooth != hlr::Smooth::off) text += ", smooth edges";
  return text;
}

/// One scene beside its peers.
class Bench {
 public:
  Bench(const model::Scene& scene, fs::path file, const Subject& subject,
        const Arguments& arguments, const bench::WorkFolder& folder, cli::PeerRowFile& rows,
        const parallel::Context& context)
      : subject_(subject),
        arguments_(arguments),
        folder_(folder),
        rows_(rows),
        context_(context),
        file_(std::move(file)),
        drawn_(scene, subject.direction, arguments.rays),
        paper_(subject.direction) {
    scene_row_.scene = title_of(subject.scene);
    scene_row_.objects = scene.model->objects.size();
    for (const model::GridBody& body : scene.bodies)
      for (const geometry::Part& part : scene.shapes[body.grid_shape].parts)
        scene_row_.triangles += part.triangles.size();
  }

  bool run() {
    const Vec3l& d = subject_.direction;
    fmt::print("{}: {} objects, {} triangles, seen from {},{},{}\n", subject_.scene,
               scene_row_.objects, scene_row_.triangles, d.x, d.y, d.z);
    const Result<Ours> plain = ours({});
    if (!plain) return complain(plain.error());
    if (plain->is_wrong()) return false;
    bool right = true;
    for (const Peer& peer : bench::peers()) {
      const auto target = std::ranges::find(subject_.target, peer.name, &PeerTarget::peer);
      if (target == subject_.target.end() || !arguments_.wants(peer.name)) continue;
      const Result<Ours> same = peer.draws == bench::MoreLines{} ? plain : ours(peer.draws);
      if (!same) return complain(same.error());
      if (same->is_wrong()) return false;
      right = run_peer(peer, *target, *same) && right;
      std::fflush(stdout);
    }
    return right;
  }

 private:
  static bool complain(const Error& error) {
    return fmt::print(stderr, "{}\n", error.text()), false;
  }
  bool keep(cli::PeerRow row, std::string_view outcome, std::string result) {
    row.outcome = outcome;
    row.result = std::move(result);
    const Status status = rows_.add(std::move(row));
    return status || complain(status.error());
  }

  /// Strake's drawing with the same kinds of lines, printed.
  Result<Ours> ours(const bench::MoreLines& with) {
    Result<Ours> ours = drawn_.ours(with);
    if (!ours) return ours;
    print(*ours, with);
    if (!ours->is_wrong()) return ours;
    cli::PeerRow row = scene_row_;
    row.who = "Strake";
    (void)keep(row, cli::kDisagrees,
               fmt::format("{} of {} rays wrong: {}", ours->check.wrong, ours->check.rays,
                           ours->check.first_wrong));
    return ours;
  }

  /// Asks a peer, and prints and keeps what became of it; false where its lines are not Strake's.
  bool run_peer(const Peer& peer, const PeerTarget& target, const Ours& ours) {
    const PeerAnswer answer = bench::run_peer(
        peer,
        {file_, subject_.direction, kSharp_deg, kThreads, arguments_.run.limit_s, folder_.path()});
    const cli::PeerRow row = row_of(peer, answer, ours);
    if (answer.reply.outcome != cli::kMeasured) return without_answer(row, answer.reply);
    const std::vector<PaperLine> visible = paper_.visible(answer);
    const Compared compared{peer, target, ours, answer,
                            bench::compare(of_kinds(ours.visible, peer.compared),
                                           of_kinds(visible, peer.compared), context_)};
    compared.print(visible);
    return record_comparison(row, compared);
  }

  [[nodiscard]] cli::PeerRow row_of(const Peer& peer, const PeerAnswer& answer,
                                    const Ours& ours) const {
    cli::PeerRow row = scene_row_;
    row.who = peer.title;
    row.version = answer.reply.version;
    row.answers = answers_of(peer);
    row.threads = peer.name.starts_with("line_art") ? kThreads : 1;
    row.ours_cpu_s = ours.one.cpu;
    row.ours_wall_s = ours.team.wall;
    return row;
  }
  bool without_answer(const cli::PeerRow& row, const bench::ProgramReply& reply) {
    fmt::print("  {:<41}{}\n", row.who, reply.why);
    const bool absent = reply.outcome == cli::kNotThere;
    return keep(
        row, reply.outcome,
        reply.why + (absent ? ": './run bench --build hidden_lines_peers' installs it" : ""));
  }
  /// A time counts where the lines are the same, but for what is stated.
  bool record_comparison(cli::PeerRow row, const Compared& compared) {
    if (!compared.same()) {
      (void)keep(std::move(row), cli::kDisagrees, compared.text() + compared.known());
      return false;
    }
    row.cpu_s = compared.theirs.reply.cpu_s;
    row.wall_s = compared.theirs.reply.wall_s;
    return keep(std::move(row), cli::kMeasured, compared.text());
  }

  const Subject& subject_;
  const Arguments& arguments_;
  const bench::WorkFolder& folder_;
  cli::PeerRowFile& rows_;
  const parallel::Context& context_;
  fs::path file_;
  Drawn drawn_;
  Paper paper_;
  cli::PeerRow scene_row_;  ///< that all of the scene begin with
};

bool run(const Subject& subject, const Arguments& a, const bench::WorkFolder& folder,
         cli::PeerRowFile& rows) {
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team, .stop = {}};
  const auto complain = [](const Error& e) { return fmt::print(stderr, "{}\n", e.text()), false; };
  const auto file = file_of(subject.scene, folder, context);
  if (!file) return complain(file.error());
  const auto model = io::read_models(std::vector<fs::path>{*file}, {}, context);
  if (!model) return complain(model.error());
  const auto scene = model::make_scene(*model, {}, context);
  if (!scene) return complain(scene.error());
  return Bench(*scene, *file, subject, a, folder, rows, context).run();
}

}  // namespace

int main(int argc, char** argv) {
  const std::optional<Arguments> arguments = parse(argc, argv);
  if (!arguments) return 2;
  const bench::WorkFolder folder(arguments->run.scenes, "hidden_lines_peers");
  cli::PeerRowFile rows(arguments->run.json);
  bool right = true;
  for (const Subject& subject : arguments->subjects)
    right = run(subject, *arguments, folder, rows) && right;
  return right ? 0 : 1;
}
