// SPDX-License-Identifier: Apache-2.0
#include "cli/load.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "cli/doubtful_units.hpp"
#include "strake/core/severity.hpp"
#include "strake/core/units.hpp"

namespace strake::cli {

namespace {

/// Corners closer than the grid's spacing cannot be told apart.
constexpr double kFinestSagMm = 0.001;
constexpr double kWidestWeldMm = 1000;

}  // namespace

void add_scene_options(CLI::App& command, SceneInput& options, const std::string& default_sag) {
  command
      .add_option(
          "--sag", options.sag,
          "Largest distance of a tessellated curve from the true one (default " + default_sag + ")")
      ->type_name("LENGTH")
      ->group("Input");
  command
      .add_option("--weld", options.weld,
                  "Seams of meshes that are no wider close (default: what the numbers of each body "
                  "cannot tell apart, 3um at least; 0: none)")
      ->type_name("LENGTH")
      ->group("Input");
  command
      .add_flag("--obstructions", options.obstructions,
                "Take obstruction volumes (space kept free) in as well")
      ->group("Input");
  command.add_flag("--insulation", options.insulation, "Take insulation in as well")
      ->group("Input");
}

Result<model::SceneOptions> scene_options(const SceneInput& input, double default_sag_mm) {
  model::SceneOptions options;
  options.sag_mm = default_sag_mm;
  options.obstruction = input.obstructions;
  options.insulation = input.insulation;
  if (const Status status = length_option(options.weld_mm, input.weld, "--weld"); !status)
    return status.error();
  if (options.weld_mm > kWidestWeldMm)
    return Error{ErrorCode::usage, "'" + input.weld + "' is longer than a metre", "--weld",
                 "write the widest gap that is no gap, as 0.01mm"};
  if (input.sag.empty()) return options;
  const Result<double> sag = quantity(input.sag, "--sag", parse_length_mm);
  if (!sag) return sag.error();
  if (*sag <= 0)
    return Error{ErrorCode::usage, "the sag must be positive", "--sag", "write a length, as 0.5mm"};
  if (*sag < kFinestSagMm)
    return Error{ErrorCode::usage, "'" + input.sag + "' is finer than the grid of 1um", "--sag",
                 "write 1um or more"};
  options.sag_mm = *sag;
  return options;
}

void tell(Console& console, const Diagnostics& diagnostics,
          std::initializer_list<std::string_view> each) {
  const auto words = [](const Diagnostic& d) {
    return fmt::format(": {}{}{}", d.where, d.where.empty() ? "" : ": ", d.message);
  };
  const auto& kept = diagnostics.kept();
  for (const Diagnostics::Count& count : diagnostics.counts()) {
    std::string line = fmt::format("{} {}", severity_name(count.severity), count.code);
    if (std::find(each.begin(), each.end(), count.code) != each.end()) {
      for (const Diagnostic& d : kept)
        if (d.code == count.code) console.say(line + words(d));
      if (count.count > Diagnostics::kMaxPerCode)
        console.say(line + fmt::format(", {} in all", count.count));
      continue;
    }
    if (count.count > 1) line += fmt::format(", first of {}", count.count);
    const auto first = std::find_if(kept.begin(), kept.end(),
                                    [&](const Diagnostic& d) { return d.code == count.code; });
    if (first != kept.end()) line += words(*first);
    console.say(line);
  }
}

namespace {

Result<model::Model> read_model(Session& session, const InputOptions& input) {
  const Result<std::vector<io::FileToRead>> files = files_to_read(input);
  if (!files) return files.error();
  const auto timer = session.step("load");
  Result<model::Model> model = io::read_models(*files, session.context());
  if (!model) return model;
  std::vector<std::uint64_t> objects(model->files.size());
  for (const model::Object& object : model->objects) ++objects[object.file];
  for (std::size_t f = 0; f < model->files.size(); ++f) {
    const model::SourceFile& file = model->files[f];
    session.console().say(fmt::format("{}: {}, {} objects, unit {}, {} up", file.label, file.format,
                                      objects[f], file.unit, file.up_axis));
  }
  tell(session.console(), model->diagnostics);
  if (const std::string rest = unread_rest(*model); !rest.empty())
    session.console().warn(fmt::format("nothing is known of {}", rest));
  return model;
}

Result<model::Scene> place_model(Session& session, const model::Model& model,
                                 const model::SceneOptions& options) {
  const auto timer = session.step("place");
  Result<model::Scene> scene = model::make_scene(model, options, session.context());
  if (!scene) return scene;
  note_doubtful_units(*scene);
  tell(session.console(), scene->diagnostics);
  if (scene->left_out > 0)
    session.console().say(fmt::format(
        "left out {} bodies of obstructions and insulation (--obstructions, --insulation)",
        scene->left_out));
  return scene;
}

}  // namespace

Diagnostics Loaded::diagnostics() const {
  Diagnostics all = model->diagnostics;
  all.append(scene.diagnostics);
  return all;
}

Result<Loaded> load(Session& session, const InputOptions& input,
                    const model::SceneOptions& options) {
  Result<model::Model> model = read_model(session, input);
  if (!model) return model.error();
  Loaded loaded;
  loaded.model = std::make_unique<const model::Model>(std::move(*model));
  Result<model::Scene> scene = place_model(session, *loaded.model, options);
  if (!scene) return scene.error();
  loaded.scene = std::move(*scene);
  return loaded;
}

ExitCode outcome(const InputOptions& input, const Loaded& loaded) {
  return input.strict && loaded.diagnostics().skipped() > 0 ? ExitCode::partial : ExitCode::done;
}

}  // namespace strake::cli
