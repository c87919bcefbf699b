// SPDX-License-Identifier: Apache-2.0
#include "report/clash/clash_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "report/files/match_documents.hpp"
#include "report/files/sort_unique.hpp"
#include "strake/core/hash.hpp"
#include "strake/report/clash_diff.hpp"

namespace strake::report {
namespace {

/// Points and depths are compared as multiples of this, in millimetres: another export may round
/// them otherwise.
constexpr double kPlaceMm = 0.01;

using Contents = std::map<std::string_view, FileContents>;

bool has_element(const ClashDocument& run, std::string_view label, std::string_view id) {
  return std::ranges::binary_search(run.elements, clash::element_hash(label, id));
}

void add_ids(const ClashDocument& run, Contents& contents) {
  for (const DocumentObject& o : run.objects)
    if (!is_positional(run, clash::element_hash(o.file, o.id)))
      contents[o.file].ids.emplace_back(o.id);
}

/// Returns the hash of a result as something that lies in the file of one of its objects.
Hash128 place_of(const ClashDocument& run, const DocumentResult& r, const DocumentObject& object) {
  Hasher hasher;
  hasher.add(std::string_view(run.tests[r.test].name)).add(static_cast<std::uint32_t>(r.cls));
  hasher.add(std::string_view(without_numbers(object.name)));
  for (const double mm : {r.point_mm.x, r.point_mm.y, r.point_mm.z, r.d_mm})
    hasher.add(std::round(mm / kPlaceMm));
  return hasher.value();
}

void add_places(const ClashDocument& run, Contents& contents) {
  for (const DocumentResult& r : run.results)
    for (const DocumentObject* const o : {&run.a(r), &run.b(r)})
      contents[o->file].places.push_back(place_of(run, r, *o));
}

/// Returns the labels of the files of a run.
std::vector<std::string> labels_of(const ClashDocument& run) {
  std::vector<std::string> labels = run.files;
  for (const DocumentObject& o : run.objects)
    if (labels.empty() || labels.back() != o.file) labels.emplace_back(o.file);
  sort_unique(labels);
  return labels;
}

/// Returns the files of a run; with `contents`, what the run holds of them.
RunFiles files_of(const ClashDocument& run, const std::vector<std::string>& labels,
                  bool with_contents) {
  Contents contents;
  if (with_contents) {
    add_ids(run, contents);
    add_places(run, contents);
  }
  RunFiles files;
  files.has = [&run](std::string_view label, std::string_view id) {
    return has_element(run, label, id);
  };
  for (const std::string& label : labels) {
    FileContents& file = files.files.emplace_back(std::move(contents[label]));
    file.label = label;
    sort_unique(file.ids);
    std::ranges::sort(file.places);
  }
  return files;
}

}  // namespace

bool is_positional(const ClashDocument& run, std::uint64_t element) {
  const auto at = std::ranges::lower_bound(run.elements, element);
  if (run.positional_ids.empty() || at == run.elements.end() || *at != element) return false;
  const auto i = static_cast<std::size_t>(at - run.elements.begin());
  return ((run.positional_ids[i / 8] >> (i % 8)) & 1U) != 0;
}

std::string without_numbers(std::string_view name) {
  std::string text;
  for (const char c : name) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit || text.empty() || text.back() != '0') text += digit ? '0' : c;
  }
  return text;
}

FileMap map_of(const FileMatches& files, const ClashDocument& before, const ClashDocument& after) {
  const auto has = [](const ClashDocument& run) {
    return
        [&run](std::string_view label, std::string_view id) { return has_element(run, label, id); };
  };
  return {files, has(before), has(after)};
}

Result<FileMatches> match_files(const ClashDocument& before, const ClashDocument& after,
                                std::span<const std::string> given_pairs) {
  return match_documents(before, after, given_pairs, labels_of, files_of);
}

}  // namespace strake::report
