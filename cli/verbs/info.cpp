// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cli/output/diagnostics_json.hpp"
#include "cli/output/object_list.hpp"
#include "cli/run/load.hpp"
#include "cli/run/project_input.hpp"
#include "cli/verbs/verb.hpp"
#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "io/importer/find_importer.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/io/importer.hpp"

namespace strake::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kInfoSagMm = 0.5;
constexpr int kSchemaVersion = 1;

/// The content of one file, or of all of them.
struct ModelContent {
  std::uint64_t objects = 0, bodies = 0, shapes = 0;
  std::map<std::string, std::uint64_t> primitives;  ///< bodies by the kind of their shape
  std::uint64_t triangles = 0, solids = 0, sheets = 0, wires = 0, inverted = 0;
  geometry::Box3l extents = geometry::empty_box<std::int64_t>();
};

void count_placed(ModelContent& content, const model::Scene& scene, model::ObjectId id) {
  for (const model::GridBody& body : scene.bodies_of(id)) {
    const model::GridShape& shape = scene.shapes[body.grid_shape];
    if (!shape.box.empty()) content.extents.include(body.box(shape));
    for (const geometry::Part& part : shape.parts) {
      content.triangles += part.triangles.size();
      content.inverted += part.flags.inverted ? 1U : 0U;
      switch (part.kind) {
        case geometry::PartKind::solid:
          ++content.solids;
          break;
        case geometry::PartKind::sheet:
          ++content.sheets;
          break;
        case geometry::PartKind::wire:
          ++content.wires;
          break;
      }
    }
  }
}

/// Returns the content of the files with `from` <= number < `to`.
ModelContent content_of(const model::Model& model, const model::Scene& scene, std::size_t from,
                        std::size_t to) {
  ModelContent content;
  std::vector<bool> used(model.shapes.size());
  for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
    const model::Object& object = model.objects[o];
    if (object.file < from || object.file >= to) continue;
    ++content.objects;
    content.bodies += object.body_count;
    for (std::uint32_t b = 0; b < object.body_count; ++b) {
      const std::uint32_t shape = model::index(model.bodies[object.first_body + b].shape);
      ++content.primitives[std::string(model::kind_name(model.shapes[shape]))];
      content.shapes += used[shape] ? 0U : 1U;
      used[shape] = true;
    }
    count_placed(content, scene, model::ObjectId{o});
  }
  return content;
}

Json vector_json(const geometry::Vec3l& grid) {
  const geometry::Vec3d mm = geometry::to_mm(grid);
  return Json::array({mm.x, mm.y, mm.z});
}

Json content_json(const ModelContent& content) {
  Json extents;  // null where nothing was placed
  if (!content.extents.empty())
    extents = {{"lo", vector_json(content.extents.lo)}, {"hi", vector_json(content.extents.hi)}};
  return {{"objects", content.objects},     {"bodies", content.bodies},
          {"shapes", content.shapes},       {"primitives", content.primitives},
          {"triangles", content.triangles}, {"solids", content.solids},
          {"sheets", content.sheets},       {"wires", content.wires},
          {"inverted", content.inverted},   {"extents_mm", extents}};
}

/// What is listed besides the counts.
struct RequestedLists {
  std::optional<std::uint64_t> objects;  ///< the first so many
  bool attributes = false;
};

std::string info_json(const model::Model& model, const model::Scene& scene,
                      const RequestedLists& lists) {
  Json files = Json::array();
  for (std::size_t f = 0; f < model.files.size(); ++f) {
    const model::SourceFile& file = model.files[f];
    Json entry{{"file", file.label},
               {"format", file.format},
               {"unit", file.unit},
               {"up_axis", file.up_axis},
               {"bytes", file.bytes}};
    if (file.ends_early) entry["ends_early"] = true;
    entry.update(content_json(content_of(model, scene, f, f + 1)));
    if (lists.attributes) entry["attributes"] = attribute_list_json(model, f);
    files.push_back(std::move(entry));
  }
  Json counts = Json::array(), messages = Json::array();
  add_diagnostics(counts, messages, model.diagnostics);
  add_diagnostics(counts, messages, scene.diagnostics);
  Json all{{"schema_version", kSchemaVersion},
           {"files", std::move(files)},
           {"total", content_json(content_of(model, scene, 0, model.files.size()))},
           {"left_out", scene.left_out},
           {"skipped", model.diagnostics.skipped() + scene.diagnostics.skipped()},
           {"diagnostics", std::move(counts)},
           {"messages", std::move(messages)}};
  if (lists.objects) all["objects"] = object_list_json(model, *lists.objects);
  // Names come from files and may be no UTF-8: a replacement character is better than no answer.
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string extents_text(const geometry::Box3l& box) {
  if (box.empty()) return "nothing placed";
  const geometry::Vec3d lo = geometry::to_mm(box.lo), hi = geometry::to_mm(box.hi);
  const auto range = [](double from, double to) { return fixed(from, 1) + " .. " + fixed(to, 1); };
  return fmt::format("x {}, y {}, z {} mm", range(lo.x, hi.x), range(lo.y, hi.y),
                     range(lo.z, hi.z));
}

std::string content_text(const ModelContent& content) {
  std::string kinds;
  for (const auto& [kind, count] : content.primitives)
    kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, kind);
  return fmt::format(
      "  objects     {}\n  bodies      {} of {} shapes: {}\n"
      "  parts       {} solids, {} sheets, {} wires; {} inside out\n"
      "  triangles   {}\n  extents     {}\n",
      content.objects, content.bodies, content.shapes, kinds.empty() ? "none" : kinds,
      content.solids, content.sheets, content.wires, content.inverted, content.triangles,
      extents_text(content.extents));
}

std::string info_text(const model::Model& model, const model::Scene& scene,
                      const RequestedLists& lists) {
  std::string out;
  for (std::size_t f = 0; f < model.files.size(); ++f) {
    const model::SourceFile& file = model.files[f];
    out += fmt::format("{}\n  format      {}, {} bytes, unit {}, {} up\n", printable(file.label),
                       file.format, file.bytes, file.unit, file.up_axis);
    out += content_text(content_of(model, scene, f, f + 1));
    if (lists.attributes) out += attribute_list_text(model, f);
  }
  if (model.files.size() > 1)
    out += "all files\n" + content_text(content_of(model, scene, 0, model.files.size()));
  out +=
      fmt::format("skipped       {}\n", model.diagnostics.skipped() + scene.diagnostics.skipped());
  for (const Diagnostics* const diagnostics : {&model.diagnostics, &scene.diagnostics})
    for (const Diagnostics::Count& count : diagnostics->counts())
      out +=
          fmt::format("  {:<8} {:>8} {}\n", severity_name(count.severity), count.count, count.code);
  if (lists.objects) out += object_list_text(model, *lists.objects);
  return out;
}

/// Returns the formats that are read, and by which programs.
std::string formats_text() {
  std::string text =
      "RVM          .rvm, binary and text, with attribute files\n"
      "glTF 2.0     .glb, .gltf\n"
      "OBJ          .obj, with materials\n"
      "STL          .stl, binary and text\n"
      "PLY          .ply, binary and text";
  const Result<io::ImportSettings> settings = io::import_settings_of_environment();
  const std::vector<io::ImporterProgram> importers =
      settings ? io::all_importers(settings->folders) : std::vector<io::ImporterProgram>();
  for (const io::ImporterProgram& importer : importers) {
    text += importer.suffix.empty()
                ? fmt::format("\n{:<13}by importers of Python packages that {} knows", "others",
                              importer.file.string())
                : fmt::format("\n{:<13}by {}", '.' + importer.suffix, importer.file.string());
  }
  if (importers.empty())
    text +=
        "\nNo importer is found; that of IFC: pip install 'strake[ifc]', that of STEP and IGES: "
        "./run step";
  return text;
}

struct InfoOptions {
  InputOptions input;
  ProjectOptions project;
  SceneInput scene;
  std::string objects;
  bool attributes = false;
};

/// Loads the files, or the project of -p.
Result<LoadedModel> load_input(Session& session, const InfoOptions& options,
                               const model::SceneOptions& scene) {
  if (const Status s = check_project_options(options.project, options.input); !s) return s.error();
  if (options.project.file.empty() && options.input.files.empty())
    return Error{ErrorCode::usage, "no model file is given", {}, "'strake info --help' tells more"};
  if (options.project.file.empty()) return load(session, options.input, scene);
  Result<OpenedProject> opened = open_project(session, options.project, project::Access::read);
  if (!opened) return opened.error();
  return load_project(session, *opened, scene);
}

Result<ExitCode> run_info(Session& session, const InfoOptions& options) {
  const Result<model::SceneOptions> scene_settings = scene_options(options.scene, kInfoSagMm);
  if (!scene_settings) return scene_settings.error();
  RequestedLists lists{{}, options.attributes};
  if (!options.objects.empty())
    if (const Status s = whole_number(lists.objects.emplace(), options.objects, "--objects"); !s)
      return s.error();
  const Result<LoadedModel> loaded = load_input(session, options, *scene_settings);
  if (!loaded) return loaded.error();
  const model::Model& model = *loaded->model;
  const model::Scene& scene = loaded->scene;
  const Status written = session.write_stdout(session.json() ? info_json(model, scene, lists)
                                                             : info_text(model, scene, lists));
  if (!written) return written.error();
  return strict_exit_code(options.input, *loaded);
}

}  // namespace

Verb add_info(CLI::App& program, CommonOptions& common) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* const command =
      program.add_subcommand("info", "What model files hold, and what was skipped and why");
  add_input_options(*command, options->input);
  add_georeference_option(*command, options->input);
  command->get_option("files")->required(false);  // a project may stand in their place
  add_project_option(*command, options->project.file,
                     "Read the model of this project (docs/project.md), in place of files");
  add_scene_options(*command, options->scene, "0.5mm");
  command
      ->add_option(
          "--objects", options->objects,
          "List the first N objects with what selections go by: name, id, path, file, type, "
          "category, colour and attributes")
      ->type_name("N");
  command->add_flag("--attributes", options->attributes,
                    "List the attributes of each file: how many objects state or inherit them, how "
                    "many different values there are, and the first of these");
  // As --version does, it needs no files.
  command->set_version_flag(
      "--formats", formats_text,
      "Print the formats that are read, with the importers that are found, and end");
  add_common_options(*command, common);
  command->footer(R"(
Examples:
  strake info platform.rvm
  strake info platform.rvm --attributes
  strake info platform.rvm --objects 20
  strake info -p ship.strake
  strake info hvac.rvm steel.glb --json)");
  return {command, [options](Session& session) { return run_info(session, *options); }};
}

}  // namespace strake::cli
