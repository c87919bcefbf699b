// SPDX-License-Identifier: Apache-2.0
#include "io/obj/material.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/text_encoding.hpp"
#include "io/source/input_file.hpp"
#include "io/source/text_number.hpp"

namespace strake::io::obj {
namespace {

std::uint8_t to_byte(double share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255));
}

/// Returns the finite numbers at the start of `text`, at most three.
std::vector<double> numbers(std::string_view text) {
  std::vector<double> found;
  DigitStatistics unused;
  const char* at = text.data();
  const char* const end = at + text.size();
  double value = 0;
  for (skip_blanks(at, end); found.size() < 3 && read_number(at, end, value, unused);
       skip_blanks(at, end)) {
    if (!std::isfinite(value)) break;
    found.push_back(value);
  }
  return found;
}

void apply(std::string_view word, std::string_view rest, model::Color& color) {
  if (word != "Kd" && word != "d" && word != "Tr") return;
  const std::vector<double> values = numbers(rest);
  if (values.empty()) return;
  if (word == "d") color.alpha = to_byte(values[0]);
  if (word == "Tr") color.alpha = to_byte(1 - values[0]);
  if (word != "Kd") return;
  color.red = to_byte(values[0]);
  color.green = to_byte(values.size() == 3 ? values[1] : values[0]);
  color.blue = to_byte(values.size() == 3 ? values[2] : values[0]);
}

void load_library(std::string_view name, const std::filesystem::path& obj_path,
                  Materials& materials, Diagnostics& diagnostics) {
  const std::optional<std::filesystem::path> path = safe_relative_path(obj_path, name);
  if (!path) {
    diagnostics.add(Severity::warning, "obj-material-library-refused",
                    "material library '" + std::string(name) +
                        "' lies outside the file's folder and was not read",
                    obj_path.string());
    return;
  }
  const Result<FileContent> content = FileContent::read(*path);
  if (!content) {
    diagnostics.add(Severity::note, "obj-material-library-missing",
                    "material library '" + std::string(name) +
                        "' is not beside the file: its colours are not known",
                    obj_path.string());
    return;
  }
  parse_materials(without_byte_order_mark(as_text(content->bytes())), materials);
}

/// Returns the names on an `mtllib` line. Names with blanks are common, lists of names as well: the
/// whole line is a name if such a file exists.
std::vector<std::string_view> library_names(std::string_view line,
                                            const std::filesystem::path& obj_path) {
  const std::optional<std::filesystem::path> whole = safe_relative_path(obj_path, line);
  std::error_code failed;
  const bool single = line.find_first_of(" \t") == std::string_view::npos ||
                      (whole && std::filesystem::is_regular_file(*whole, failed));
  if (single) return {line};
  std::vector<std::string_view> names;
  while (!line.empty()) {
    const std::size_t length = std::min(line.find_first_of(" \t"), line.size());
    names.push_back(line.substr(0, length));
    line = trimmed(line.substr(length), kBlanks);
  }
  return names;
}

}  // namespace

void parse_materials(std::string_view text, Materials& materials) {
  Materials::iterator current = materials.end();
  while (!text.empty()) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, length), kBlanks);
    text.remove_prefix(std::min(length + 1, text.size()));
    const std::size_t space = std::min(line.find_first_of(" \t"), line.size());
    const std::string_view word = line.substr(0, space),
                           rest = trimmed(line.substr(space), kBlanks);
    if (word == "newmtl") {
      const auto [place, is_new] = materials.try_emplace(std::string(rest));
      current = is_new ? place : materials.end();
    } else if (current != materials.end()) {
      apply(word, rest, current->second);
    }
  }
}

void load_materials(std::string_view names, const std::filesystem::path& obj_path,
                    Materials& materials, Diagnostics& diagnostics) {
  for (const std::string_view name : library_names(names, obj_path))
    load_library(name, obj_path, materials, diagnostics);
}

std::vector<std::filesystem::path> named_libraries(std::string_view text,
                                                   const std::filesystem::path& obj_path) {
  constexpr std::string_view kWord = "mtllib";
  std::vector<std::filesystem::path> found;
  for (std::size_t at = text.find(kWord); at != std::string_view::npos;
       at = text.find(kWord, at + 1)) {
    const std::string_view rest = text.substr(at + kWord.size());
    const std::string_view names = trimmed(rest.substr(0, rest.find('\n')), kBlanks);
    for (const std::string_view name : library_names(names, obj_path))
      if (const auto path = safe_relative_path(obj_path, name)) found.push_back(*path);
  }
  return found;
}

}  // namespace strake::io::obj
