// SPDX-License-Identifier: Apache-2.0
// What a project costs and saves: seconds to store a model and to have it again, beside reading its
// file, and bytes a body.
//
//     bench_project_load [objects]      a generated ship as GLB, and a plant of primitives no two
//     of
//                                       which are alike; default 1,000,000 objects
//     bench_project_load FILE...        these files
//
// "store" is from the model in memory to the commit; "load" from opening the project (which the
// system has in its cache) to the model. Bytes are those of the blocks of objects, bodies, shapes
// and groups: attributes are in them, meshes that bodies share are not. A model that is not the one
// that was stored is an error instead of a time.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "project/database/database.hpp"
#include "project/model/model_store.hpp"
#include "strake/generate/ship.hpp"
#include "strake/io/reader.hpp"
#include "strake/io/writer.hpp"
#include "strake/parallel/team.hpp"
#include "strake/project/project.hpp"
#include "support/equal_models.hpp"
#include "support/io_files.hpp"

namespace {

using namespace strake;
namespace fs = std::filesystem;

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Pipes, elbows and boxes, each with lengths, place and turn of its own, as floats have them.
model::Model plant_of_primitives(std::uint64_t objects) {
  std::mt19937 random(1);
  const auto length = [&](double range) {
    const auto metres = static_cast<float>(random() % 1'000'000) * static_cast<float>(range * 1e-9);
    return static_cast<double>(metres) * 1000;
  };
  model::Model model;
  model.files.push_back({.label = "plant",
                         .format = "made",
                         .unit = "mm",
                         .up_axis = "z",
                         .bytes = 0,
                         .precision_mm = 0});
  for (std::uint64_t i = 0; i < objects; ++i) {
    if (i % 100 == 0)
      model.groups.push_back({fmt::format("/PIPE-{:05}", i / 100), model::GroupId::none});
    model::Object object;
    object.id = fmt::format("/PIPE-{:05}/ELEMENT {:02}", i / 100, i % 100);
    object.name = fmt::format("ELEMENT {:02}", i % 100);
    object.parent = static_cast<model::GroupId>(model.groups.size() - 1);
    object.first_body = static_cast<std::uint32_t>(i);
    object.body_count = 1;
    object.place = static_cast<std::uint32_t>(i);
    model.objects.push_back(std::move(object));
    model::Body body;
    body.shape = static_cast<model::ShapeId>(i);
    const double angle = static_cast<double>(static_cast<float>(random() % 6283) / 1000);
    const double c = static_cast<double>(static_cast<float>(std::cos(angle)));
    const double s = static_cast<double>(static_cast<float>(std::sin(angle)));
    if (i % 4 == 0) body.placement.linear = {{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}};
    body.placement.translation = {length(200'000), length(40'000), length(30'000)};
    model.bodies.push_back(body);
    switch (i % 3) {
      case 0:
        model.shapes.emplace_back(geometry::CylinderPrimitive{length(500), length(6000)});
        break;
      case 1:
        model.shapes.emplace_back(
            geometry::CircularTorusPrimitive{length(900), length(300), 1.5707963267948966});
        break;
      default:
        model.shapes.emplace_back(geometry::BoxPrimitive{length(500), length(500), length(3000)});
    }
  }
  return model;
}

struct Row {
  std::string name;
  double read_s = 0, store_s = 0, load_s = 1e30, load_cpu_s = 1e30, bytes_a_body = 0, file_mb = 0;
  std::size_t objects = 0, bodies = 0;
};

void fail(const std::string& why) {
  fmt::print(stderr, "{}\n", why);
  std::exit(1);
}

Row measure(std::string name, const project::FileToStore& file, const fs::path& folder,
            const parallel::Context& context) {
  Row row{.name = std::move(name)};
  row.objects = file.model.objects.size();
  row.bodies = file.model.bodies.size();
  const fs::path path = folder / "bench.strake";
  fs::remove(path);
  {
    const double start = wall_seconds();
    auto project = project::Project::create(path);
    if (!project) fail(project.error().text());
    auto transaction = project::Transaction::begin(project->database());
    if (!transaction) fail(transaction.error().text());
    const Status stored = project::store_files(*project, std::span(&file, 1), context);
    if (!stored) fail(stored.error().text());
    if (const Status done = transaction->commit(); !done) fail(done.error().text());
    row.store_s = wall_seconds() - start;
    auto bytes = project->database().prepare("SELECT sum(length(data)) FROM file_block");
    if (!bytes || !bytes->step()) fail("no blocks");
    row.bytes_a_body = static_cast<double>(bytes->integer(0)) /
                       static_cast<double>(std::max<std::size_t>(1, row.bodies));
  }
  row.file_mb = static_cast<double>(fs::file_size(path)) / 1e6;
  for (int repeat = 0; repeat < 3; ++repeat) {
    const double start = wall_seconds(), cpu = cpu_seconds();
    auto project = project::Project::open(path, {});
    if (!project) fail(project.error().text());
    const auto model = project->model(context);
    row.load_s = std::min(row.load_s, wall_seconds() - start);
    row.load_cpu_s = std::min(row.load_cpu_s, cpu_seconds() - cpu);
    if (!model) fail(model.error().text());
    if (const std::string found = test::model_difference(file.model, *model); !found.empty())
      fail(row.name + " comes back with another " + found);
  }
  return row;
}

Row measure_file(const fs::path& path, const fs::path& folder, const parallel::Context& context) {
  const double start = wall_seconds();
  auto model = io::read_models(std::array{path}, {}, context);
  const double read = wall_seconds() - start;
  if (!model) fail(model.error().text());
  Row row = measure(path.filename().string(), {path, {}, {}, std::move(*model)}, folder, context);
  row.read_s = read;
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "1000000";
  const bool files = first.find_first_not_of("0123456789") != std::string::npos;
  const test::TemporaryFolder folder;
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team};
  std::vector<Row> rows;
  if (files) {
    for (int i = 1; i < argc; ++i) rows.push_back(measure_file(argv[i], folder.path(), context));
  } else {
    const std::uint64_t objects = std::stoull(first);
    const fs::path glb = folder.path() / "ship.glb";
    {
      const auto ship = generate::generate_ship({.objects = objects}, context);
      if (!ship) fail(ship.error().text());
      const Status written = io::write_glb(ship->model, glb, {}, context);
      if (!written) fail(written.error().text());
    }
    rows.push_back(measure_file(glb, folder.path(), context));
    rows.push_back(measure("primitives",
                           {folder.path() / "plant", {}, {}, plant_of_primitives(objects)},
                           folder.path(), context));
  }
  fmt::print("{:<24}{:>10}{:>10}{:>9}{:>9}{:>9}{:>10}{:>9}{:>9}\n", "model", "objects", "bodies",
             "read s", "store s", "load s", "load CPU", "B/body", "file MB");
  for (const Row& row : rows)
    fmt::print("{:<24}{:>10}{:>10}{:>9.2f}{:>9.2f}{:>9.2f}{:>10.2f}{:>9.1f}{:>9.1f}\n", row.name,
               row.objects, row.bodies, row.read_s, row.store_s, row.load_s, row.load_cpu_s,
               row.bytes_a_body, row.file_mb);
  return 0;
}
