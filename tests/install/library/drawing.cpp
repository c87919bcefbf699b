// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <strake/drawing/write.hpp>
#include <strake/io/reader.hpp>
#include <string>
#include <vector>

#include "two_boxes.hpp"

int main() {
  using namespace strake;
  const std::array files{two_boxes()};
  const auto model = io::read_models(files, {.unit_mm = 1}, {});
  if (!model) return std::puts(model.error().text().c_str()), 1;
  const auto scene = model::make_scene(*model, {}, {});
  if (!scene) return 1;
  const std::vector<bool> all(model->objects.size(), true);
  const auto lines = hlr::draw(*scene, all, {}, {}, {});
  if (!lines) return 1;
  const auto sheet = drawing::lay_out(*lines, *model, {}, {});
  if (!sheet) return 1;
  const auto ink = drawing::choose_ink(*sheet, {}, {});
  if (!ink) return 1;
  std::string svg;
  drawing::write_svg(*sheet, *ink, *model, [&](std::string_view text) { svg += text; });
  std::printf("%zu lines, %zu bytes\n", sheet->lines.size(), svg.size());
  return !sheet->lines.empty() && svg.find("</svg>") != std::string::npos ? 0 : 1;
}
