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
  // Names with blanks are common, lists of names as well: the whole line is a name if such a file
  // exists.
  const std::optional<std::filesystem::path> whole = safe_relative_path(obj_path, names);
  std::error_code failed;
  const bool single = names.find_first_of(" \t") == std::string_view::npos ||
                      (whole && std::filesystem::is_regular_file(*whole, failed));
  if (single) return load_library(names, obj_path, materials, diagnostics);
  while (!names.empty()) {
    const std::size_t length = std::min(names.find_first_of(" \t"), names.size());
    load_library(names.substr(0, length), obj_path, materials, diagnostics);
    names = trimmed(names.substr(length), kBlanks);
  }
}

}  // namespace strake::io::obj
