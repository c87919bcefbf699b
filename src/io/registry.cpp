// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/importer/find_importer.hpp"
#include "io/importer/importing_reader.hpp"
#include "io/importer/map_place.hpp"
#include "io/read_file.hpp"
#include "io/source/input_file.hpp"
#include "io/source/reader_support.hpp"
#include "strake/io/importer.hpp"
#include "strake/io/reader.hpp"

namespace strake::io {
namespace {

using Readers = std::vector<std::unique_ptr<Reader>>;

/// Returns the readers that need no other program.
Readers own_readers() {
  Readers readers;
  readers.push_back(make_rvm_reader());
  readers.push_back(make_gltf_reader());
  readers.push_back(make_obj_reader());
  readers.push_back(make_stl_reader());
  readers.push_back(make_ply_reader());
  return readers;
}

/// Returns the reader that is surest; `last` reads where no other is as sure.
const Reader* best_reader(const Readers& readers, const FileBytes& file, const Reader& last) {
  int sureness = last.recognise(file);
  const Reader* best = sureness > 0 ? &last : nullptr;
  for (const std::unique_ptr<Reader>& reader : readers) {
    const int mine = reader->recognise(file);
    if (mine < sureness || mine == 0 || (mine == sureness && best != &last)) continue;
    best = reader.get();
    sureness = mine;
  }
  return best;
}

/// Returns how a file of that suffix is made into one that is read; empty where it has none.
std::string conversion_of(std::string_view suffix) {
  constexpr std::array<std::string_view, 2> kMesh{"fbx", "dae"};
  std::string advice = "; export the model as one of these";
  if (suffix == "brep") advice = "; open it in a CAD program, as FreeCAD, and export it as glTF";
  if (std::ranges::find(kMesh, suffix) != kMesh.end())
    advice = "; open it in Blender and export it as glTF";
  if (suffix.empty()) return advice;
  return advice.append("; a program strake-import-")
      .append(suffix)
      .append(" in PATH would be taken, too");
}

Error unknown_format(const Readers& readers, const FileBytes& file) {
  if (std::optional<Error> missing = missing_importer(file)) return std::move(*missing);
  std::string formats;
  for (std::size_t r = 0; r < readers.size(); ++r) {
    const std::string_view format = readers[r]->format();
    formats.append(r == 0                    ? ""
                   : r + 1 == readers.size() ? " and "
                                             : ", ")
        .append(format == "glTF" ? "glTF/GLB" : format);
  }
  return {ErrorCode::input, "unsupported format", file.path.string(),
          "Strake reads " + formats + conversion_of(importer_suffix(file.path))};
}

/// Reads the files of one call.
class Reading {
 public:
  Reading(const Result<ImportSettings>& settings, const parallel::Context& context)
      : importing_(settings), context_(context) {}

  /// Has importers make what they read, several at once. That a file cannot be read is reported
  /// when it is its turn.
  Status make_scenes(std::span<const FileToRead> files);
  Result<model::Model> read(std::span<const FileToRead> files);
  /// Reads one file, and tells nothing of its place.
  Result<ReadFile> read_alone(const FileToRead& file);
  /// Returns the error of the first file that has no scene and should.
  [[nodiscard]] Status scene_faults() const;

 private:
  Result<ImportedModel> read_one(const FileToRead& file);
  [[nodiscard]] const Reader* reader_of(const FileBytes& file) const {
    return best_reader(readers_, file, importing_);
  }

  const Readers readers_ = own_readers();
  const ImportingReader importing_;
  const parallel::Context& context_;
  std::vector<SceneJob> jobs_;
  ImportedScenes scenes_;
};

Status Reading::make_scenes(std::span<const FileToRead> files) {
  for (const auto& [path, options] : files) {
    if (!may_need_importer(path)) continue;
    if (context_.stop.stop_requested())
      return Error{ErrorCode::cancelled, "reading was cancelled", path.string(), ""};
    const Result<FileContent> content = FileContent::read(path, context_);
    if (!content || content->bytes().empty()) continue;
    const FileBytes file{path, content->bytes()};
    if (reader_of(file) != &importing_) continue;
    if (std::optional<SceneJob> job = importing_.maker().job_of(file))
      jobs_.push_back(std::move(*job));
  }
  scenes_ = importing_.maker().make_all(jobs_, context_);
  return {};
}

Status Reading::scene_faults() const {
  for (const SceneJob& job : jobs_)
    if (const auto& scene = scenes_.at(job.key); !scene) return scene.error();
  return {};
}

Result<ImportedModel> Reading::read_one(const FileToRead& to_read) {
  const auto& [path, options] = to_read;
  const Result<FileContent> content = FileContent::read(path, context_);
  if (!content) return content.error();
  const FileBytes file{path, content->bytes()};
  if (file.bytes.empty())
    return Error{ErrorCode::input, "is empty", path.string(), "export the model again"};
  const Reader* const reader = reader_of(file);
  if (reader == nullptr) return unknown_format(readers_, file);
  try {
    if (reader == &importing_) return importing_.read_with(file, options, scenes_, context_);
    Result<model::Model> read = reader->read(file, options, context_);
    if (!read) return read.error();
    return ImportedModel{std::move(*read), {}};
  } catch (const std::length_error&) {
    return Error{ErrorCode::input, "is too large", path.string(), "split the file"};
  }
}

Result<model::Model> Reading::read(std::span<const FileToRead> files) {
  model::Model all;
  // Diagnostics are reported in the order of the files' names, whatever the order in which they
  // were given.
  std::map<std::pair<std::string, std::string>, Diagnostics> diagnostics;
  std::vector<FilePlace> places;
  bool keeps_scenes = true, on_map = false;
  for (const FileToRead& file : files) {
    const std::filesystem::path& path = file.path;
    if (context_.stop.stop_requested())
      return Error{ErrorCode::cancelled, "reading was cancelled", path.string(), ""};
    Result<ImportedModel> read = read_one(file);
    if (!read) return read.error();
    model::Model& one = read->model;
    places.push_back({path.string(), std::move(read->map)});
    on_map = on_map || file.options.on_map;
    // That is of the run and not of a file, and said once.
    if (one.diagnostics.count(kSceneNotKept) > 0 && !std::exchange(keeps_scenes, false))
      one.diagnostics.remove(kSceneNotKept);
    diagnostics[{path.filename().string(), path.string()}].append(
        std::exchange(one.diagnostics, Diagnostics()));
    model::append(all, std::move(one));
  }
  for (const auto& [name, of_file] : diagnostics) all.diagnostics.append(of_file);
  std::ranges::sort(places, {}, &FilePlace::file);
  all.diagnostics.append(place_diagnostics(places, on_map));
  if (const Status finished = model::finish(all, context_); !finished) return finished.error();
  return all;
}

Result<ReadFile> Reading::read_alone(const FileToRead& file) {
  Result<ImportedModel> read = read_one(file);
  if (!read) return read.error();
  if (const Status finished = model::finish(read->model, context_); !finished)
    return finished.error();
  return ReadFile{std::move(read->model), std::move(read->map)};
}

/// Has files read that are given as they should be: `read` takes a Reading.
template <class Read>
std::invoke_result_t<Read, Reading&> read_by(const Result<ImportSettings>& settings,
                                             std::span<const FileToRead> files,
                                             const parallel::Context& context, Read&& read) {
  if (files.empty())
    return Error{ErrorCode::usage, "no model file was given", "", "name at least one file"};
  for (const FileToRead& file : files)
    if (const auto& unit = file.options.unit_mm; unit && !(*unit > 0 && *unit < 1e12))
      return Error{ErrorCode::usage, "the length of a unit must be positive and finite", "",
                   "give a unit such as mm, m or in"};
  try {
    Reading reading(settings, context);
    if (const Status made = reading.make_scenes(files); !made) return made.error();
    return read(reading);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

}  // namespace

Result<model::Model> read_models(std::span<const FileToRead> files,
                                 const parallel::Context& context) {
  return read_by(import_settings_of_environment(), files, context,
                 [&](Reading& reading) { return reading.read(files); });
}

Result<model::Model> read_models(std::span<const FileToRead> files, const ImportSettings& settings,
                                 const parallel::Context& context) {
  return read_by(settings, files, context, [&](Reading& reading) { return reading.read(files); });
}

Result<ReadFile> read_file(const FileToRead& file, const Result<ImportSettings>& settings,
                           const parallel::Context& context) {
  return read_by(settings, {&file, 1}, context,
                 [&](Reading& reading) { return reading.read_alone(file); });
}

Status make_scenes(std::span<const FileToRead> files, const parallel::Context& context) {
  const Result<ImportSettings> settings = import_settings_of_environment();
  if (!settings || !settings->cache) return {};
  try {
    Reading reading(settings, context);
    if (Status made = reading.make_scenes(files); !made) return made;
    return reading.scene_faults();
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

Result<model::Model> read_models(std::span<const std::filesystem::path> paths,
                                 const ReadOptions& options, const parallel::Context& context) {
  std::vector<FileToRead> files;
  files.reserve(paths.size());
  for (const std::filesystem::path& path : paths) files.push_back({path, options});
  return read_models(files, context);
}

std::vector<std::filesystem::path> Reader::companions(const FileBytes& /*file*/,
                                                      const parallel::Context& /*context*/) const {
  return {};
}

std::vector<std::filesystem::path> files_read_with(const FileBytes& file,
                                                   const parallel::Context& context) {
  const Readers readers = own_readers();
  const ImportingReader importing(import_settings_of_environment());
  const Reader* const reader = best_reader(readers, file, importing);
  return reader == nullptr ? std::vector<std::filesystem::path>()
                           : reader->companions(file, context);
}

std::vector<std::unique_ptr<Reader>> all_readers() {
  Readers readers = own_readers();
  readers.push_back(std::make_unique<ImportingReader>(import_settings_of_environment()));
  return readers;
}

}  // namespace strake::io
