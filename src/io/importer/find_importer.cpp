// SPDX-License-Identifier: Apache-2.0
#include "io/importer/find_importer.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <system_error>
#include <utility>

#include "io/source/input_file.hpp"
#include "io/source/reader_support.hpp"

namespace strake::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kProgram = "strake-import";

/// Suffixes that our own readers know: a file with one of them that they do not take is damaged.
constexpr std::array<std::string_view, 8> kOwn{"rvm", "rev", "rvs", "gltf",
                                               "glb", "obj", "stl", "ply"};

bool is_suffix(std::string_view text) {
  constexpr std::size_t kLongest = 12;
  return !text.empty() && text.size() <= kLongest && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
  });
}

/// Returns which format a STEP file is by its schema, which its head names: IFC is one of them.
std::string_view step_suffix(std::span<const std::byte> bytes) {
  constexpr std::size_t kHead = std::size_t{1} << 16U;
  const std::string_view text = without_byte_order_mark(as_text(bytes)).substr(0, kHead);
  if (!text.starts_with("ISO-10303-21;")) return {};
  const std::size_t schema = text.find("FILE_SCHEMA");
  if (schema == std::string_view::npos) return {};
  const std::string_view name = text.substr(schema, text.find(';', schema) - schema);
  return name.find("'IFC") == std::string_view::npos ? "step" : "ifc";
}

bool is_program(const fs::path& file) {
  std::error_code failed;
  return fs::is_regular_file(file, failed) && ::access(file.c_str(), X_OK) == 0;
}

std::optional<fs::path> find_program(std::string_view name, std::span<const fs::path> folders) {
  for (const fs::path& folder : folders)
    if (fs::path file = folder / name; is_program(file)) return file;
  return std::nullopt;
}

}  // namespace

std::string importer_suffix(const fs::path& file) {
  const std::string extension = lower_extension(file);
  const std::string suffix = extension.empty() ? extension : extension.substr(1);
  return is_suffix(suffix) ? suffix : std::string();
}

std::vector<std::string> importer_suffixes(const FileBytes& file) {
  const std::string named = importer_suffix(file.path);
  if (std::ranges::find(kOwn, named) != kOwn.end()) return {};
  std::vector<std::string> suffixes;
  const std::string_view known = step_suffix(file.bytes);
  if (known == "ifc") suffixes.emplace_back(known);
  if (!named.empty() && named != known) suffixes.push_back(named);
  if (known == "step") suffixes.emplace_back(known);
  return suffixes;
}

std::optional<ImporterProgram> find_importer(const FileBytes& file,
                                             std::span<const fs::path> folders) {
  const std::vector<std::string> suffixes = importer_suffixes(file);
  for (const std::string& suffix : suffixes)
    if (auto program = find_program(std::string(kProgram) + '-' + suffix, folders))
      return ImporterProgram{std::move(*program), suffix};
  if (suffixes.empty()) return std::nullopt;
  if (auto program = find_program(kProgram, folders))
    return ImporterProgram{std::move(*program), suffixes.front()};
  return std::nullopt;
}

fs::path program_for_several(const ImporterProgram& importer) {
  // No suffix has a hyphen in it, so that no file is read by this name.
  const std::string one = std::string(kProgram) + '-';
  const std::string name = importer.file.filename().string();
  if (!name.starts_with(one)) return {};
  const fs::path several = importer.file.parent_path() / (one + "many-" + name.substr(one.size()));
  return is_program(several) ? several : fs::path();
}

std::vector<ImporterProgram> all_importers(std::span<const fs::path> folders) {
  std::map<std::string, fs::path> found;
  const std::string prefix = std::string(kProgram) + '-';
  for (const fs::path& folder : folders) {
    std::error_code failed;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end;
         at.increment(failed)) {
      const std::string name = at->path().filename().string();
      if (!name.starts_with(prefix)) continue;
      const std::string suffix = name.substr(prefix.size());
      if (is_suffix(suffix) && is_program(at->path())) found.try_emplace(suffix, at->path());
    }
  }
  std::vector<ImporterProgram> importers;
  for (auto& [suffix, file] : found) importers.push_back({std::move(file), suffix});
  if (auto program = find_program(kProgram, folders))
    importers.push_back({std::move(*program), {}});
  return importers;
}

}  // namespace strake::io
