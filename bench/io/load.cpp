// SPDX-License-Identifier: Apache-2.0
// How fast models are read, from the first byte to a finished model: MB/s of wall time and of CPU
// time for a made plant as OBJ, as GLB of plain geometry and as GLB of many nodes, or for the
// files that are named. A file that comes back with other counts reports an error instead.
//
//     bench_io_load [megabytes]         made models of about that size, default 100
//     bench_io_load FILE...             these files
#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "strake/io/reader.hpp"
#include "strake/io/writer.hpp"
#include "strake/parallel/team.hpp"
#include "support/io_files.hpp"
#include "support/io_models.hpp"

namespace {

using namespace strake;

struct Counts {
  std::size_t objects = 0, triangles = 0;
  friend bool operator==(const Counts&, const Counts&) = default;
};

Counts count(const model::Model& model) {
  Counts counts{model.objects.size(), 0};
  for (const model::Body& body : model.bodies)
    if (const auto* const mesh =
            std::get_if<geometry::TriangleMesh>(&model.shapes[model::index(body.shape)]))
      counts.triangles += mesh->triangles.size();
  return counts;
}

/// A closed tube about z; coordinates on a micrometre grid, as exporters round them.
geometry::TriangleMesh tube(std::uint32_t sides, double radius, double length) {
  geometry::TriangleMesh mesh;
  const auto rounded = [](double v) { return std::round(v * 1000) / 1000; };
  for (std::uint32_t i = 0; i < sides; ++i)
    for (const double z : {0.0, length}) {
      const double angle = 6.283185307179586 * i / sides;
      mesh.vertices.push_back(
          {rounded(radius * std::cos(angle)), rounded(radius * std::sin(angle)), z});
    }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
    if (i > 1) mesh.triangles.push_back({0, a, a - 2});
    if (i > 1) mesh.triangles.push_back({1, a - 1, a + 1});
  }
  return mesh;
}

/// `objects` tubes, of which every `shared` stand on one shape.
model::Model plant(std::uint32_t objects, std::uint32_t shared, std::uint32_t sides) {
  model::Model model;
  model.files.push_back({});
  for (std::uint32_t i = 0; i < objects; ++i) {
    if (i % shared == 0) test::add_shape(model, tube(sides, 50 + i % 200, 1000 + i % 777));
    const std::string name = fmt::format("/ZONE-{}/PIPE-{:06}", i / 1000, i);
    model::Object& object = test::add_object(model, name, name);
    object.attributes = {{"TYPE", "TUBE"}, {"SPEC", "A150"}, {"BORE", std::to_string(i % 300)}};
    const auto last = static_cast<model::ShapeId>(model.shapes.size() - 1);
    test::add_body(model, last, test::quarter_turn({i % 1000 * 137.5, i / 1000 * 211.0, 2000.25}));
  }
  return model;
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The best of several readings; an error when the counts differ from those expected.
void measure(const std::string& name, const std::filesystem::path& path, const Counts* expected) {
  const double megabytes = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
  for (const unsigned workers : {1U, 2U}) {
    parallel::Team team(workers);
    parallel::Context context;
    context.team = &team;
    double wall = 1e30, cpu = 1e30;
    Counts counts;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const double wall_start = wall_seconds(), cpu_start = cpu_seconds();
      const Result<model::Model> model = io::read_models(std::span(&path, 1), {}, context);
      wall = std::min(wall, wall_seconds() - wall_start);
      cpu = std::min(cpu, cpu_seconds() - cpu_start);
      if (!model) return fmt::print("{:<24} ERROR: {}\n", name, model.error().text());
      counts = count(*model);
    }
    if (expected != nullptr && counts != *expected)
      return fmt::print("{:<24} ERROR: wrong counts\n", name);
    fmt::print(
        "{:<24} {} workers {:>8.1f} MB {:>8} objects {:>9} triangles {:>8.3f} s {:>7.1f} "
        "MB/s   {:.3f} CPU s {:>7.1f} MB/CPU s\n",
        name, workers, megabytes, counts.objects, counts.triangles, wall, megabytes / wall, cpu,
        megabytes / cpu);
  }
}

void measure_made(double megabytes) {
  const test::TemporaryFolder folder;
  const auto run = [&](const char* name, const model::Model& model, const char* file) {
    const std::filesystem::path path = folder.path() / file;
    const bool obj = path.extension() == ".obj";
    const Status written =
        obj ? io::write_obj(model, path, {}, {}) : io::write_glb(model, path, {}, {});
    if (!written) return fmt::print("{:<24} ERROR: {}\n", name, written.error().text());
    const Counts counts = count(model);
    measure(name, path, &counts);
    std::filesystem::remove(path);
  };
  const auto scaled = [&](double per_megabyte) {
    return static_cast<std::uint32_t>(megabytes * per_megabyte) + 1;
  };
  run("OBJ", plant(scaled(240), 1, 48), "plant.obj");
  run("GLB, plain geometry", plant(scaled(96), 1, 256), "plain.glb");
  run("GLB, shared meshes", plant(scaled(2800), 100, 24), "shared.glb");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || !std::filesystem::exists(argv[1])) {
    measure_made(argc < 2 ? 100 : std::atof(argv[1]));
    return 0;
  }
  for (int i = 1; i < argc; ++i)
    measure(std::filesystem::path(argv[i]).filename().string(), argv[i], nullptr);
  return 0;
}
