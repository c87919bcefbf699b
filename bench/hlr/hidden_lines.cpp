// SPDX-License-Identifier: Apache-2.0
// Hidden lines of whole files: seconds of the draw alone, beside reading and placing, and what
// peers print too, the length on paper of visible sharp lines. The result is checked by exact
// rays through random points of the pieces; a wrong one ends with an error instead of a time.
//
//     bench_hidden_lines [--threads N] [--direction x,y,z] [--angle DEG] [--rays N] [--repeat N]
//                        [--no-culling] [--global gather|push|both] [--sag MM] FILE...
//
// --global both draws by the baseline as well and compares the pieces.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "clocks.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"
#include "support/ray_check.hpp"

namespace {

using namespace strake;

struct Arguments {
  std::vector<std::filesystem::path> files;
  hlr::View view{.direction = {1, 1, 1}, .limits = {}};
  hlr::Options options;
  model::SceneOptions scene;
  unsigned threads = 1;
  std::uint64_t rays = 1000;
  int repeat = 3;
  bool both = false;  ///< the baseline after the engine
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    const auto value = [&] { return i + 1 < argc ? argv[++i] : "0"; };
    if (key == "--threads")
      a.threads = static_cast<unsigned>(std::atoi(value()));
    else if (key == "--angle")
      a.options.sharp_angle_deg = std::atof(value());
    else if (key == "--rays")
      a.rays = std::strtoull(value(), nullptr, 10);
    else if (key == "--repeat")
      a.repeat = std::atoi(value());
    else if (key == "--sag")
      a.scene.sag_mm = std::atof(value());
    else if (key == "--no-culling")
      a.options.culling = false;
    else if (key == "--global") {
      const std::string how = value();
      if (how == "push") a.options.solver = hlr::Solver::push;
      a.both = how == "both";
    } else if (key == "--direction")
      std::sscanf(value(), "%ld,%ld,%ld", &a.view.direction.x, &a.view.direction.y,
                  &a.view.direction.z);
    else
      a.files.emplace_back(key);
  }
  return a;
}

double paper_length(const hlr::EdgePiece& p, const geometry::Vec3l& direction) {
  const auto v = (p.b - p.a).as<double>(), d = direction.as<double>();
  const double along = dot(v, d);
  return std::sqrt(std::max(0.0, dot(v, v) - along * along / dot(d, d))) / 1000;
}

void report(const hlr::Drawing& drawing) {
  std::map<std::pair<hlr::EdgeKind, hlr::State>, std::pair<std::uint64_t, double>> sums;
  for (const hlr::EdgePiece& p : drawing.pieces) {
    auto& [count, length] = sums[{p.kind, p.state}];
    ++count;
    length += paper_length(p, drawing.view.direction);
  }
  for (const auto& [key, sum] : sums)
    fmt::print("  {:<13}{:<16}{:>9} pieces {:>16.1f} mm\n", drawing::kind_name(key.first),
               drawing::state_name(drawing::line_state(key.second)), sum.first, sum.second);
  const hlr::Counters& c = drawing.counters;
  fmt::print("  {} edges, {} pieces, {} face tests, {} of them wide, contact distance {} mm\n",
             c.feature_edges, drawing.pieces.size(), c.face_tests, c.exact_fallbacks,
             drawing.contact_distance_mm);
}

bool same(const hlr::EdgePiece& p, const hlr::EdgePiece& q) {
  return p.object == q.object && p.edge == q.edge && p.kind == q.kind && p.state == q.state &&
         p.other == q.other && p.a == q.a && p.b == q.b;
}

/// Draws by the baseline, says how long that took, and whether the pieces are the same.
bool baseline_agrees(const model::Scene& scene, const Arguments& a,
                     const parallel::Context& context, const hlr::Drawing& expected) {
  hlr::Options options = a.options;
  options.solver = hlr::Solver::push;
  bench::Clock clock;
  const auto drawing = hlr::draw(scene, {}, a.view, options, context);
  if (!drawing) return fmt::print(stderr, "{}\n", drawing.error().text()), false;
  const bool equal = std::equal(expected.pieces.begin(), expected.pieces.end(),
                                drawing->pieces.begin(), drawing->pieces.end(), same);
  fmt::print("push   {}, {} face tests, pieces {}\n", clock.text(), drawing->counters.face_tests,
             equal ? "the same" : "DIFFERENT");
  return equal;
}

int run(const Arguments& a) {
  parallel::Team team(a.threads);
  const parallel::Context context{.team = a.threads > 1 ? &team : nullptr};
  bench::Clock clock;
  const auto model = io::read_models(a.files, {}, context);
  if (!model) return fmt::print(stderr, "{}\n", model.error().text()), 3;
  fmt::print("read   {}\n", clock.text());
  clock = {};
  const auto scene = model::make_scene(*model, a.scene, context);
  if (!scene) return fmt::print(stderr, "{}\n", scene.error().text()), 3;
  std::uint64_t triangles = 0;
  for (const auto& body : scene->bodies)
    for (const auto& part : scene->shapes[body.grid_shape].parts)
      triangles += part.triangles.size();
  fmt::print("place  {}: {} objects, {} bodies, {} triangles\n", clock.text(),
             model->objects.size(), scene->bodies.size(), triangles);
  for (int i = 0; i < a.repeat; ++i) {
    clock = {};
    const auto drawing = hlr::draw(*scene, {}, a.view, a.options, context);
    if (!drawing) return fmt::print(stderr, "{}\n", drawing.error().text()), 3;
    fmt::print("draw   {}\n", clock.text());
    if (i + 1 < a.repeat) continue;
    report(*drawing);
    const test::RayCheck check = test::check_by_rays(*scene, *drawing, a.rays, 1);
    fmt::print("  {} exact rays: {} wrong; {} pieces too short to ask\n", check.rays, check.wrong,
               check.too_short);
    if (check.wrong > 0) return fmt::print(stderr, "{}\n", check.first_wrong), 5;
    if (a.both && !baseline_agrees(*scene, a, context, *drawing)) return 5;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return run(parse(argc, argv)); }
