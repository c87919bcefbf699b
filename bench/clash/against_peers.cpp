// SPDX-License-Identifier: Apache-2.0
// bench_clash_peers [meshes|ship] [OBJECTS] [straight|turned] [PEER...]: a generated ship, as
// meshes or with its primitives, through Strake and through Embree, FCL and CGAL on the same
// triangles. Strake's classes must be those of the ship's truth, and every peer must have found
// what its question asks for, before a time is printed: CPU seconds, medians of several runs, and
// the ratio to Strake's, which answers with class, distance or depth and witness in that time.
#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clocks.hpp"
#include "peers/peer.hpp"
#include "ship_truth.hpp"
#include "strake/clash/overlaps.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/team.hpp"

namespace {

using namespace strake;
using bench::PeerAnswer;
using bench::PeerObject;
using clash::Class;

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

/// The triangles of the scene, as every object's own.
std::vector<PeerObject> peer_objects(const model::Scene& scene) {
  std::vector<PeerObject> objects(scene.model->objects.size());
  for (const model::GridBody& body : scene.bodies) {
    PeerObject& o = objects[model::index(body.object)];
    for (const geometry::Part& part : scene.shapes[body.grid_shape].parts) {
      const auto base = static_cast<std::uint32_t>(o.points.size());
      if (part.kind == geometry::PartKind::wire) continue;
      for (const geometry::Vec3i& v : part.vertices) {
        o.points.push_back(to_mm(body.origin + v.as<std::int64_t>()));
        o.box.include(o.points.back());
      }
      for (const geometry::Triangle& t : part.triangles)
        o.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    }
  }
  return objects;
}

/// The same objects as a file of plain meshes would hold them: nothing shared, no primitives.
model::Model as_meshes(const model::Model& from, const std::vector<PeerObject>& objects) {
  model::Model meshes;
  meshes.files = from.files;
  meshes.objects = from.objects;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    model::Object& o = meshes.objects[i];
    o.first_body = static_cast<std::uint32_t>(meshes.bodies.size());
    o.body_count = 1;
    model::Body body;
    body.shape = model::ShapeId{static_cast<std::uint32_t>(meshes.shapes.size())};
    // About the object's own corner, as a placement in a file would have it.
    const geometry::Vec3d corner =
        objects[i].triangles.empty() ? geometry::Vec3d{} : objects[i].box.lo;
    body.placement.translation = corner;
    geometry::TriangleMesh mesh;
    for (const geometry::Vec3d& p : objects[i].points) mesh.vertices.push_back(p - corner);
    mesh.triangles = objects[i].triangles;
    meshes.shapes.emplace_back(std::move(mesh));
    meshes.bodies.push_back(body);
  }
  return meshes;
}

/// What is known of the pairs: Strake's report, once the truth has confirmed it.
struct Known {
  std::set<geometry::IndexPair> crossing;  ///< surfaces cross, deeper than rounding could hide
  std::set<geometry::IndexPair> touching;  ///< at about 0
  std::set<geometry::IndexPair> nested;    ///< one wholly inside the other
  std::set<geometry::IndexPair> near;      ///< apart by less than kPeerReach_mm, but for rounding
};

Known known_from(const clash::Report& report) {
  constexpr double kRounding_mm = 0.01;
  Known known;
  for (const clash::Pair& p : report.pairs) {
    const geometry::IndexPair pair{model::index(p.a), model::index(p.b)};
    const bool nested =
        p.relation == clash::Relation::a_in_b || p.relation == clash::Relation::b_in_a;
    if (nested)
      known.nested.insert(pair);
    else if (p.relation == clash::Relation::interfere && p.d_mm < -kRounding_mm)
      known.crossing.insert(pair);
    else if (p.d_mm <= kRounding_mm)
      known.touching.insert(pair);
    else if (p.d_mm < kPeerReach_mm - kRounding_mm)
      known.near.insert(pair);
  }
  return known;
}

std::size_t count_in(const std::vector<geometry::IndexPair>& found,
                     const std::set<geometry::IndexPair>& known) {
  return static_cast<std::size_t>(
      std::count_if(found.begin(), found.end(), [&](const auto& p) { return known.contains(p); }));
}

/// The same question as the peers', of parts that stand on the grid already.
PeerAnswer strake_overlaps(const model::Scene& scene, const parallel::Context& context) {
  const clash::Sets sets = clash::one_set(scene);
  bench::Lap lap;
  bench::CpuLap cpu;
  const auto overlaps = clash::overlapping_pairs(scene, sets, kOptions, context).value();
  PeerAnswer answer;
  answer.query_s = cpu();
  answer.wall_s = lap();
  for (const clash::ObjectPair& p : overlaps)
    answer.pairs.push_back({model::index(p.a), model::index(p.b)});
  return answer;
}

struct Peer {
  std::string name;
  bool distances = false;
  std::function<PeerAnswer()> ask;
};

struct Bench {
  const Known& known;
  double strake_cpu_s = 0, strake_wall_s = 0;

  [[nodiscard]] bool right(const Peer& peer, const PeerAnswer& answer) const {
    const std::size_t crossing = count_in(answer.pairs, known.crossing);
    const std::size_t near = count_in(answer.pairs, known.near);
    return crossing == known.crossing.size() && (!peer.distances || near == known.near.size());
  }

  bool run(const Peer& peer) const {
    std::vector<double> build, query, wall;
    PeerAnswer answer;
    for (int i = 0; i < kRuns; ++i) {
      answer = peer.ask();
      if (!right(peer, answer)) {
        fmt::print("  {:<18}ERROR: {} of {} crossing pairs, {} of {} near ones\n", peer.name,
                   count_in(answer.pairs, known.crossing), known.crossing.size(),
                   count_in(answer.pairs, known.near), known.near.size());
        return false;
      }
      build.push_back(answer.build_s);
      query.push_back(answer.query_s);
      wall.push_back(answer.wall_s);
      if (answer.wall_s > kLongRun_s) break;
    }
    const double cpu = median(build) + median(query);
    fmt::print(
        "  {:<18}{:>8.2f} s build {:>8.2f} s query {:>8.2f} s wall  {:>6.2f} times Strake's CPU; "
        "{} of {} touches called overlaps, {} of {} nested found\n",
        peer.name, median(build), median(query), median(wall), cpu / strake_cpu_s,
        count_in(answer.pairs, known.touching), known.touching.size(),
        count_in(answer.pairs, known.nested), known.nested.size());
    std::fflush(stdout);
    return true;
  }
};

struct Wanted {
  bool meshes = true, turned = false;
  std::uint64_t objects = 10'000;
  std::vector<std::string_view> peers;

  [[nodiscard]] bool peer(std::string_view name) const {
    return peers.empty() || std::ranges::find(peers, name) != peers.end();
  }
};

bool measure(const Wanted& wanted) {
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team, .stop = {}};
  const auto ship = generate::generate_ship({wanted.objects, 1, wanted.turned}, context).value();
  std::vector<PeerObject> objects;
  {
    const auto scene =
        model::make_scene(ship.model, clash::scene_options(kOptions), context).value();
    objects = peer_objects(scene);
  }
  const model::Model model = wanted.meshes ? as_meshes(ship.model, objects) : ship.model;
  std::size_t triangles = 0;
  for (const PeerObject& o : objects) triangles += o.triangles.size();
  std::vector<double> cpu_s, wall_s;
  clash::Report report;
  for (int i = 0; i < kRuns; ++i) {
    bench::Lap lap;
    bench::CpuLap cpu;
    const auto scene = model::make_scene(model, clash::scene_options(kOptions), context).value();
    report = clash::detect(scene, clash::one_set(scene), kOptions, context).value();
    cpu_s.push_back(cpu());
    wall_s.push_back(lap());
  }
  fmt::print("{} objects{} as {}, {} triangles, {} threads\n", wanted.objects,
             wanted.turned ? ", turned," : "", wanted.meshes ? "meshes" : "a ship", triangles,
             team.size());
  if (const std::size_t wrong = bench::wrong_pairs(report, ship.truth); wrong > 0) {
    fmt::print("  Strake            ERROR: {} wrong pairs\n", wrong);
    return false;
  }
  const Known known = known_from(report);
  const Bench bench{known, median(cpu_s), median(wall_s)};
  fmt::print(
      "  {:<18}{:>8.2f} s CPU {:>29.2f} s wall; {} pairs: {} hits, {} contacts, {} nearer than {} "
      "mm; classes as in the truth\n",
      "Strake, all", bench.strake_cpu_s, bench.strake_wall_s, report.pairs.size(), report.count_hit,
      report.count_contact, report.count_clearance, kOptions.tolerances.clearance_mm);
  std::fflush(stdout);
  const auto scene = model::make_scene(model, clash::scene_options(kOptions), context).value();
  const std::vector<Peer> peers{
      {"Strake overlap", false, [&] { return strake_overlaps(scene, context); }},
      {"Embree overlap", false, [&] { return bench::embree_overlaps(objects, context); }},
      {"CGAL overlap", false, [&] { return bench::cgal_overlaps(objects, context); }},
      {"FCL overlap", false, [&] { return bench::fcl_overlaps(objects); }},
      {"FCL to 20 mm", true, [&] { return bench::fcl_within(objects, kPeerReach_mm); }}};
  bool right = true;
  for (const Peer& peer : peers) {
    std::string name = peer.name.substr(0, peer.name.find(' '));
    std::ranges::transform(name, name.begin(), [](char c) {
      return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (wanted.peer(name)) right = bench.run(peer) && right;
  }
  return right;
}

}  // namespace

int main(int argc, char** argv) {
  Wanted wanted;
  bool both = true;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "meshes" || word == "ship")
      wanted.meshes = word == "meshes";
    else if (word == "straight" || word == "turned")
      both = false, wanted.turned = word == "turned";
    else if (const auto n = std::strtoull(argv[i], nullptr, 10); n > 0)
      wanted.objects = n;
    else
      wanted.peers.push_back(word);
  }
  bool right = true;
  for (const bool turned : {false, true}) {
    if (!both && turned != wanted.turned) continue;
    Wanted each = wanted;
    each.turned = turned;
    right = measure(each) && right;
  }
  return right ? 0 : 1;
}
