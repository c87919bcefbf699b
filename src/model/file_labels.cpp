// SPDX-License-Identifier: Apache-2.0
#include "model/file_labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "core/seeded_hash.hpp"

namespace strake::model {
namespace {

using Order = std::vector<std::uint32_t>;

/// Returns the shortest end of `path`, cut before a folder and not shorter than `least`, that none
/// of the other paths ends in; the whole path where they all end in it.
std::string_view distinguishing_end(std::string_view path, std::size_t least,
                                    std::span<const std::string> others) {
  for (std::size_t begin = path.size() - least; begin > 0;) {
    const std::string_view end = path.substr(begin);
    const auto ends_so = [&](const std::string& other) {
      return other != path && other.ends_with(end) &&
             (other.size() == end.size() || other[other.size() - end.size() - 1] == '/');
    };
    if (std::ranges::none_of(others, ends_so)) return end;
    const std::size_t slash = begin < 2 ? std::string_view::npos : path.rfind('/', begin - 2);
    begin = slash == std::string_view::npos ? 0 : slash + 1;
  }
  return path;
}

/// Puts folders before labels that several files have.
void add_folders(std::vector<SourceFile>& files) {
  std::map<std::string, Order> of_label;
  for (std::uint32_t f = 0; f < files.size(); ++f) of_label[files[f].label].push_back(f);
  for (const auto& [label, same] : of_label) {
    if (same.size() < 2) continue;
    std::vector<std::string> paths;
    for (const std::uint32_t f : same) paths.push_back(files[f].folders + label);
    for (std::size_t i = 0; i < same.size(); ++i)
      files[same[i]].label = distinguishing_end(paths[i], label.size(), paths);
  }
}

/// Returns the ids of the objects of each file whose label another has, in the order of the source:
/// they distinguish such files.
std::vector<std::vector<std::string_view>> ids_of_namesakes(const Model& model) {
  std::map<std::string_view, std::size_t> of_label;
  for (const SourceFile& file : model.files) ++of_label[file.label];
  std::vector<std::vector<std::string_view>> ids(model.files.size());
  if (of_label.size() == model.files.size()) return ids;
  for (const Object& o : model.objects)
    if (o.file < ids.size() && of_label[model.files[o.file].label] > 1)
      ids[o.file].emplace_back(o.id);
  return ids;
}

Order sorted_files(const Model& model) {
  const std::vector<std::vector<std::string_view>> ids = ids_of_namesakes(model);
  const auto key = [&](std::uint32_t i) {
    const SourceFile& f = model.files[i];
    return std::tie(f.label, ids[i], f.format, f.unit, f.up_axis, f.bytes);
  };
  Order order(model.files.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto p = key(a), q = key(b);
    return p != q ? p < q : a < b;
  });
  return order;
}

/// Gives every repetition of a label a number; files are sorted.
void add_numbers(std::vector<SourceFile>& files) {
  std::unordered_set<std::string, SeededHash> taken;
  for (const SourceFile& f : files) taken.insert(f.label);
  std::string previous;
  std::uint32_t repeat = 1;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (i == 0 || files[i].label != previous) {
      previous = files[i].label;
      repeat = 1;
      continue;
    }
    std::string label;
    do label = fmt::format("{}#{}", previous, ++repeat);
    while (!taken.insert(label).second);
    files[i].label = std::move(label);
  }
}

}  // namespace

std::vector<std::uint32_t> label_and_sort_files(Model& model) {
  add_folders(model.files);
  const Order order = sorted_files(model);
  std::vector<SourceFile> files;
  Order renumbered(order.size());
  for (const std::uint32_t old : order) {
    renumbered[old] = static_cast<std::uint32_t>(files.size());
    files.push_back(std::move(model.files[old]));
  }
  add_numbers(files);
  model.files = std::move(files);
  return renumbered;
}

}  // namespace strake::model
