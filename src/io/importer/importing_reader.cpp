// SPDX-License-Identifier: Apache-2.0
#include "io/importer/importing_reader.hpp"

#include <utility>

#include "core/text_encoding.hpp"
#include "core/units.hpp"
#include "io/gltf/container.hpp"
#include "io/gltf/document.hpp"
#include "io/importer/find_importer.hpp"
#include "io/source/input_file.hpp"
#include "io/source/reader_support.hpp"
#include "io/source/units_and_axes.hpp"

namespace strake::io {
namespace {

namespace fs = std::filesystem;

/// Returns the unit of the file, where its importer says one that is known.
std::optional<double> unit_of_file(const SceneFacts& facts) {
  if (facts.unit.empty()) return std::nullopt;
  const Result<double> unit = parse_unit_mm(facts.unit);
  return unit ? std::optional<double>(*unit) : std::nullopt;
}

double unit_of_scene(const FileBytes& scene, const parallel::Context& context) {
  const FrameDefault frame{1000.0, UpAxis::y, true};
  const Result<gltf::Container> container = gltf::open_container(scene);
  if (!container) return frame.unit_mm;
  const Result<gltf::Document> document = gltf::Document::open(container->json, context);
  return document ? gltf::stated_frame(document->root()).unit_mm : frame.unit_mm;
}

/// Returns the first file that a scene names besides itself; nothing where it holds all that it
/// shows. A scene that is kept would go stale with such a file, and could show any file of the
/// user's.
std::optional<std::string> named_by_scene(const FileBytes& scene,
                                          const parallel::Context& context) {
  const Result<gltf::Container> container = gltf::open_container(scene);
  if (!container || !gltf::may_name_files(*container)) return std::nullopt;
  const Result<gltf::Document> document = gltf::Document::open(container->json, context);
  if (!document) return std::nullopt;
  for (const std::string_view list : {"buffers", "images"})
    for (const gltf::JsonValue& item : document->root()[list].items()) {
      const gltf::JsonValue uri = item["uri"];
      if (!uri.is_string()) continue;
      std::string text = uri.text_value();
      if (!text.starts_with("data:")) return text;
    }
  return std::nullopt;
}

/// Returns the options by which a scene is read as the user says that its file is to be read: a
/// scene has a unit of its own, which is changed by as much as that of the file.
ReadOptions options_of_scene(const FileBytes& scene, const SceneFacts& facts,
                             const ReadOptions& options, const parallel::Context& context) {
  ReadOptions of_scene = options;
  const std::optional<double> unit = unit_of_file(facts);
  if (options.unit_mm && unit)
    of_scene.unit_mm = *options.unit_mm / *unit * unit_of_scene(scene, context);
  return of_scene;
}

/// Adds what the importer noticed before what was noticed in the scene.
void add_diagnostics(const FileBytes& file, const SceneFacts& facts, model::Model& model) {
  Diagnostics all;
  for (Diagnostic one : facts.diagnostics.kept()) {
    one.where = file.path.string() + (one.where.empty() ? "" : ", " + one.where);
    all.add(std::move(one));
  }
  for (const Diagnostics::Count& count : facts.diagnostics.counts())
    if (count.count > Diagnostics::kMaxPerCode)
      all.count_more(count.code, count.count - Diagnostics::kMaxPerCode);
  all.append(model.diagnostics);
  model.diagnostics = std::move(all);
}

/// Makes the model of a scene that of the file which the scene was made of.
void call_by_file(const FileBytes& file, const ReadOptions& options, const ImportedScene& scene,
                  model::Model& model) {
  const SceneFacts& facts = scene.facts.scene;
  model::SourceFile& source = model.files.front();
  source.bytes = file.bytes.size();
  source.format = facts.format;
  if (source.format.empty()) {
    source.format = importer_suffix(file.path);
    for (char& c : source.format)
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  if (const auto unit = unit_of_file(facts))
    source.unit = unit_text(options, {*unit, UpAxis::z, true});
  add_diagnostics(file, facts, model);
  if (scene.trouble)
    model.diagnostics.add(Severity::note, kSceneNotKept,
                          "scenes of importers are not kept for the next run: " + *scene.trouble,
                          {});
}

/// Whether a program is for the suffix of its file, and not for any.
bool is_of_suffix(const ImporterProgram& program) {
  return program.file.filename().string().ends_with("-" + program.suffix);
}

/// Adds to an error of the program that is called for all suffixes what was looked for before it.
Error with_tried_importers(Error error, const ImporterProgram& program) {
  if (error.code != ErrorCode::input || is_of_suffix(program)) return error;
  const std::string called = program.file.filename().string();
  if (!error.mend.empty()) error.mend += "; ";
  error.mend += "Strake itself does not read such files, " + called + "-" + program.suffix +
                " is in none of the folders that are searched, and " + program.file.string() +
                " was asked";
  return error;
}

}  // namespace

bool may_need_importer(const fs::path& file) {
  return !importer_suffixes({file, {}}).empty() || !file.has_extension();
}

ImportingReader::ImportingReader(const Result<ImportSettings>& settings)
    : fault_(settings ? std::nullopt : std::optional<Error>(settings.error())),
      maker_(settings ? *settings : ImportSettings()) {}

int ImportingReader::recognise(const FileBytes& file) const {
  // Less than any reader is whose suffix or content it is, but more than one that knows a word.
  constexpr int kNamed = 15, kMaybe = 1;
  if (fault_) return importer_suffixes(file).empty() ? 0 : kMaybe;
  const std::optional<ImporterProgram> program = find_importer(file, maker_.settings().folders);
  if (!program) return 0;
  return is_of_suffix(*program) ? kNamed : kMaybe;
}

Result<model::Model> ImportingReader::read(const FileBytes& file, const ReadOptions& options,
                                           const parallel::Context& context) const {
  ImportedScenes none;
  Result<ImportedModel> read = read_with(file, options, none, context);
  if (!read) return read.error();
  return std::move(read->model);
}

Result<ImportedModel> ImportingReader::read_with(const FileBytes& file, const ReadOptions& options,
                                                 ImportedScenes& scenes,
                                                 const parallel::Context& context) const {
  if (fault_) return *fault_;
  const std::optional<SceneJob> job = maker_.job_of(file);
  if (!job)
    return Error{ErrorCode::input, "its importer is gone", file.path.string(), "install it again"};
  if (!scenes.contains(job->key)) scenes.merge(maker_.make_all({&*job, 1}, context));
  Result<ImportedScene>& scene = scenes.at(job->key);
  if (!scene) return with_tried_importers(scene.error(), job->program);
  std::optional<Result<ImportedModel>> model = read_scene({file, options, context}, *job, *scene);
  if (model) return std::move(*model);
  // What was kept is damaged, or another run has removed it meanwhile.
  maker_.forget(job->key);
  scenes.erase(job->key);
  scenes.merge(maker_.make_all({&*job, 1}, context));
  Result<ImportedScene>& made = scenes.at(job->key);
  if (!made) return with_tried_importers(made.error(), job->program);
  model = read_scene({file, options, context}, *job, *made);
  if (model) return std::move(*model);
  return Error{ErrorCode::input, "the scene of its importer is lost again and again",
               file.path.string(), "let STRAKE_CACHE name a folder on another disk"};
}

std::optional<Result<ImportedModel>> ImportingReader::read_scene(const gltf::ImportInput& input,
                                                                 const SceneJob& job,
                                                                 const ImportedScene& scene) const {
  const auto& [file, options, context] = input;
  const Result<FileContent> content = FileContent::read(scene.path, context);
  if (!content && (!scene.is_kept || content.error().code != ErrorCode::input))
    return content.error();
  std::optional<std::span<const std::byte>> bytes;
  if (content) bytes = scene.is_kept ? scene_in(content->bytes()) : content->bytes();
  if (!bytes) return std::nullopt;
  const FileBytes scene_bytes{file.path, *bytes};
  const std::string importer = job.program.file.filename().string();
  if (const auto named = named_by_scene(scene_bytes, context)) {
    if (scene.is_kept) maker_.forget(job.key);
    return Error{ErrorCode::input,
                 "the scene that " + importer + " made names the file " + in_quotes(*named) +
                     ": a scene holds all that it shows",
                 file.path.string(), "tell the importer's author of it"};
  }
  Result<model::Model> model = make_gltf_reader()->read(
      scene_bytes, options_of_scene(scene_bytes, scene.facts.scene, options, context), context);
  if (model) {
    call_by_file(file, options, scene, *model);
    const std::optional<MapPlace>& map = scene.facts.scene.map;
    if (options.on_map && map)
      if (const Status put = put_on_map(*map, *model); !put) {
        Error error = put.error();
        error.where = file.path.string();
        return error;
      }
    return ImportedModel{std::move(*model), map};
  }
  if (model.error().code != ErrorCode::input) return model.error();
  if (scene.is_kept) maker_.forget(job.key);
  return Error{ErrorCode::input,
               "the scene that " + importer + " made cannot be read: " + model.error().message,
               model.error().where, "look for a newer version of the importer"};
}

std::optional<Error> missing_importer(const FileBytes& file) {
  const std::vector<std::string> suffixes = importer_suffixes(file);
  const auto is = [&](std::string_view suffix) {
    return !suffixes.empty() && suffixes.front() == suffix;
  };
  if (is("step") || is("stp") || is("iges") || is("igs"))
    return Error{ErrorCode::input,
                 "STEP and IGES files are read by the importer strake-import-step, which is not "
                 "here: './run step' in Strake's sources installs Open CASCADE and builds it",
                 file.path.string(), "or convert it: open it in FreeCAD and export it as glTF"};
  if (!is("ifc") && !is("ifczip") && !is("ifcxml")) return std::nullopt;
  return Error{ErrorCode::input, "IFC files are read by an importer: pip install 'strake[ifc]'",
               file.path.string(), "or convert it: IfcConvert model.ifc model.glb"};
}

}  // namespace strake::io
