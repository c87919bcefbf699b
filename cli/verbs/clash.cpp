// SPDX-License-Identifier: Apache-2.0
#include "strake/clash/clash.hpp"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/load.hpp"
#include "cli/verb.hpp"
#include "strake/report/clash.hpp"

namespace strake::cli {

namespace {

struct ClashOptions {
  InputOptions input;
  SceneInput scene;
  std::string clearance, touch_gap, touch_overlap, contact_distance;
  std::string broad_phase, thickness_cap, fail_on;
  bool self = false;
  std::vector<std::string> outputs;
};

Result<clash::Options> engine_options(const ClashOptions& given) {
  clash::Options options;
  struct Length {
    double& value;
    const std::string& text;
    const char* option;
  };
  for (const Length& length :
       {Length{options.clearance_mm, given.clearance, "--clearance"},
        Length{options.touch_gap_mm, given.touch_gap, "--touch-gap"},
        Length{options.touch_overlap_mm, given.touch_overlap, "--touch-overlap"},
        Length{options.contact_distance_mm, given.contact_distance, "--contact-distance"}})
    if (const Status status = length_option(length.value, length.text, length.option); !status)
      return status.error();
  if (given.broad_phase == "all-pairs") options.broad_phase = clash::BroadPhase::all_pairs;
  if (given.thickness_cap == "off") options.thickness_cap = clash::ThicknessCap::off;
  return options;
}

/// One file against itself; several against each other, or with `self` all against all.
clash::Sets sets_of(const model::Model& model, bool self) {
  const std::size_t n = model.objects.size();
  clash::Sets sets{std::vector<bool>(n, true), std::vector<bool>(n, true)};
  if (self || model.files.size() < 2) return sets;
  if (model.files.size() > 2) {
    for (const model::Object& object : model.objects) sets.group.push_back(object.file);
    return sets;
  }
  for (std::size_t o = 0; o < n; ++o) {
    sets.in_a[o] = model.objects[o].file == 0;
    sets.in_b[o] = !sets.in_a[o];
  }
  return sets;
}

std::size_t terminal_width() {
  constexpr std::size_t kDefault = 100, kLeast = 60;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kDefault;
  return std::max<std::size_t>(size.ws_col, kLeast);
}

void count_work(Stats& stats, const clash::Counters& work) {
  stats.count("candidate pairs", work.candidate_pairs);
  stats.count("part pairs", work.part_pairs);
  stats.count("triangle pairs", work.triangle_pairs);
  stats.count("exact fall-backs", work.exact_fallbacks);
  stats.count("depth cells", work.depth_cells);
}

Status write_report(Session& session, const ClashOptions& given, const clash::Report& report,
                    const model::Model& model) {
  for (const std::string& file : given.outputs) {
    const Status status = session.write(file, [&](Session::Sink sink) {
      if (suffix_of(file) == ".csv") {
        report::write_clash_csv(report, model, sink);
      } else {
        report::write_clash_json(report, model, sink);
      }
    });
    if (!status) return status;
  }
  if (session.json())
    return session.write_stdout(
        [&](Session::Sink sink) { report::write_clash_json(report, model, sink); });
  return session.write_stdout(report::clash_table(report, model, {.width = terminal_width()}));
}

bool fails(const clash::Report& report, const std::string& fail_on) {
  if (fail_on == "hit") return report.count_hit > 0;
  if (fail_on == "contact") return report.count_hit + report.count_contact > 0;
  if (fail_on == "clearance_violation") return !report.pairs.empty();
  return false;
}

Result<ExitCode> run_clash(Session& session, const ClashOptions& given) {
  const Result<clash::Options> options = engine_options(given);
  if (!options) return options.error();
  const auto scene_settings = scene_options(given.scene, clash::scene_options(*options).sag_mm);
  if (!scene_settings) return scene_settings.error();
  if (const Status status = check_outputs(given.outputs, {".json", ".csv"}, given.input.files);
      !status)
    return status.error();
  const Result<Loaded> loaded = load(session, given.input, *scene_settings);
  if (!loaded) return loaded.error();
  const model::Model& model = *loaded->model;
  const model::Scene& scene = loaded->scene;
  Result<clash::Report> report = [&] {
    const auto timer = session.step("clash");
    return clash::detect(scene, sets_of(model, given.self), *options, session.context());
  }();
  if (!report) return report.error();
  tell(session.console(), report->diagnostics);
  count_work(session.stats(), report->counters);
  if (const Status status = write_report(session, given, *report, model); !status)
    return status.error();
  if (fails(*report, given.fail_on)) return ExitCode::clashes;
  if (given.input.strict && report->diagnostics.skipped() > 0) return ExitCode::partial;
  return outcome(given.input, *loaded);
}

void add_rules(CLI::App& command, ClashOptions& options) {
  const auto length = [&](const char* name, std::string& value, const char* help) {
    command.add_option(name, value, help)->type_name("LENGTH")->group("Rules");
  };
  length("--clearance", options.clearance, "Pairs nearer than this violate it (default 0)");
  length("--touch-gap", options.touch_gap, "Up to this far apart is a contact (default 1mm)");
  length("--touch-overlap", options.touch_overlap, "Up to this deep is a contact (default 1mm)");
  length("--contact-distance", options.contact_distance,
         "Nearer than this counts as touching in the relation of a pair (default: from the "
         "precision of the files)");
  add_choice(command, "--thickness-cap", options.thickness_cap, {"on", "off"},
             "Allow no more overlap than a quarter of the thinner part (default on)")
      ->group("Rules");
  add_choice(command, "--fail-on", options.fail_on, {"hit", "contact", "clearance_violation"},
             "Exit code 1 where a pair is of this class or worse")
      ->group("Rules");
}

}  // namespace

Verb add_clash(CLI::App& program, CommonOptions& common) {
  const auto options = std::make_shared<ClashOptions>();
  CLI::App* const command = program.add_subcommand(
      "clash", "Clashes, contacts and clearance violations of models, with exact distances");
  add_input_options(*command, options->input);
  add_scene_options(*command, options->scene, "a quarter of the touch tolerances");
  add_rules(*command, *options);
  command->add_flag("--self", options->self, "Several files: pairs within one file too")
      ->group("Rules");
  add_choice(*command, "--broad-phase", options->broad_phase, {"tree", "all-pairs"},
             "How near pairs are found; the result is the same (default tree)")
      ->group("Running");
  add_output_option(*command, options->outputs, "Result as .json or .csv; may be repeated");
  add_common_options(*command, common);
  command->footer(R"(
One file is checked against itself, several each against the others.

Examples:
  strake clash ship.glb
  strake clash hvac.rvm steel.rvm --clearance 25mm -o clashes.json
  strake clash hvac.rvm steel.rvm --touch-gap 0 --touch-overlap 0 --fail-on hit --json)");
  return {command, [options](Session& session) { return run_clash(session, *options); }};
}

}  // namespace strake::cli
