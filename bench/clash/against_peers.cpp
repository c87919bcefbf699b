// SPDX-License-Identifier: Apache-2.0
// bench_clash_peers [meshes|ship] [OBJECTS] [straight|turned] [--limit SECONDS] [--scenes FOLDER]
// [--json FILE] [PEER...]: a generated ship, as meshes or with its primitives, through Strake and
// through Embree, FCL, CGAL, Bullet and IfcOpenShell on the same triangles. Strake's classes must
// be those of the ship's truth, and every peer must have found what its question requests, before a
// time is printed: CPU seconds, medians of several runs, and the ratio to Strake's, which answers
// with class, distance or depth and witness in that time.
//
// --scenes keeps the triangles as OBJ and GLB; --json is for 'strake evaluate --peers'. The limit
// is that of peers which are programs of their own.
#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/evaluate/peers/peer_rows.hpp"
#include "clocks.hpp"
#include "peer_support/run_options.hpp"
#include "peer_support/work_folder.hpp"
#include "peers/known_pairs.hpp"
#include "peers/peer.hpp"
#include "peers/peer_scene.hpp"
#include "ship_truth.hpp"
#include "strake/clash/overlaps.hpp"
#include "strake/core/version.hpp"
#include "strake/parallel/team.hpp"

namespace {

using namespace strake;
using bench::FoundPairs;
using bench::KnownPairs;
using bench::PairQuestion;
using bench::PeerAnswer;
using bench::PeerObject;

constexpr int kRuns = 3;
/// Above this the slow peers run once.
constexpr double kLongRun_s = 20;

const clash::Options kOptions{.tolerances = {.clearance_mm = generate::Truth::kClearanceMm}};
constexpr double kPeerReach_mm = 20;

template <class Number>
Number median(std::vector<Number> all) {
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

/// The same question as the peers', of parts that stand on the grid already.
PeerAnswer strake_overlaps(const model::Scene& scene, const parallel::Context& context) {
  const clash::Sets sets = clash::one_set(scene);
  bench::Lap lap;
  bench::CpuLap cpu;
  const auto overlaps = clash::overlapping_pairs(scene, sets, kOptions, context).value();
  PeerAnswer answer;
  answer.version = fmt::format("Strake {}", version());
  answer.query_s = cpu();
  answer.wall_s = lap();
  for (const clash::ObjectPair& p : overlaps)
    answer.pairs.push_back({model::index(p.a), model::index(p.b)});
  return answer;
}

struct Peer {
  std::string name;
  unsigned threads = 1;
  PairQuestion question;
  std::function<PeerAnswer()> run;

  /// The first word, as the command line has it.
  [[nodiscard]] std::string key() const {
    std::string key = maker();
    std::ranges::transform(key, key.begin(), [](char c) {
      return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return key;
  }
  [[nodiscard]] std::string maker() const { return name.substr(0, name.find(' ')); }
};

/// What several runs of a peer took; the answer is that of the last.
struct Timed {
  PeerAnswer answer;
  std::vector<double> build, query, wall;

  [[nodiscard]] double cpu_s() const { return median(build) + median(query); }
};

/// Peers on one scene, beside Strake.
class Bench {
 public:
  Bench(const KnownPairs& known, cli::PeerRow ours, cli::PeerRowFile& file)
      : known_(known), ours_(std::move(ours)), file_(file) {}

  /// Asks a peer, and prints and keeps what became of it; false where its result is wrong.
  bool run(const Peer& peer) {
    Timed timed;
    for (int i = 0; i < kRuns; ++i) {
      timed.answer = peer.run();
      const PeerAnswer& answer = timed.answer;
      if (answer.outcome != cli::kMeasured) return without_answer(peer, answer);
      const FoundPairs found(answer.pairs, known_, peer.question);
      if (!found.right()) return wrong(peer, answer, found);
      timed.build.push_back(answer.build_s);
      timed.query.push_back(answer.query_s);
      timed.wall.push_back(answer.wall_s);
      if (answer.load_s + answer.wall_s > kLongRun_s) break;
    }
    return right(peer, timed);
  }

 private:
  [[nodiscard]] cli::PeerRow row_of(const Peer& peer, const PeerAnswer& answer) const {
    cli::PeerRow row = ours_;
    row.who = peer.maker();
    row.version = answer.version;
    row.threads = peer.threads;
    row.answers = peer.question.text;
    return row;
  }
  /// Keeps a row; false where that cannot be done.
  bool keep(cli::PeerRow row, std::string_view outcome, std::string result) {
    row.outcome = outcome;
    row.result = std::move(result);
    const Status status = file_.add(std::move(row));
    if (!status) fmt::print(stderr, "{}\n", status.error().text());
    return status.has_value();
  }

  bool right(const Peer& peer, const Timed& timed) {
    const FoundPairs found(timed.answer.pairs, known_, peer.question);
    fmt::print(
        "  {:<18}{:>8.2f} s build {:>8.2f} s query {:>8.2f} s wall  {:>6.2f} times Strake's CPU; "
        "{}\n",
        peer.name, median(timed.build), median(timed.query), median(timed.wall),
        timed.cpu_s() / ours_.ours_cpu_s, found.beside());
    std::fflush(stdout);
    cli::PeerRow row = row_of(peer, timed.answer);
    row.cpu_s = timed.cpu_s();
    row.wall_s = median(timed.wall);
    return keep(std::move(row), cli::kMeasured, found.text());
  }
  bool wrong(const Peer& peer, const PeerAnswer& answer, const FoundPairs& found) {
    fmt::print("  {:<18}ERROR: {}\n", peer.name, found.fault());
    (void)keep(row_of(peer, answer), cli::kDisagrees, found.fault());
    return false;
  }
  bool without_answer(const Peer& peer, const PeerAnswer& answer) {
    fmt::print("  {:<18}{}\n", peer.name, answer.why);
    return keep(row_of(peer, answer), answer.outcome, answer.why);
  }

  const KnownPairs& known_;
  cli::PeerRow ours_;
  cli::PeerRowFile& file_;
};

struct Wanted {
  bool meshes = true, turned = false;
  std::uint64_t objects = 10'000;
  std::vector<std::string_view> peers;
  bench::RunOptions run;

  [[nodiscard]] bool peer(std::string_view name) const {
    return peers.empty() || std::ranges::find(peers, name) != peers.end();
  }
  /// Whether the scene is to be a file: to be kept, or for a peer that reads one.
  [[nodiscard]] bool file_is_needed() const { return !run.scenes.empty() || peer("ifcopenshell"); }
  [[nodiscard]] std::string scene() const {
    return fmt::format("ship of {} objects{}{}", objects, turned ? ", turned" : "",
                       meshes ? "" : ", with primitives");
  }
  [[nodiscard]] std::string file() const {
    return fmt::format("pairs-{}{}", objects, turned ? "-turned" : "");
  }
};

/// Strake's own runs.
struct Ours {
  clash::Report report;
  double cpu_s = 0, wall_s = 0;
};

Ours strake_all(const model::Model& model, const parallel::Context& context) {
  std::vector<double> cpu_s, wall_s;
  Ours ours;
  for (int i = 0; i < kRuns; ++i) {
    bench::Lap lap;
    bench::CpuLap cpu;
    const auto scene = model::make_scene(model, clash::scene_options(kOptions), context).value();
    ours.report = clash::detect(scene, clash::one_set(scene), kOptions, context).value();
    cpu_s.push_back(cpu());
    wall_s.push_back(lap());
  }
  ours.cpu_s = median(cpu_s);
  ours.wall_s = median(wall_s);
  return ours;
}

void print(const Ours& ours) {
  const clash::Report& report = ours.report;
  fmt::print(
      "  {:<18}{:>8.2f} s CPU {:>29.2f} s wall; {} pairs: {} hits, {} contacts, {} nearer than {} "
      "mm; classes as in the truth\n",
      "Strake, all", ours.cpu_s, ours.wall_s, report.pairs.size(), report.count_hit,
      report.count_contact, report.count_clearance, kOptions.tolerances.clearance_mm);
  std::fflush(stdout);
}

/// What peers are asked about: the scene on Strake's grid, and its triangles.
struct Subject {
  const model::Scene& scene;
  const std::vector<PeerObject>& objects;
  std::filesystem::path file;  ///< OBJ; empty: not written
  double limit_s = 0;
};

std::vector<Peer> peers_of(const Subject& s, const parallel::Context& context) {
  const unsigned team = context.team->size();
  const PairQuestion overlap{"pairs that overlap"};
  // What it takes for touching is said where it is asked (peer.hpp).
  const PairQuestion loosely{"pairs that overlap, and pairs that may", false, 100};
  const PairQuestion near{fmt::format("pairs nearer than {} mm", kPeerReach_mm), true};
  std::vector<Peer> peers{
      {"Strake overlap", team, overlap, [&, s] { return strake_overlaps(s.scene, context); }},
      {"Embree overlap", team, overlap,
       [&, s] { return bench::embree_overlaps(s.objects, context); }},
      {"CGAL overlap", team, overlap, [&, s] { return bench::cgal_overlaps(s.objects, context); }},
      {"FCL overlap", 1, overlap, [s] { return bench::fcl_overlaps(s.objects); }},
      {"FCL to 20 mm", 1, near, [s] { return bench::fcl_within(s.objects, kPeerReach_mm); }},
      {"Bullet overlap", 1, loosely, [s] { return bench::bullet_overlaps(s.objects); }},
      {"IfcOpenShell", team, PairQuestion{"pairs of which one protrudes into the other"},
       [s, team] { return bench::ifc_tree_overlaps(s.file, team, s.limit_s); }}};
  return peers;
}

/// The row that all of a scene begin with.
cli::PeerRow row_of(const Wanted& wanted, const std::vector<PeerObject>& objects,
                    const Ours& ours) {
  cli::PeerRow row;
  row.scene = wanted.scene();
  row.objects = objects.size();
  for (const PeerObject& o : objects) row.triangles += o.triangles.size();
  row.ours_cpu_s = ours.cpu_s;
  row.ours_wall_s = ours.wall_s;
  return row;
}

/// Says that Strake itself is wrong.
void complain(cli::PeerRow row, std::size_t wrong, cli::PeerRowFile& file) {
  fmt::print("  Strake            ERROR: {} wrong pairs\n", wrong);
  row.who = "Strake";
  row.outcome = cli::kDisagrees;
  row.result = fmt::format("{} pairs are not those of the ship's truth", wrong);
  (void)file.add(std::move(row));
}

bool measure(const Wanted& wanted, const bench::WorkFolder& folder, cli::PeerRowFile& file) {
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team, .stop = {}};
  const auto ship = generate::generate_ship({wanted.objects, 1, wanted.turned}, context).value();
  const std::vector<PeerObject> objects = bench::peer_objects(
      model::make_scene(ship.model, clash::scene_options(kOptions), context).value());
  const model::Model meshes = bench::as_meshes(ship.model, objects);
  const model::Model& model = wanted.meshes ? meshes : ship.model;
  const Ours ours = strake_all(model, context);
  const cli::PeerRow row = row_of(wanted, objects, ours);
  fmt::print("{} objects{} as {}, {} triangles, {} threads\n", wanted.objects,
             wanted.turned ? ", turned," : "", wanted.meshes ? "meshes" : "a ship", row.triangles,
             team.size());
  if (const std::size_t wrong = bench::wrong_pairs(ours.report, ship.truth); wrong > 0)
    return complain(row, wrong, file), false;
  print(ours);
  const KnownPairs known = bench::known_from(ours.report, kPeerReach_mm);
  const auto scene = model::make_scene(model, clash::scene_options(kOptions), context).value();
  Result<std::filesystem::path> obj{std::filesystem::path()};
  if (wanted.file_is_needed()) obj = folder.write_scene(meshes, wanted.file(), context);
  if (!obj) return fmt::print(stderr, "{}\n", obj.error().text()), false;
  Bench bench(known, row, file);
  bool right = true;
  for (const Peer& peer : peers_of({scene, objects, *obj, wanted.run.limit_s}, context))
    if (wanted.peer(peer.key())) right = bench.run(peer) && right;
  return right;
}

}  // namespace

int main(int argc, char** argv) {
  Wanted wanted;
  bool both = true;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (i + 1 < argc && wanted.run.take(word, argv[i + 1]))
      ++i;
    else if (word == "meshes" || word == "ship")
      wanted.meshes = word == "meshes";
    else if (word == "straight" || word == "turned")
      both = false, wanted.turned = word == "turned";
    else if (const auto n = std::strtoull(argv[i], nullptr, 10); n > 0)
      wanted.objects = n;
    else
      wanted.peers.push_back(word);
  }
  const bench::WorkFolder folder(wanted.run.scenes, "clash_peers");
  cli::PeerRowFile file(wanted.run.json);
  bool right = true;
  for (const bool turned : {false, true}) {
    if (!both && turned != wanted.turned) continue;
    Wanted each = wanted;
    each.turned = turned;
    right = measure(each, folder, file) && right;
  }
  return right ? 0 : 1;
}
