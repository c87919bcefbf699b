// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "support/pdf_reader.hpp"
#include "support/sheet_models.hpp"
#include "support/sheet_seeds.hpp"

namespace strake::test {

/// Any bytes as a sheet file, or, where they begin as markup does, as a template: a sheet that is
/// drawn, or an error that names its file.
inline void feed_sheet(std::string_view bytes) {
  const auto stop = [](const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
  };
  static const ClashModel model = three_boxes();
  static const model::Scene scene = model::make_scene(model.model, {}, {}).value();
  const bool markup = bytes.starts_with('<');
  const Templates templates{{"f.svg", markup ? std::string(bytes) : kSheetTemplate}};
  const auto file = sheet_file(
      markup ? "[sheet]\ntemplate = \"f.svg\"\n[[view]]\nname = \"v\"\n" : bytes, templates);
  if (!file) {
    const std::string& where = file.error().where;
    if (where.find("s.toml") == std::string::npos) stop("an error without a file");
    return;
  }
  const auto sheet = file->compose(scene, {}, {});
  if (!sheet) {
    if (sheet.error().where.find("s.toml") == std::string::npos) stop("an error without a file");
    return;
  }
  std::string svg;
  sheets::write_svg(*sheet, model.model, [&](std::string_view part) { svg += part; });
  for (const char* const never : {"<script", "<!", "<?xml-", "javascript:", "http://x"})
    if (svg.find(never) != std::string::npos) stop("more than a drawing");
  if (!markup) return;
  std::string pdf;
  if (!sheets::write_pdf({&*sheet, 1}, model.model, [&](std::string_view part) { pdf += part; },
                         {}))
    stop("a sheet that is no PDF");
  if (const std::string fault = read_pdf(pdf).fault; !fault.empty()) stop(fault.c_str());
}

}  // namespace strake::test
