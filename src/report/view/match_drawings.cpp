// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "report/files/match_documents.hpp"
#include "strake/core/hash.hpp"
#include "strake/report/view_diff.hpp"

namespace strake::report {
namespace {

constexpr std::array kLists{&ViewDocument::objects, &ViewDocument::far_objects};

/// Returns the hash of where a piece lies, whichever end comes first.
Hash128 place_of(const ViewPiece& piece) {
  auto ends = std::pair(piece.a, piece.b);
  const auto coordinates = [](const geometry::Vec3l& p) { return std::tuple(p.x, p.y, p.z); };
  if (coordinates(ends.second) < coordinates(ends.first)) std::swap(ends.first, ends.second);
  Hasher hasher;
  for (const geometry::Vec3l& end : {ends.first, ends.second})
    for (int k = 0; k < 3; ++k) hasher.add(static_cast<std::int64_t>(end[k]));
  return hasher.value();
}

std::vector<std::string> labels_of_drawing(const ViewDocument& drawing) {
  std::vector<std::string> labels;
  for (const auto list : kLists)
    for (const ViewObject& o : drawing.*list)
      if (labels.empty() || labels.back() != o.file) labels.push_back(o.file);
  std::ranges::sort(labels);
  const auto rest = std::ranges::unique(labels);
  labels.erase(rest.begin(), rest.end());
  return labels;
}

/// Returns the files of a drawing; with `contents`, what it holds of them.
RunFiles files_of_drawing(const ViewDocument& drawing, const std::vector<std::string>& labels,
                          bool with_contents) {
  std::map<std::string_view, FileContents> contents;
  if (with_contents) {
    for (const auto list : kLists)
      for (const ViewObject& o : drawing.*list) contents[o.file].ids.push_back(o.id);
    for (const ViewPiece& piece : drawing.pieces)
      contents[drawing.objects[piece.object].file].places.push_back(place_of(piece));
  }
  RunFiles files;
  for (const std::string& label : labels) {
    FileContents& file = files.files.emplace_back(std::move(contents[label]));
    file.label = label;
    std::ranges::sort(file.ids);
    std::ranges::sort(file.places);
  }
  return files;
}

}  // namespace

Result<FileMatches> match_files(const ViewDocument& before, const ViewDocument& after,
                                std::span<const std::string> given_pairs) {
  return match_documents(before, after, given_pairs, labels_of_drawing, files_of_drawing);
}

}  // namespace strake::report
