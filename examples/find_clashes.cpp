// SPDX-License-Identifier: Apache-2.0
// find_clashes MODEL... : what collides, touches or comes nearer than 25 mm, as a table and as
// clashes.json, which is docs/reading-results.md's document.
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <vector>

#include "strake/strake.hpp"

namespace {

strake::Status find_clashes(const std::vector<std::filesystem::path>& files) {
  using namespace strake;
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team};

  const Result<model::Model> model = io::read_models(files, {}, context);
  if (!model) return model.error();
  const clash::Options options{.tolerances = {.clearance_mm = 25}};
  const Result<model::Scene> scene =
      model::make_scene(*model, clash::scene_options(options), context);
  if (!scene) return scene.error();
  Result<clash::Report> report = clash::detect(*scene, clash::one_set(*scene), options, context);
  if (!report) return report.error();

  clash::Findings findings;
  findings.tests.push_back(std::move(*report));
  // What reading and placing noticed, objects that were skipped among it, belongs to the result.
  Diagnostics loading = model->diagnostics;
  loading.append(scene->diagnostics);
  const report::ClashContents contents{.findings = findings, .model = *model, .loading = &loading};
  std::puts(report::clash_table(contents, {}).c_str());
  Result<AtomicFile> file = AtomicFile::create("clashes.json");
  if (!file) return file.error();
  if (Status status = report::write_clash_json(
          contents, [&](std::string_view text) { file->write(text); }, context);
      !status)
    return status;
  return file->commit();
}

}  // namespace

int main(int count, char** arguments) {
  const strake::Status status = find_clashes({arguments + 1, arguments + count});
  if (!status) std::fprintf(stderr, "%s\n", status.error().text().c_str());
  return status ? 0 : 1;
}
