// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "io/source/input_file.hpp"
#include "io/source/reader_support.hpp"
#include "strake/io/reader.hpp"

namespace strake::io {
namespace {

using Readers = std::vector<std::unique_ptr<Reader>>;

const Reader* best_reader(const Readers& readers, const FileBytes& file) {
  const Reader* best = nullptr;
  int sureness = 0;
  for (const std::unique_ptr<Reader>& reader : readers) {
    const int mine = reader->recognise(file);
    if (mine <= sureness) continue;
    best = reader.get();
    sureness = mine;
  }
  return best;
}

/// Returns how a file of that suffix is made into one that is read.
std::string_view conversion_of(std::string_view suffix) {
  struct Known {
    std::string_view suffix, advice;
  };
  constexpr std::string_view kIfc = "; convert it first: IfcConvert model.ifc model.glb";
  constexpr std::string_view kCad = "; open it in a CAD program, as FreeCAD, and export it as glTF";
  constexpr std::string_view kMesh = "; open it in Blender and export it as glTF";
  constexpr std::array<Known, 11> kKnown{{{".ifc", kIfc},
                                          {".ifczip", kIfc},
                                          {".ifcxml", kIfc},
                                          {".step", kCad},
                                          {".stp", kCad},
                                          {".iges", kCad},
                                          {".igs", kCad},
                                          {".brep", kCad},
                                          {".ply", kMesh},
                                          {".fbx", kMesh},
                                          {".dae", kMesh}}};
  const auto found = std::ranges::find(kKnown, suffix, &Known::suffix);
  return found == kKnown.end() ? std::string_view("; export the model as one of these")
                               : found->advice;
}

Error unknown_format(const Readers& readers, const FileBytes& file) {
  std::string formats;
  for (std::size_t r = 0; r < readers.size(); ++r) {
    const std::string_view format = readers[r]->format();
    formats.append(r == 0                    ? ""
                   : r + 1 == readers.size() ? " and "
                                             : ", ")
        .append(format == "glTF" ? "glTF/GLB" : format);
  }
  return {ErrorCode::input, "unsupported format", file.path.string(),
          "Strake reads " + formats + std::string(conversion_of(lower_extension(file.path)))};
}

Result<model::Model> read_one(const Readers& readers, const std::filesystem::path& path,
                              const ReadOptions& options, const parallel::Context& context) {
  const Result<FileContent> content = FileContent::read(path, context);
  if (!content) return content.error();
  const FileBytes file{path, content->bytes()};
  if (file.bytes.empty())
    return Error{ErrorCode::input, "is empty", path.string(), "export the model again"};
  const Reader* const reader = best_reader(readers, file);
  if (reader == nullptr) return unknown_format(readers, file);
  try {
    return reader->read(file, options, context);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  } catch (const std::length_error&) {
    return Error{ErrorCode::input, "is too large", path.string(), "split the file"};
  }
}

}  // namespace

Result<model::Model> read_models(std::span<const FileToRead> files,
                                 const parallel::Context& context) {
  if (files.empty())
    return Error{ErrorCode::usage, "no model file was given", "", "name at least one file"};
  for (const FileToRead& file : files)
    if (const auto& unit = file.options.unit_mm; unit && !(*unit > 0 && *unit < 1e12))
      return Error{ErrorCode::usage, "the length of a unit must be positive and finite", "",
                   "give a unit such as mm, m or in"};
  const Readers readers = all_readers();
  model::Model all;
  // Diagnostics are reported in the order of the files' names, whatever the order in which they
  // were given.
  std::map<std::pair<std::string, std::string>, Diagnostics> diagnostics;
  for (const auto& [path, options] : files) {
    if (context.stop.stop_requested())
      return Error{ErrorCode::cancelled, "reading was cancelled", path.string(), ""};
    Result<model::Model> one = read_one(readers, path, options, context);
    if (!one) return one.error();
    diagnostics[{path.filename().string(), path.string()}].append(
        std::exchange(one->diagnostics, Diagnostics()));
    model::append(all, std::move(*one));
  }
  for (const auto& [name, of_file] : diagnostics) all.diagnostics.append(of_file);
  model::finish(all);
  return all;
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
  const Readers readers = all_readers();
  const Reader* const reader = best_reader(readers, file);
  return reader == nullptr ? std::vector<std::filesystem::path>()
                           : reader->companions(file, context);
}

std::vector<std::unique_ptr<Reader>> all_readers() {
  std::vector<std::unique_ptr<Reader>> readers;
  readers.push_back(make_rvm_reader());
  readers.push_back(make_gltf_reader());
  readers.push_back(make_obj_reader());
  readers.push_back(make_stl_reader());
  return readers;
}

}  // namespace strake::io
