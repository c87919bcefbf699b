// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <strake/io/reader.hpp>
#include <strake/report/clash.hpp>
#include <string>

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
  const report::ClashContents contents{.findings = findings, .model = *model};
  std::string json;
  if (!report::write_clash_json(contents, [&](std::string_view text) { json += text; })) return 1;
  std::puts(report::clash_table(contents, {}).c_str());
  return json.find("\"HIT\"") != std::string::npos ? 0 : 1;
}
