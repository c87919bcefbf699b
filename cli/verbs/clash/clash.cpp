// SPDX-License-Identifier: Apache-2.0
#include "strake/clash/clash.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clash/rules/tolerance_lengths.hpp"
#include "cli/run/file_settings.hpp"
#include "cli/run/load.hpp"
#include "cli/verbs/clash/clash_decisions.hpp"
#include "cli/verbs/clash/clash_groups.hpp"
#include "cli/verbs/clash/clash_hint.hpp"
#include "cli/verbs/clash/clash_output.hpp"
#include "cli/verbs/clash/clash_profile.hpp"
#include "cli/verbs/clash/clash_project.hpp"
#include "cli/verbs/clash/clash_result.hpp"
#include "cli/verbs/clash/clash_sets.hpp"
#include "cli/verbs/clash/pictures/picture_folder.hpp"
#include "cli/verbs/verb.hpp"
#include "core/output_format.hpp"
#include "publish/clash_formats.hpp"
#include "rules/clearances.hpp"
#include "strake/report/clash.hpp"
#include "strake/rules/rules.hpp"

namespace strake::cli {

namespace {

struct ClashOptions {
  InputOptions input;
  SceneInput scene;
  SetInput sets;
  std::array<std::string, clash::kToleranceLengths.size()> tolerances;
  std::string contact_distance;
  std::string broad_phase, narrow_phase, thickness_cap, contacts, fail_on, max_pairs, max_spheres,
      rules, profile;
  bool list_exempted = false, curves = false;
  ClashResultInput result;
  ClashOutputInput output;
  DecisionInput decisions;
  ClashProjectInput project;
  PictureInput pictures;
  std::vector<std::string> outputs;
};

Result<clash::EngineOptions> engine_options(const ClashOptions& given) {
  clash::EngineOptions engine;
  if (const Status status = whole_number(engine.max_pairs, given.max_pairs, "--max-pairs"); !status)
    return status.error();
  if (const Status status = whole_number(engine.max_spheres, given.max_spheres, "--max-spheres");
      !status)
    return status.error();
  if (const Status status = whole_number(engine.max_regions, given.result.regions, "--regions");
      !status)
    return status.error();
  if (given.broad_phase == "all-pairs") engine.broad_phase = clash::BroadPhase::all_pairs;
  if (given.narrow_phase == "sphere-subdivision")
    engine.narrow_phase = clash::NarrowPhase::sphere_subdivision;
  if (given.result.wants_volumes()) engine.volumes = clash::Volumes::on;
  if (given.curves) engine.curves = clash::Curves::on;
  if (given.contacts == "count") engine.contacts = clash::Contacts::count;
  return engine;
}

/// The test of the command line. What objects add to its clearance is read from the model.
struct OnlyTest {
  clash::Options options;
  std::string clearance_attribute;  ///< empty: nothing
};

/// Parses one of the lengths of a test; a clearance may name an attribute.
Status tolerance_option(OnlyTest& test, const clash::ToleranceLength& length,
                        const std::string& text) {
  const std::string option = "--" + length.name_with('-');
  double& value = test.options.tolerances.*length.value_mm;
  if (length.value_mm != &clash::Tolerances::clearance_mm || text.find('@') == std::string::npos)
    return length_option(value, text, option);
  Result<rules::WrittenClearance> written = rules::parse_clearance(text);
  if (!written) {
    Error error = written.error();
    error.where = option;
    return error;
  }
  value = written->mm;
  test.clearance_attribute = std::move(written->attribute);
  return {};
}

Result<OnlyTest> only_test(const ClashOptions& given) {
  OnlyTest test;
  clash::Options& options = test.options;
  for (std::size_t i = 0; i < given.tolerances.size(); ++i)
    if (const Status status =
            tolerance_option(test, clash::kToleranceLengths[i], given.tolerances[i]);
        !status)
      return status.error();
  if (const Status status =
          length_option(options.contact_distance_mm, given.contact_distance, "--contact-distance");
      !status)
    return status.error();
  if (given.thickness_cap == "off") options.tolerances.thickness_cap = clash::ThicknessCap::off;
  const Result<clash::EngineOptions> engine = engine_options(given);
  if (!engine) return engine.error();
  options.engine = *engine;
  return test;
}

Status write_files(Session& session, const ClashOptions& given,
                   const report::ClashContents& contents) {
  for (const std::string& file : given.outputs) {
    const Result<report::ClashWriter> writer = publish::find_clash_writer(file);
    if (!writer) return writer.error();
    const Status status = session.write(
        file, [&](Session::Sink sink) { return writer->write(contents, sink, session.context()); });
    if (!status) return status;
    report_left_out(session.console(), file, contents);
  }
  if (given.result.log_pairs.empty()) return {};
  return session.write(given.result.log_pairs, [&](Session::Sink sink) {
    return report::write_pair_log(contents, sink, session.context());
  });
}

Status write_result(Session& session, const ClashOptions& given,
                    const report::ClashContents& contents,
                    const std::optional<std::uint64_t>& rows) {
  if (session.json())
    return session.write_stdout([&](Session::Sink sink) {
      return report::write_clash_json(contents, sink, session.context());
    });
  report::TableOptions table{.width = terminal_width(), .sort = sort_by(given.result.sort)};
  if (rows) table.rows = static_cast<std::size_t>(*rows);
  return session.write_stdout(report::clash_table(contents, table));
}

/// What is to be done, parsed before a model is read.
struct ClashRequest {
  OnlyTest test;  ///< with rules, what they leave open
  SetRequest sets;
  std::optional<rules::Rules> rules;    ///< they have the tests, too
  std::optional<rules::Rules> profile;  ///< rules for the test of the command line
  model::SceneOptions scene;
  ClashOutput output;
  std::optional<DecisionRequest> decisions;
  double deeper_mm = report::DecisionRules{}.deeper_mm;  ///< for the decisions of a project
};

/// Returns what the rules say of files.
std::span<const rules::FileSettings> files_of(const ClashRequest& request) {
  return request.rules ? request.rules->files() : std::span<const rules::FileSettings>();
}

/// Returns what the run writes.
WrittenFiles written_files(const ClashOptions& given, bool json) {
  WrittenFiles files{.attributes = json,
                     .pair_log = !given.result.log_pairs.empty(),
                     .decisions = given.decisions.write,
                     .table = !json};
  for (const std::string& file : given.outputs) {
    files.csv = files.csv || suffix_of(file) == ".csv";
    // What has no format is reported where its name is looked at.
    const Result<report::ClashWriter> writer = publish::find_clash_writer(file);
    files.attributes = files.attributes || (writer && writer->attributes);
    files.bcf = files.bcf || is_bcf(file);
    files.page = files.page || suffix_of(file) == ".html";
  }
  return files;
}

Result<ClashRequest> request_of(const ClashOptions& given, bool json) {
  ClashRequest request;
  Result<OnlyTest> test = only_test(given);
  if (!test) return test.error();
  request.test = std::move(*test);
  Result<SetRequest> sets = set_request(given.sets);
  if (!sets) return sets.error();
  request.sets = std::move(*sets);
  if (!given.rules.empty()) {
    Result<rules::Rules> read = rules::Rules::read(given.rules);
    if (!read) return read.error();
    request.rules = std::move(*read);
  }
  Result<std::optional<rules::Rules>> profile = profile_rules(given.profile);
  if (!profile) return profile.error();
  request.profile = std::move(*profile);
  if (given.list_exempted && !request.rules && !request.profile)
    return Error{ErrorCode::usage, "there are no rules that exempt", "--list-exempted",
                 "add --rules or --profile"};
  model::SceneOptions wanted =
      request.rules ? request.rules->scene_options() : clash::scene_options(request.test.options);
  if (request.profile) {
    wanted.obstruction = request.profile->scene_options().obstruction;
    wanted.insulation = request.profile->scene_options().insulation;
  }
  const Result<model::SceneOptions> scene = scene_options(given.scene, wanted.sag_mm);
  if (!scene) return scene.error();
  request.scene = *scene;
  request.scene.obstruction = scene->obstruction || wanted.obstruction;
  request.scene.insulation = scene->insulation || wanted.insulation;
  Result<ClashOutput> output = clash_output(given.output, written_files(given, json));
  if (!output) return output.error();
  request.output = std::move(*output);
  Result<std::optional<DecisionRequest>> decisions = decision_request(given.decisions);
  if (!decisions) return decisions.error();
  request.decisions = std::move(*decisions);
  if (const Status status = length_option(request.deeper_mm, given.decisions.deeper, "--deeper");
      !status)
    return status.error();
  if (!given.decisions.deeper.empty() && !request.decisions && !given.project.is_given())
    return Error{ErrorCode::usage, "there are no decisions", "--deeper",
                 "add --decisions FILE or -p PROJECT"};
  return request;
}

/// Returns the tests of the rules file, or the one that the command line requests.
Result<rules::Plan> plan_of(Session& session, const LoadedModel& loaded,
                            const ClashRequest& request) {
  const auto timer = session.step("select");
  if (request.rules) {
    Result<rules::Plan> plan = request.rules->plan(loaded.scene, session.context());
    if (!plan) return plan;
    for (rules::PlannedTest& test : plan->tests) test.options.engine = request.test.options.engine;
    return plan;
  }
  Result<ChosenSets> chosen = choose_sets(session, loaded, request.sets);
  if (!chosen) return chosen.error();
  rules::PlannedTest test{{}, request.test.options, std::move(chosen->sets), {}};
  if (const std::string& attribute = request.test.clearance_attribute; !attribute.empty())
    test.options.tolerances.object_clearances =
        rules::object_clearances(*loaded.model, attribute, "--clearance", chosen->diagnostics);
  rules::Plan plan{{std::move(test)}, std::move(chosen->diagnostics)};
  if (request.profile)
    if (const Status applied =
            apply_profile(*request.profile, loaded.scene, session.context(), plan);
        !applied)
      return applied.error();
  return plan;
}

Result<clash::Findings> find(Session& session, const LoadedModel& loaded, rules::Plan plan,
                             bool list_exempted) {
  clash::Findings findings;
  findings.diagnostics = std::move(plan.diagnostics);
  for (rules::PlannedTest& test : plan.tests) {
    const auto timer = session.step(test.name.empty() ? "clash" : "clash " + test.name);
    test.policy.list_exempted = list_exempted;
    Result<clash::Report> report =
        clash::detect(loaded.scene, test.sets, test.options, test.policy, session.context());
    if (!report) return report.error();
    report->name = test.name;
    findings.tests.push_back(std::move(*report));
  }
  findings.diagnostics.append(rules::idle_rules(plan, findings.tests));
  return findings;
}

/// `project` is null where files are tested.
Result<clash::Findings> findings_of(Session& session, const LoadedModel& loaded,
                                    const ClashRequest& request, bool list_exempted,
                                    ProjectClashes* project) {
  Result<rules::Plan> plan = plan_of(session, loaded, request);
  if (!plan) return plan.error();
  if (project != nullptr) return project->find(session, loaded, std::move(*plan), list_exempted);
  return find(session, loaded, std::move(*plan), list_exempted);
}

/// Makes known to the run all files that options name.
Status name_files(Session& session, const ClashOptions& given) {
  if (const Status status = check_project_options(given.project.project, given.input); !status)
    return status;
  if (given.input.files.empty() && !given.project.is_given())
    return Error{
        ErrorCode::usage, "no model file is given", {}, "'strake clash --help' tells more"};
  if (const Status status = check_pictures(given.pictures); !status) return status;
  RunFiles& files = session.files();
  if (Status status = files.add_inputs(given.input.files); !status) return status;
  if (!given.rules.empty())
    if (Status status = files.add_input(given.rules); !status) return status;
  if (!given.decisions.file.empty() && !given.decisions.write)
    if (Status status = files.add_input(given.decisions.file); !status) return status;
  constexpr std::array<OutputFormat, 1> kTables{{{".csv"}}};
  if (Status status = files.add_outputs(given.outputs, publish::clash_formats()); !status)
    return status;
  if (given.decisions.write)
    if (Status status = files.add_output("--decisions", given.decisions.file, kTables); !status)
      return status;
  if (given.result.log_pairs.empty()) return {};
  return files.add_output("--log-pairs", given.result.log_pairs, kTables);
}

/// Returns an error for options that contradict each other.
Status check_contacts(const ClashOptions& given, const ClashOutput& output) {
  if (!given.result.group_contacts) return {};
  if (given.contacts == "count")
    return Error{ErrorCode::usage, "contacts that are only counted cannot be put into groups",
                 "--group-contacts", "leave out --group-contacts or --contacts count"};
  if (!output.classes.contact)
    return Error{ErrorCode::usage, "contacts that are left out cannot be put into groups",
                 "--group-contacts", "add contact to --class"};
  return {};
}

/// Prints and counts what the tests noticed.
void print_findings(Session& session, const clash::Findings& findings, const model::Model& model) {
  // A rule or a set that does nothing is misspelt more often than meant: each is named.
  print_diagnostics(session.console(), findings.all_diagnostics(),
                    {"rule-matches-nothing", "rule-shadowed", "selection-picks-nothing",
                     "empty-set", "column-not-stated"});
  count_work(session.stats(), findings.tests);
  count_costs(session.stats(), findings, model);
}

/// Returns the rules that a run goes by, if there are any.
std::optional<report::RulesSource> rules_source(const ClashOptions& given,
                                                const ClashRequest& request) {
  if (request.profile)
    return report::RulesSource{request.profile->file(), request.profile->hash(), given.profile};
  if (request.rules) return report::RulesSource{request.rules->file(), request.rules->hash()};
  return std::nullopt;
}

/// Groups and writes what was found, after what is not to be written is taken out of it; `project`
/// is null where files are tested.
Status put_out(Session& session, const ClashOptions& given, const ClashRequest& request,
               const LoadedModel& loaded, const report::DecidedResults* decided,
               clash::Findings& findings, ProjectClashes* project) {
  if (!request.output.classes.all()) report::leave_out_others(findings, request.output.classes);
  const Result<std::optional<clash::Grouping>> grouping =
      group(session, given.result, findings, *loaded.model, decided);
  if (!grouping) return grouping.error();
  const std::optional<report::RulesSource> source = rules_source(given, request);
  const Diagnostics loading = loaded.diagnostics();
  const report::ClashContents contents{findings,
                                       *loaded.model,
                                       *grouping ? &**grouping : nullptr,
                                       source ? &*source : nullptr,
                                       &loading,
                                       request.output.columns,
                                       request.output.csv,
                                       request.output.classes,
                                       decided,
                                       &loaded.scene,
                                       {},
                                       with_run_date(request.output.bcf, project),
                                       request.output.shown};
  if (const Status status = write_files(session, given, contents); !status) return status;
  if (const Status status = write_pictures(session, given.pictures, contents); !status)
    return status;
  // A run whose files cannot be written is found again by the next one. Whoever reads standard
  // output may take long, for which no other program is to wait.
  if (project != nullptr)
    if (const Status status = project->commit(session); !status) return status;
  if (const Status status = write_result(session, given, contents, request.output.rows); !status)
    return status;
  if (!request.decisions) return {};
  return write_decisions(session, given.decisions, *request.decisions, contents);
}

/// Whether contacts are needed one by one, as there are decisions.
bool lists_contacts(const ClashRequest& request) {
  return request.decisions && !request.decisions->file.decisions.empty();
}

/// What a run works with: files, or a project.
struct ClashSource {
  std::optional<ProjectClashes> project;
  LoadedModel loaded;
};

Result<ClashSource> source_of(Session& session, const ClashOptions& given,
                              const ClashRequest& request) {
  if (!given.project.is_given()) {
    Result<LoadedModel> loaded = load(session, given.input, request.scene, files_of(request));
    if (!loaded) return loaded.error();
    return ClashSource{{}, std::move(*loaded)};
  }
  Result<ProjectClashes> project = ProjectClashes::open(session, given.project);
  if (!project) return project.error();
  Result<LoadedModel> loaded = project->load(session, request.scene, files_of(request));
  if (!loaded) return loaded.error();
  return ClashSource{std::move(*project), std::move(*loaded)};
}

/// Looks up what was decided about findings, in a file or in the project, which remembers them.
/// `from_file` holds what a file says.
Result<const report::DecidedResults*> decisions_on_findings(
    Session& session, const ClashOptions& given, const ClashRequest& request, ClashSource& source,
    clash::Findings& findings, std::optional<report::DecidedResults>& from_file) {
  if (source.project) {
    const Status status = source.project->remember(
        session, source.loaded, findings,
        {request.deeper_mm, rules_source(given, request),
         grouping_of(given.result, given.output.classes),
         comments_of_run(given.output.bcf, written_files(given, session.json()).bcf)});
    if (!status) return status.error();
    return source.project->decided();
  }
  Result<std::optional<report::DecidedResults>> found =
      decide(session, given.decisions, request.decisions, findings, *source.loaded.model,
             given.contacts == "count" && lists_contacts(request));
  if (!found) return found.error();
  from_file = std::move(*found);
  const report::DecidedResults* const decided = from_file ? &*from_file : nullptr;
  return decided;
}

Result<ExitCode> run_clash(Session& session, const ClashOptions& given) {
  Result<ClashRequest> request = request_of(given, session.json());
  if (!request) return request.error();
  // A decision may be about a contact: which are only counted is known when they are looked up.
  if (lists_contacts(*request)) request->test.options.engine.contacts = clash::Contacts::list;
  // A project follows what changed, of which no log of all pairs can come.
  request->test.options.engine.log_pairs =
      !given.result.log_pairs.empty() || (session.has_stats_option() && !given.project.is_given());
  if (const Status status = check(given.result); !status) return status.error();
  if (const Status status = check_contacts(given, request->output); !status) return status.error();
  if (const Status status = name_files(session, given); !status) return status.error();
  Result<ClashSource> source = source_of(session, given, *request);
  if (!source) return source.error();
  const LoadedModel& loaded = source->loaded;
  ProjectClashes* const project = source->project ? &*source->project : nullptr;
  Result<clash::Findings> findings =
      findings_of(session, loaded, *request, given.list_exempted, project);
  if (!findings) return findings.error();
  findings->diagnostics.append(idle_file_settings(files_of(*request), loaded.files));
  findings->diagnostics.append(check_columns(request->output.columns, *loaded.model));
  print_findings(session, *findings, *loaded.model);
  std::optional<report::DecidedResults> from_file;
  const Result<const report::DecidedResults*> decided =
      decisions_on_findings(session, given, *request, *source, *findings, from_file);
  if (!decided) return decided.error();
  const FailingPairs failing = failing_pairs(*findings, given.fail_on, *decided);
  if (const Status status = put_out(session, given, *request, loaded, *decided, *findings, project);
      !status)
    return status.error();
  const bool hints = !request->rules && given.profile.empty() && given.result.group_by.empty();
  if (session.console().narrates() && !session.json() && hints && request->output.classes.hit)
    if (const std::string hint = concentration_hint(*findings, *loaded.model, *decided);
        !hint.empty())
      session.console().note(hint);
  const ExitCode code =
      clash_exit_code(*findings, failing, given.fail_on, given.input, loaded, session.console());
  return project != nullptr && project->differs() ? ExitCode::check_failed : code;
}

/// Adds --rules and --profile; this comes after the options that --rules excludes.
void add_rules_file(CLI::App& command, ClashOptions& options) {
  CLI::Option* const rules =
      command
          .add_option("--rules", options.rules,
                      "Tests, exemptions and allowances of a rules file (TOML, docs/rules.md)")
          ->type_name("FILE")
          ->group("Rules");
  for (const clash::ToleranceLength& length : clash::kToleranceLengths)
    rules->excludes(command.get_option("--" + length.name_with('-')));
  for (const char* const name : {"--thickness-cap", "--contact-distance", "--a", "--b", "--self"})
    rules->excludes(command.get_option(name));
  command
      .add_flag("--list-exempted", options.list_exempted,
                "List the pairs that rules exempt, in " +
                    list_suffixes(formats_of(report::clash_writers()), "and"))
      ->group("Rules");
  add_profile_option(command, options.profile);
}

void add_rules(CLI::App& command, ClashOptions& options) {
  const auto add_length = [&](const std::string& name, std::string& value, std::string_view help) {
    command.add_option(name, value, std::string(help))->type_name("LENGTH")->group("Rules");
  };
  for (std::size_t i = 0; i < options.tolerances.size(); ++i) {
    const clash::ToleranceLength& length = clash::kToleranceLengths[i];
    add_length("--" + length.name_with('-'), options.tolerances[i], length.help);
  }
  add_length("--contact-distance", options.contact_distance,
             "Nearer than this counts as touching in the relation of a pair (default: from the "
             "precision of the files)");
  add_choice(command, "--thickness-cap", options.thickness_cap, {"on", "off"},
             "Allow no more overlap than a quarter of the thinner part (default on)")
      ->group("Rules");
  command
      .add_flag("--curves", options.curves,
                "Check lines and polylines too, as bodies without thickness (default: they are "
                "drawn, but never clash)")
      ->group("Rules");
  add_choice(
      command, "--contacts", options.contacts, {"list", "count"},
      "List contacts that lie side by side as other results, or only count them; a contact "
      "that may be something else, or has a row in --decisions, is listed all the same (default "
      "list)")
      ->group("Result");
  add_choice(
      command, "--fail-on", options.fail_on, {"hit", "contact", "clearance_violation"},
      "Exit code 1 where a pair is of this class or worse, or may be: flag UNCERTAIN, or it "
      "could not be compared; where a set is empty, or a file ends early. Objects that could not "
      "be read whole only with --strict")
      ->group("Rules");
}

/// Adds how the engine finds and evaluates pairs, and its limits.
void add_engine_options(CLI::App& command, ClashOptions& options) {
  add_choice(command, "--broad-phase", options.broad_phase, {"tree", "all-pairs"},
             "How near pairs are found; the result is the same (default tree)")
      ->group("Running");
  add_choice(command, "--narrow-phase", options.narrow_phase, {"exact", "sphere-subdivision"},
             "How pairs are evaluated: exactly, or by the baseline that benchmarks compare with "
             "(default exact)")
      ->group("Running");
  command
      .add_option("--max-spheres", options.max_spheres,
                  fmt::format("Spheres that sphere-subdivision tests for one pair of parts before "
                              "it gives up and says so (default {})",
                              clash::EngineOptions{}.max_spheres))
      ->type_name("N")
      ->group("Running");
  add_former_name(command, "--most-spheres", options.max_spheres);
  command
      .add_option("--max-pairs", options.max_pairs,
                  fmt::format("Most pairs of parts that may be within reach of each other, some "
                              "300 bytes each (default {})",
                              clash::EngineOptions{}.max_pairs))
      ->type_name("N")
      ->group("Running");
  add_former_name(command, "--most-pairs", options.max_pairs);
}

}  // namespace

Verb add_clash(CLI::App& program, CommonOptions& common) {
  const auto options = std::make_shared<ClashOptions>();
  CLI::App* const command = program.add_subcommand(
      "clash", "Clashes, contacts and clearance violations of models, with exact distances");
  add_input_options(*command, options->input);
  add_georeference_option(*command, options->input);
  command->get_option("files")->required(false);  // 'strake clash diff' has files of its own
  add_scene_options(*command, options->scene, "a quarter of the touch tolerances");
  add_rules(*command, *options);
  add_set_options(*command, options->sets);
  add_rules_file(*command, *options);
  add_result_options(*command, options->result);
  add_clash_output_options(*command, options->output);
  add_decision_options(*command, options->decisions);
  add_picture_options(*command, options->pictures);
  add_clash_project_options(*command, options->project);
  command->get_option("--project")->excludes(command->get_option("--decisions"));
  add_engine_options(*command, *options);
  add_output_option(*command, options->outputs, "Result", publish::clash_formats());
  add_distribution_option(*command, common);
  add_scheduler_options(*command, common);
  add_common_options(*command, common);
  command->footer(R"(
One file is checked against itself, several each against the others. With --a and --b it is what
they pick, of whatever file; with one of them, everything stands on the other side.
docs/selection.md has the language.

Examples:
  strake clash ship.glb
  strake clash hvac.rvm steel.rvm --clearance 25mm -o clashes.json
  strake clash piping.rvm steel.rvm --clearance '@INSU + 25mm'
  strake clash hvac.rvm steel.rvm --group-by assembly --sort size
  strake clash ship.glb --group-by element --group-distance 3m
  strake clash ship.glb --class hit,clearance --top 50
  strake clash hvac.rvm steel.rvm --columns @Tag,@Area --csv excel-comma -o clashes.csv
  strake clash hvac.rvm steel.rvm --profile plant --group-by assembly
  strake clash ship.glb --class hit --decisions decided.csv --write-decisions --fail-on hit
  strake clash hvac.rvm steel.rvm --group-by element -o clashes.bcf --bcf-max-topics 200
  strake clash ship.glb --group-by proximity --pictures pictures --top-pictures 20
  strake clash ship.glb --log-pairs pairs.csv --stats
  strake clash ship.glb --scheduler tcp://10.0.0.1:8786 --tile-folder /net/tiles -o clashes.json
  strake clash -p ship.strake --rules project.toml --fail-on hit -o today.json
  strake clash set -p ship.strake 0c8x2kq9w3e4r5t6y7v8b9n0mz --status approved --comment 'as agreed'
  strake clash diff monday.json tuesday.json
  strake clash diff ship.strake
  strake clash ship.glb --a 'PIP*' --b 'type = mesh and not PIP*' -o pipes.csv
  strake clash hvac.rvm steel.rvm piping.rvm --rules project.toml --list-exempted -o all.json
  strake clash hvac.rvm steel.rvm --touch-gap 0 --touch-overlap 0 --fail-on hit --json)");
  return {command, [options](Session& session) { return run_clash(session, *options); }};
}

}  // namespace strake::cli
