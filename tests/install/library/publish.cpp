// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <filesystem>
#include <strake/io/reader.hpp>
#include <strake/publish/publish.hpp>

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
  if (!report) return 1;
  clash::Findings findings;
  findings.tests.push_back(*report);
  const report::ClashContents contents{.findings = findings, .model = *model, .scene = &*scene};
  for (const char* const file : {"clashes.xlsx", "clashes.bcf", "clashes.html", "clashes.glb"}) {
    if (const auto status = publish::write_clashes(contents, file); !status)
      return std::puts(status.error().text().c_str()), 1;
    if (std::filesystem::file_size(file) < 1000) return 1;
  }
  return publish::write_clashes(contents, "clashes.doc") ? 1 : 0;
}
