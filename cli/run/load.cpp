// SPDX-License-Identifier: Apache-2.0
#include "cli/run/load.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/run/file_settings.hpp"
#include "cli/run/project_input.hpp"
#include "core/text_encoding.hpp"
#include "core/units.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/project/project.hpp"

namespace strake::cli {

namespace {

using geometry::Box3d;
using geometry::Vec3d;

/// Two units that are taken for each other: files in them, read as if in one unit, differ by the
/// factor.
struct UnitConfusion {
  double factor;
  std::string_view small, large;
  double alike;  ///< extents may differ by this factor besides
};

/// Factors of 10 and 12 are left out: parts that are so much larger than others are common. A cube
/// or a plate that is 25 or 40 times as large is so, too: inches have to be distinguished from
/// those by a hundredth.
constexpr double kAlike = 1.12, kSame = 1.01;
constexpr std::array<UnitConfusion, 4> kUnitConfusions{{{1000, "m", "mm", kAlike},
                                                        {25.4, "in", "mm", kSame},
                                                        {39.3701, "m", "in", kSame},
                                                        {304.8, "ft", "mm", kAlike}}};

/// Whether `large` is larger than `small`, both in grid units, by the factor along all three axes,
/// and along two at least by extents that the grid has not made of nothing: two parts seldom are
/// alike along all axes, and objects in a row often are.
bool is_alike(const Vec3d& small, const Vec3d& large, const UnitConfusion& confusion) {
  constexpr double kSignificant = 8;
  const auto& [factor, small_unit, large_unit, alike] = confusion;
  int significant_axes = 0;
  for (int k = 0; k < 3; ++k) {
    // The grid moves each of two ends by half a unit.
    if (large[k] > (small[k] + 1) * factor * alike || large[k] < (small[k] - 1) * factor / alike)
      return false;
    if (small[k] >= kSignificant) ++significant_axes;
  }
  return significant_axes >= 2;
}

/// How the unit of a file is known: neither it nor anybody states it; its format does, by which
/// programs that write it do not always go; somebody does.
enum class UnitSource : std::uint8_t { assumed, stated, given };

struct FileExtent {
  std::size_t file;
  Vec3d size;
  std::string_view unit;
  UnitSource source;
};

/// Splits "mm (assumed)".
FileExtent extent_of(std::size_t file, const Vec3d& size, std::string_view unit) {
  const std::size_t end = unit.find(" (");
  const UnitSource source = unit.ends_with("(assumed)") ? UnitSource::assumed
                            : unit.ends_with("(given)") ? UnitSource::given
                                                        : UnitSource::stated;
  return {file, size, unit.substr(0, end), source};
}

/// Whether there is no reason to doubt the units of two files: somebody has said one of them, and
/// the other is not just assumed.
bool are_trusted(const FileExtent& x, const FileExtent& y) {
  const bool assumed = x.source == UnitSource::assumed || y.source == UnitSource::assumed;
  return !assumed && (x.source == UnitSource::given || y.source == UnitSource::given);
}

/// Returns the extents of the files of which anything is placed.
Result<std::vector<FileExtent>> extents(const model::Scene& scene,
                                        const parallel::Context& context) {
  const std::vector<model::SourceFile>& files = scene.model->files;
  using Boxes = std::vector<Box3d>;
  // Each block has boxes of its own, so that there are few, and long ones.
  constexpr std::size_t kMinGrain = 4096, kMaxBlocks = 64;
  const std::size_t bodies = scene.bodies.size();
  const auto boxes = parallel::reduce(
      context,
      {.name = "extents of files",
       .n = bodies,
       .grain = std::max(kMinGrain, (bodies + kMaxBlocks - 1) / kMaxBlocks)},
      Boxes(files.size(), geometry::empty_box<double>()),
      [&](Boxes& of_block, std::size_t i) {
        const model::GridBody& body = scene.bodies[i];
        of_block[scene.model->object(body.object).file].include(
            body.box(scene.shapes[body.grid_shape]).as<double>());
      },
      [](Boxes& into, const Boxes& of_block) {
        for (std::size_t f = 0; f < into.size(); ++f) into[f].include(of_block[f]);
      });
  if (!boxes) return boxes.error();
  std::vector<FileExtent> found;
  for (std::size_t f = 0; f < files.size(); ++f) {
    const Box3d& box = (*boxes)[f];
    if (!box.empty()) found.push_back(extent_of(f, box.hi - box.lo, files[f].unit));
  }
  return found;
}

/// Whether the files are alike when y and z may change places, as one file may have another up
/// axis.
bool is_alike_in_any_frame(const FileExtent& small, const FileExtent& large,
                           const UnitConfusion& confusion) {
  const Vec3d& s = small.size;
  return is_alike(s, large.size, confusion) || is_alike({s.x, s.z, s.y}, large.size, confusion);
}

/// Returns what to advise for the two files: never another unit for one that is known, if that of
/// the other is assumed. Where the formats of both state it, the large one is more likely wrong, as
/// a glTF file in millimetres: nobody models in units larger than a metre.
std::string options_to_try(const FileExtent& small, const FileExtent& large,
                           const UnitConfusion& confusion,
                           const std::vector<model::SourceFile>& files) {
  const auto option = [&](const FileExtent& of, std::string_view unit) {
    return fmt::format("--unit '{}={}'", files[of.file].label, unit);
  };
  const auto& [factor, small_unit, large_unit, alike] = confusion;
  const bool small_assumed = small.source == UnitSource::assumed;
  if (small_assumed && large.source == UnitSource::assumed)
    return option(small, small_unit) + ' ' + option(large, large_unit);
  if (small_assumed) return option(small, small.unit == large_unit ? small_unit : "UNIT");
  return option(large, large.unit == small_unit ? large_unit : "UNIT");
}

}  // namespace

Status note_doubtful_units(model::Scene& scene, const parallel::Context& context) {
  const std::vector<model::SourceFile>& files = scene.model->files;
  if (files.size() < 2) return {};
  const Result<std::vector<FileExtent>> found = extents(scene, context);
  if (!found) return found.error();
  for (const FileExtent& large : *found)
    for (const FileExtent& small : *found) {
      if (are_trusted(large, small)) continue;
      for (const UnitConfusion& confusion : kUnitConfusions)
        if (is_alike_in_any_frame(small, large, confusion))
          scene.diagnostics.add(
              Severity::warning, "unit-doubtful",
              fmt::format("is about {:g} times as large as {}: where that is the factor between "
                          "their units, say {}",
                          confusion.factor, files[small.file].label,
                          options_to_try(small, large, confusion, files)),
              files[large.file].label);
    }
  return {};
}

namespace {

/// Finest sag: corners closer than the grid's spacing cannot be distinguished.
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
  if (const Status status = length_option(options.sag_mm, input.sag, "--sag"); !status)
    return status.error();
  if (options.sag_mm < kFinestSagMm)
    return Error{ErrorCode::usage, "'" + input.sag + "' is finer than the grid of 1um", "--sag",
                 "write 1um or more, as 0.5mm"};
  return options;
}

void print_diagnostics(Console& console, const Diagnostics& diagnostics,
                       std::initializer_list<std::string_view> each) {
  const auto words = [](const Diagnostic& d) {
    return fmt::format(": {}{}{}", d.where, d.where.empty() ? "" : ": ", d.message);
  };
  const auto& kept = diagnostics.kept();
  for (const Diagnostics::Count& count : diagnostics.counts()) {
    std::string line = fmt::format("{} {}", severity_name(count.severity), count.code);
    if (std::find(each.begin(), each.end(), count.code) != each.end()) {
      for (const Diagnostic& d : kept)
        if (d.code == count.code) console.note(line + words(d));
      if (count.count > Diagnostics::kMaxPerCode)
        console.note(line + fmt::format(", {} in all", count.count));
      continue;
    }
    if (count.count > 1) line += fmt::format(", first of {}", count.count);
    const auto first = std::find_if(kept.begin(), kept.end(),
                                    [&](const Diagnostic& d) { return d.code == count.code; });
    if (first != kept.end()) line += words(*first);
    console.note(line);
  }
}

namespace {

/// Warns of files that are given more than once: each of their objects is there as often, lies in
/// itself and clashes with itself.
void note_repeated_files(model::Model& model, const std::vector<std::string>& files) {
  std::map<std::filesystem::path, std::string> known;  // the first name of each
  for (const std::string& file : files) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::canonical(file, error);
    if (error) continue;
    const auto [first, is_new] = known.try_emplace(path, file);
    if (!is_new)
      model.diagnostics.add(Severity::warning, "file-given-twice",
                            first->second == file
                                ? "is given more than once: each of its objects is there as often"
                                : "is the file " + in_quotes(first->second) +
                                      " as well: each of its objects is there more than once",
                            file);
  }
}

/// Files of the command line by what they are.
struct InputFiles {
  std::vector<io::FileToRead> models;
  std::vector<std::filesystem::path> projects;
};

/// Errors: usage where something is said of a project that has been said of its files.
Result<InputFiles> input_files(const InputOptions& input) {
  Result<std::vector<io::FileToRead>> files = files_to_read(input);
  if (!files) return files.error();
  InputFiles found;
  for (io::FileToRead& file : *files) {
    if (!project::is_project(file.path)) {
      found.models.push_back(std::move(file));
      continue;
    }
    if (file.options.on_map)
      return Error{ErrorCode::usage,
                   file.path.string() + " is a project: its files were read already",
                   "--georeference", "leave the option out, or name the files"};
    if (file.options.unit_mm || file.options.up_axis)
      return Error{ErrorCode::usage,
                   file.path.string() + " is a project: it knows this of its files",
                   file.options.unit_mm ? "--unit" : "--up-axis",
                   "leave the option out, or write it for one model file, as part.stl=...; "
                   "'strake project update' reads files of a project otherwise"};
    found.projects.push_back(std::move(file.path));
  }
  return found;
}

/// Reads model files and takes models out of projects, as one model; tells which `sources` it has.
Result<model::Model> join_inputs(Session& session, const InputFiles& files,
                                 std::span<const rules::FileSettings> file_settings,
                                 std::vector<std::filesystem::path>& sources) {
  std::vector<model::Model> models;
  for (const std::filesystem::path& file : files.projects) {
    if (const Status status = session.files().add_project(file); !status) return status.error();
    Result<project::Project> project = project::Project::open(file, {});
    if (!project) return project.error();
    if (const Status status = add_model_files(session, *project); !status) return status.error();
    Result<std::vector<std::filesystem::path>> of_project =
        model_files(*project, file.string(), file_settings);
    if (!of_project) return of_project.error();
    sources.insert(sources.end(), of_project->begin(), of_project->end());
    Result<model::Model> model = project_model(session, *project);
    if (!model) return model;
    models.push_back(std::move(*model));
  }
  for (const io::FileToRead& file : files.models) {
    if (const Status status = session.files().add_model(file.path, session.context()); !status)
      return status.error();
    sources.push_back(file.path);
  }
  if (!files.models.empty() || models.empty()) {
    Result<model::Model> model = io::read_models(files.models, session.context());
    if (!model || models.empty()) return model;
    models.push_back(std::move(*model));
  }
  return models.size() == 1 ? std::move(models.front()) : model::join(models);
}

Result<model::Model> read_model(Session& session, const InputOptions& input,
                                std::span<const rules::FileSettings> file_settings,
                                std::vector<std::filesystem::path>& sources) {
  Result<InputFiles> files = input_files(input);
  if (!files) return files.error();
  apply_file_settings(file_settings, files->models);
  const auto timer = session.step("load");
  Result<model::Model> model = join_inputs(session, *files, file_settings, sources);
  if (!model) return model;
  note_repeated_files(*model, input.files);
  print_model_notes(session, *model);
  return model;
}

Result<model::Scene> place_model(Session& session, const model::Model& model,
                                 const model::SceneOptions& options) {
  const auto timer = session.step("place");
  Result<model::Scene> scene = model::make_scene(model, options, session.context());
  if (!scene) return scene;
  if (const Status status = note_doubtful_units(*scene, session.context()); !status)
    return status.error();
  print_diagnostics(session.console(), scene->diagnostics);
  if (scene->left_out > 0)
    session.console().note(fmt::format(
        "left out {} bodies of obstructions and insulation (--obstructions, --insulation)",
        scene->left_out));
  return scene;
}

}  // namespace

Diagnostics LoadedModel::diagnostics() const {
  Diagnostics all = model->diagnostics;
  all.append(scene.diagnostics);
  return all;
}

void print_model_notes(Session& session, const model::Model& model) {
  for (std::uint32_t f = 0; f < model.files.size(); ++f) {
    const model::SourceFile& file = model.files[f];
    const auto objects = std::ranges::equal_range(model.objects, f, {}, &model::Object::file);
    session.console().note(fmt::format("{}: {}, {} objects, unit {}, {} up", file.label,
                                       file.format, objects.size(), file.unit, file.up_axis));
  }
  print_diagnostics(session.console(), model.diagnostics);
  if (const std::string rest = unread_rest(model); !rest.empty())
    session.console().warn(fmt::format("nothing is known of {}", rest));
}

Result<model::Model> load_model(Session& session, const InputOptions& input) {
  std::vector<std::filesystem::path> sources;
  return read_model(session, input, {}, sources);
}

Result<LoadedModel> place(Session& session, model::Model model,
                          const model::SceneOptions& options) {
  LoadedModel loaded;
  loaded.model = std::shared_ptr<model::Model>(
      std::make_unique<model::Model>(std::move(model)).release(),
      [context = parallel::Context{.team = session.context().team}](model::Model* done) {
        model::clear(*done, context);
        std::default_delete<model::Model>()(done);
      });
  Result<model::Scene> scene = place_model(session, *loaded.model, options);
  if (!scene) return scene.error();
  loaded.scene = std::move(*scene);
  return loaded;
}

Result<LoadedModel> load(Session& session, const InputOptions& input,
                         const model::SceneOptions& options,
                         std::span<const rules::FileSettings> file_settings) {
  std::vector<std::filesystem::path> sources;
  Result<model::Model> model = read_model(session, input, file_settings, sources);
  if (!model) return model.error();
  Result<LoadedModel> loaded = place(session, std::move(*model), options);
  if (loaded) loaded->files = std::move(sources);
  return loaded;
}

ExitCode strict_exit_code(const InputOptions& input, const Diagnostics& diagnostics) {
  return input.strict && diagnostics.skipped() > 0 ? ExitCode::partial : ExitCode::done;
}

ExitCode strict_exit_code(const InputOptions& input, const LoadedModel& loaded) {
  return strict_exit_code(input, loaded.diagnostics());
}

}  // namespace strake::cli
