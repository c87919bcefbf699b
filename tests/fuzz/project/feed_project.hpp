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

#include "strake/generate/ship.hpp"
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

/// A small project of an OBJ and a GLB file, and its model.
struct ProjectSeed {
  Seed file;
  model::Model model;
};

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
    if (!project || !store(*project, paths)) stop("no project");
    auto model = project->model({});
    if (!model) stop("no model");
    seed.model = std::move(*model);
  }
  std::ifstream in(path, std::ios::binary);
  seed.file = {"seed.strake",
               {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()}};
  return seed;
}

/// What became of bytes that were read as a project.
enum class Fed { refused, read };

/// Any bytes as a project: an error that names the file, or a model. `expected` is the one it must
/// be then; null: any.
inline Fed feed_project(const std::string& bytes, const std::filesystem::path& folder,
                        const model::Model* expected = nullptr) {
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
    if (const std::string found = model_difference(*expected, *model); !found.empty())
      stop("damage that nobody saw: " + found);
  return Fed::read;
}

}  // namespace strake::test
