// SPDX-License-Identifier: Apache-2.0
// bench_clash_files THREADS CLEARANCE_MM FILE...: one file against itself, or the first against the
// others. Prints times, counts and the hash; compare hashes over thread counts.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "timed_run.hpp"

namespace {

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
    return argc > 1 ? 2 : 0;  // without any there is nothing to measure
  }
  strake::clash::Options options;
  options.tolerances.clearance_mm = std::atof(argv[2]);
  const std::vector<std::filesystem::path> paths(argv + 3, argv + argc);
  const auto run = strake::bench::timed_run(
      paths, options, static_cast<unsigned>(std::atoi(argv[1])),
      [&](const auto& scene) { return sets_of(scene, paths.front().filename().string()); });
  if (!run) {
    std::fprintf(stderr, "%s\n", run.error().text().c_str());
    return 1;
  }
  const strake::clash::Report& report = run->report;
  const auto flagged = [&](std::uint16_t flag) {
    return std::count_if(report.pairs.begin(), report.pairs.end(),
                         [&](const auto& p) { return (p.flags & flag) != 0; });
  };
  std::printf(
      "{\"objects\": %zu, \"load_s\": %.3f, \"scene_s\": %.3f, \"clash_s\": %.3f, "
      "\"part_pairs\": %llu, \"hit\": %llu, \"contact\": %llu, \"clearance\": %llu, "
      "\"uncertain\": %td, \"borderline\": %td, \"cells\": %llu, \"hash\": \"%s\"}\n",
      run->model->objects.size(), run->load_s, run->scene_s, run->clash_s,
      static_cast<unsigned long long>(report.counters.part_pairs),
      static_cast<unsigned long long>(report.count_hit),
      static_cast<unsigned long long>(report.count_contact),
      static_cast<unsigned long long>(report.count_clearance), flagged(strake::clash::kUncertain),
      flagged(strake::clash::kBorderline),
      static_cast<unsigned long long>(report.counters.depth_cells), report.hash.c_str());
  return 0;
}
