// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <strake/project/project.hpp>

int main() {
  using namespace strake;
  const std::filesystem::path file = "ship.strake";
  std::filesystem::remove(file);
  {
    const auto made = project::Project::create(file);
    if (!made) return std::puts(made.error().text().c_str()), 1;
  }
  if (!project::is_project(file)) return 1;
  auto project = project::Project::open(file, {});
  if (!project) return std::puts(project.error().text().c_str()), 1;
  const auto model = project->model({});
  if (!model) return std::puts(model.error().text().c_str()), 1;
  return model->objects.empty() ? 0 : 1;
}
