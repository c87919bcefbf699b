// SPDX-License-Identifier: Apache-2.0
// bench_clash_files THREADS CLEARANCE_MM FILE...: one file against itself, or the first against the
// others. Prints times, counts and the hash; compare hashes over thread counts.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

strake::clash::Sets sets_of(const strake::model::Scene& scene, const std::string& first) {
  strake::clash::Sets sets = strake::clash::one_set(scene);
  const strake::model::Model& model = *scene.model;
  if (model.files.size() < 2) return sets;
  for (std::size_t i = 0; i < model.objects.size(); ++i) {
    sets.in_a[i] = model.files[model.objects[i].file].label == first;
    sets.in_b[i] = !sets.in_a[i];
  }
  return sets;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: bench_clash_files THREADS CLEARANCE_MM FILE...\n");
    return 2;
  }
  strake::parallel::Team team(static_cast<unsigned>(std::atoi(argv[1])));
  const strake::parallel::Context context{.team = &team, .stop = {}};
  strake::clash::Options options;
  options.clearance_mm = std::atof(argv[2]);
  const std::vector<std::filesystem::path> paths(argv + 3, argv + argc);
  const double start = seconds();
  const auto model = strake::io::read_models(paths, {}, context);
  if (!model) {
    std::fprintf(stderr, "%s\n", model.error().text().c_str());
    return 1;
  }
  const double loaded = seconds();
  const auto scene =
      strake::model::make_scene(*model, strake::clash::scene_options(options), context);
  if (!scene) return 1;
  const double placed = seconds();
  const auto sets = sets_of(*scene, paths.front().filename().string());
  const auto report = strake::clash::detect(*scene, sets, options, context);
  if (!report) {
    std::fprintf(stderr, "%s\n", report.error().text().c_str());
    return 1;
  }
  const double done = seconds();
  const auto flagged = [&](std::uint16_t flag) {
    return std::count_if(report->pairs.begin(), report->pairs.end(),
                         [&](const auto& p) { return (p.flags & flag) != 0; });
  };
  std::printf(
      "{\"objects\": %zu, \"load_s\": %.3f, \"scene_s\": %.3f, \"clash_s\": %.3f, "
      "\"part_pairs\": %llu, \"hit\": %llu, \"contact\": %llu, \"clearance\": %llu, "
      "\"uncertain\": %td, \"borderline\": %td, \"cells\": %llu, \"hash\": \"%s\"}\n",
      model->objects.size(), loaded - start, placed - loaded, done - placed,
      static_cast<unsigned long long>(report->counters.part_pairs),
      static_cast<unsigned long long>(report->count_hit),
      static_cast<unsigned long long>(report->count_contact),
      static_cast<unsigned long long>(report->count_clearance), flagged(strake::clash::kUncertain),
      flagged(strake::clash::kBorderline),
      static_cast<unsigned long long>(report->counters.depth_cells), report->hash.c_str());
  return 0;
}
