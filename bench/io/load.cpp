// SPDX-License-Identifier: Apache-2.0
// How fast models are read: MB of file per second of wall time and of CPU time, for made models as
// OBJ, as GLB of plain geometry, of shared meshes and of many small nodes (the ship), for a real
// RVM repeated, or for the files that are named.
//
//     bench_io_load [megabytes]         made models of about that size, default 100
//     bench_io_load FILE...             these files
//
// "read" is io::read_models: from opening the file (which the system has in its cache) to the
// finished model, freeing of what only the reader needed included. Not in it: freeing the model,
// and make_scene, which tessellates primitives and puts everything on the grid; that is timed
// once, apart, as "scene". RVM samples are HA-*.RVM below the folder that STRAKE_DATA names; see
// repeat_rvm.hpp for how they are repeated. Counts other than expected, and counts that change
// with the number of workers, are an error instead of a time.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "repeat_rvm.hpp"
#include "strake/generate/ship.hpp"
#include "strake/io/reader.hpp"
#include "strake/io/writer.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"
#include "support/io_files.hpp"
#include "synthetic_plant.hpp"

namespace {

using namespace strake;
namespace fs = std::filesystem;

struct Counts {
  std::size_t objects = 0, bodies = 0, triangles = 0;
  friend bool operator==(const Counts&, const Counts&) = default;
};

Counts count(const model::Model& model) {
  Counts counts{model.objects.size(), model.bodies.size(), 0};
  for (const model::Body& body : model.bodies)
    if (const auto* const mesh =
            std::get_if<geometry::TriangleMesh>(&model.shapes[model::index(body.shape)]))
      counts.triangles += mesh->triangles.size();
  return counts;
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Timing {
  double read_s = 1e30, read_cpu_s = 1e30, scene_s = 0;
  std::optional<Error> error;
  Counts counts;
};

/// The best of several readings, and one scene.
Timing time_file(const fs::path& path, unsigned workers) {
  constexpr int kRepeats = 4;
  parallel::Team team(workers);
  parallel::Context context;
  context.team = &team;
  Timing timing;
  for (int repeat = 0; repeat < kRepeats && !timing.error; ++repeat) {
    const double wall_start = wall_seconds(), cpu_start = cpu_seconds();
    const Result<model::Model> model = io::read_models(std::span(&path, 1), {}, context);
    timing.read_s = std::min(timing.read_s, wall_seconds() - wall_start);
    timing.read_cpu_s = std::min(timing.read_cpu_s, cpu_seconds() - cpu_start);
    if (!model) timing.error = model.error();
    if (!model || repeat != 0) continue;
    timing.counts = count(*model);
    const double scene_start = wall_seconds();
    const auto scene = model::make_scene(*model, {}, context);
    timing.scene_s = wall_seconds() - scene_start;
    if (!scene) timing.error = scene.error();
  }
  return timing;
}

void measure(const std::string& name, const fs::path& path, std::optional<Counts> expected) {
  const double megabytes = static_cast<double>(fs::file_size(path)) / 1e6;
  for (const unsigned workers : {1U, 2U}) {
    const Timing t = time_file(path, workers);
    if (t.error) return fmt::print("{:<22} ERROR: {}\n", name, t.error->text());
    if (t.counts != expected.value_or(t.counts))
      return fmt::print("{:<22} ERROR: wrong counts\n", name);
    expected = t.counts;
    fmt::print(
        "{:<22} {} workers {:>7.1f} MB {:>7} objects {:>9} triangles  read {:>6.3f} s "
        "{:>6.1f} MB/s  {:>6.3f} CPU s {:>6.1f} MB/CPU s  scene {:>6.2f} s\n",
        name, workers, megabytes, t.counts.objects, t.counts.triangles, t.read_s,
        megabytes / t.read_s, t.read_cpu_s, megabytes / t.read_cpu_s, t.scene_s);
  }
}

void measure_model(const char* name, const model::Model& model, const char* file) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / file;
  const bool obj = path.extension() == ".obj";
  const Status written =
      obj ? io::write_obj(model, path, {}, {}) : io::write_glb(model, path, {}, {});
  if (!written) return fmt::print("{:<22} ERROR: {}\n", name, written.error().text());
  measure(name, path, count(model));
}

void measure_ship(std::uint64_t objects) {
  const Result<generate::Ship> ship = generate::generate_ship({.objects = objects}, {});
  if (!ship) return fmt::print("ERROR: {}\n", ship.error().text());
  measure_model("GLB, many nodes", ship->model, "ship.glb");
}

std::vector<fs::path> rvm_samples() {
  std::vector<fs::path> samples;
  const char* const data = std::getenv("STRAKE_DATA");
  if (data == nullptr) return samples;
  for (const auto& entry : fs::recursive_directory_iterator(data)) {
    const std::string file = entry.path().filename().string();
    if (file.starts_with("HA-") && file.ends_with(".RVM")) samples.push_back(entry.path());
  }
  std::sort(samples.begin(), samples.end());
  return samples;
}

void measure_rvm(double megabytes) {
  const std::vector<fs::path> samples = rvm_samples();
  if (samples.empty())
    return fmt::print("RVM: no HA-*.RVM below the folder that STRAKE_DATA names\n");
  for (const auto& [name, copies] : {std::pair("RVM, repeated", bench::Copies::alike),
                                     std::pair("RVM, all different", bench::Copies::different)}) {
    const auto bytes =
        bench::repeat_rvm(samples, static_cast<std::size_t>(megabytes * 1e6), copies);
    if (!bytes) return fmt::print("{:<22} ERROR: {}\n", name, bytes.error().text());
    const test::TemporaryFolder folder;
    measure(name, folder.write("repeated.rvm", *bytes), std::nullopt);
  }
}

void measure_made(double megabytes) {
  const auto scaled = [&](double per_megabyte) {
    return static_cast<std::uint32_t>(megabytes * per_megabyte) + 1;
  };
  measure_model("OBJ", bench::plant(scaled(240), 1, 48), "plant.obj");
  measure_model("GLB, plain geometry", bench::plant(scaled(96), 1, 256), "plain.glb");
  measure_model("GLB, shared meshes", bench::plant(scaled(2800), 100, 24), "shared.glb");
  measure_ship(std::max(scaled(3450), 100U));
  measure_rvm(megabytes);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || !fs::exists(argv[1])) {
    measure_made(argc < 2 ? 100 : std::atof(argv[1]));
    return 0;
  }
  for (int i = 1; i < argc; ++i) measure(fs::path(argv[i]).filename().string(), argv[i], {});
  return 0;
}
