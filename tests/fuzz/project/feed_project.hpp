// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "project/views/drawing_codec.hpp"
#include "project/views/stored_views.hpp"
#include "strake/generate/ship.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/io/reader.hpp"
#include "strake/io/writer.hpp"
#include "strake/project/project.hpp"
#include "support/equal_models.hpp"
#include "support/io_files.hpp"
#include "support/io_seeds.hpp"
#include "support/stored_models.hpp"

namespace strake::test {

[[noreturn]] inline void stop(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

/// A small project of an OBJ and a GLB file, of which one lies on a map, its model, and the drawing
/// of its view 'iso'.
struct ProjectSeed {
  Seed file;
  model::Model model;
  hlr::Drawing drawing;
};

/// Stores the view of a model. What it was solved from is made up: nobody needs it whether it
/// holds.
[[nodiscard]] inline hlr::Drawing store_iso(project::Project& project, const model::Model& model) {
  const auto scene = model::make_scene(model, {}, {});
  if (!scene) stop("no scene");
  auto drawing = hlr::draw(*scene, {}, {}, {}, {});
  if (!drawing) stop("no drawing");
  const std::size_t objects = model.objects.size();
  project::Snapshot made_from{
      {1, 2}, std::vector<std::uint64_t>(objects), std::vector<Hash128>(objects)};
  for (std::size_t o = 0; o < objects; ++o) made_from.signatures[o] = {o, o * o};
  const std::vector<geometry::Box3l> boxes(objects, {{0, 0, 0}, {1, 1, 1}});
  const project::ViewToStore view{.name = "iso",
                                  .settings = "{}",
                                  .drawing = &*drawing,
                                  .made_from = &made_from,
                                  .boxes = &boxes,
                                  .model = &model};
  if (!project::store_view(project.database(), view, {})) stop("no view");
  return std::move(*drawing);
}

[[nodiscard]] inline ProjectSeed project_seed() {
  const TemporaryFolder folder;
  const auto ship = generate::generate_ship({.objects = 100}, {});
  const std::array paths{folder.path() / "ship.glb",
                         folder.write("plate.obj", obj_seeds()[1].bytes)};
  if (!ship || !io::write_glb(ship->model, paths[0], {}, {})) stop("no ship");
  const std::filesystem::path path = folder.path() / "seed.strake";
  ProjectSeed seed;
  {
    auto project = project::Project::create(path);
    if (!project || !store(*project, paths, {}, io::MapPlace{.crs = "EPSG:25832", .to_map = {}}))
      stop("no project");
    auto model = project->model({});
    if (!model) stop("no model");
    seed.drawing = store_iso(*project, *model);
    seed.model = std::move(*model);
  }
  std::ifstream in(path, std::ios::binary);
  seed.file = {"seed.strake",
               {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()}};
  return seed;
}

/// What became of bytes that were read as a project.
enum class Fed { refused, read };

/// Any bytes as a project: an error that names the file, or a model and a drawing. `expected` has
/// those that they must be then; null: any.
inline Fed feed_project(const std::string& bytes, const std::filesystem::path& folder,
                        const ProjectSeed* expected = nullptr) {
  const std::filesystem::path path = folder / "fuzz.strake";
  std::ofstream(path, std::ios::binary) << bytes;
  const auto refused = [](const Error& error) {
    if (error.where.find("fuzz.strake") == std::string::npos)
      stop("an error without a file: " + error.text());
    return Fed::refused;
  };
  auto project = project::Project::open(path, {});
  if (!project) return refused(project.error());
  const auto model = project->model({});
  if (!model) return refused(model.error());
  if (expected != nullptr)
    if (const std::string found = model_difference(expected->model, *model); !found.empty())
      stop("damage that nobody saw: " + found);
  const auto former = project::former_drawing(project->database(), "iso", {});
  // An error of a row names the view, and who asks knows the file.
  if (!former) return Fed::refused;
  if (expected != nullptr && !project::are_equal(expected->drawing, former->drawing).value())
    stop("damage of a drawing that nobody saw");
  return Fed::read;
}

}  // namespace strake::test
