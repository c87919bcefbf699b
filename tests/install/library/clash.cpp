// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstdio>
#include <strake/clash/clash.hpp>
#include <strake/io/reader.hpp>

#include "two_boxes.hpp"

int main() {
  using namespace strake;
  const std::array files{two_boxes()};
  const auto model = io::read_models(files, {.unit_mm = 1}, {});
  if (!model) return std::puts(model.error().text().c_str()), 1;
  const clash::Options options;
  const auto scene = model::make_scene(*model, clash::scene_options(options), {});
  if (!scene) return 1;
  const auto report = clash::detect(*scene, clash::one_set(*scene), options, {});
  if (!report || report->pairs.size() != 1) return 1;
  const clash::Pair& pair = report->pairs.front();
  std::printf("%s %.3f mm\n", clash::name(pair.cls).data(), pair.d_mm);
  return pair.cls == clash::Class::hit && std::fabs(pair.d_mm + 10) < 0.01 ? 0 : 1;
}
