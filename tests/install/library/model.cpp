// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <filesystem>
#include <strake/io/reader.hpp>
#include <strake/model/scene.hpp>
#include <strake/model/selection.hpp>

#include "two_boxes.hpp"

int main() {
  using namespace strake;
  const std::array files{two_boxes()};
  const auto model = io::read_models(files, {.unit_mm = 1}, {});
  if (!model) return std::puts(model.error().text().c_str()), 1;
  const auto scene = model::make_scene(*model, {}, {});
  const auto second = model::Selection::parse("name = box1");
  if (!scene || !second) return 1;
  const auto picked = model::pick(*second, *scene, {});
  if (!picked) return 1;
  int count = 0;
  for (const bool one : *picked) count += one ? 1 : 0;
  std::printf("%zu objects, %d picked\n", model->objects.size(), count);
  return model->objects.size() == 2 && count == 1 ? 0 : 1;
}
