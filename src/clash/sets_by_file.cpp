// SPDX-License-Identifier: Apache-2.0
#include "clash/sets_by_file.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace strake::clash {

namespace {

/// Returns a file as a selection names it: always quoted, so that no letter of the label is a
/// pattern's.
std::string file_selection(const std::string& label) {
  std::string text = "file = '";
  for (const char c : label) {
    if (c == '*' || c == '?' || c == '[' || c == '\\') text += '\\';
    if (c == '\'') text += '\'';
    text += c;
  }
  return text + "'";
}

}  // namespace

Sets sets_by_file(const model::Model& model) {
  const std::size_t n = model.objects.size();
  Sets sets;
  sets.in_a.assign(n, true);
  sets.in_b.assign(n, true);
  if (model.files.size() < 2) return sets;
  if (model.files.size() > 2) {
    for (const model::Object& object : model.objects) sets.group.push_back(object.file);
    for (const model::SourceFile& file : model.files)
      sets.group_names.push_back(Hasher().add(std::string_view(file.label)).value());
    sets.name_b = "* of another file";
    return sets;
  }
  for (std::size_t o = 0; o < n; ++o) {
    sets.in_a[o] = model.objects[o].file == 0;
    sets.in_b[o] = !sets.in_a[o];
  }
  sets.name_a = file_selection(model.files[0].label);
  sets.name_b = file_selection(model.files[1].label);
  return sets;
}

}  // namespace strake::clash
