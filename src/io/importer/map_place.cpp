// SPDX-License-Identifier: Apache-2.0
#include "io/importer/map_place.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/text_encoding.hpp"

namespace strake::io {

std::optional<MapPlace> map_place_in(const gltf::JsonValue& value) {
  constexpr std::size_t kNumbers = 16;
  const std::vector<gltf::JsonValue> items = value["matrix"].items();
  if (!value["crs"].is_string() || items.size() != kNumbers) return std::nullopt;
  std::array<double, kNumbers> m{};
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const std::optional<double> number = items[i].number();
    if (!number || !std::isfinite(*number)) return std::nullopt;
    m.at(i) = *number;
  }
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) return std::nullopt;
  MapPlace place;
  place.crs = printable(value["crs"].text_value());
  for (std::size_t row = 0; row < 3; ++row)
    place.to_map.linear.row[row] = {m.at(row), m.at(4 + row), m.at(8 + row)};
  place.to_map.translation = {m[12], m[13], m[14]};
  if (!(place.to_map.linear.determinant() > 0)) return std::nullopt;
  return place;
}

std::array<double, 16> matrix_of(const geometry::Placement& placement) {
  std::array<double, 16> m{};
  for (int row = 0; row < 3; ++row) {
    const auto r = static_cast<std::size_t>(row);
    for (int k = 0; k < 3; ++k)
      m.at(4 * static_cast<std::size_t>(k) + r) = placement.linear.row[r][k];
    m.at(12 + r) = placement.translation[row];
  }
  m[15] = 1;
  return m;
}

Status put_on_map(const MapPlace& place, model::Model& model) {
  for (model::Body& body : model.bodies) {
    body.placement = place.to_map * body.placement;
    if (!geometry::is_finite(body.placement))
      return Error{ErrorCode::input,
                   "lies beyond all bounds on the map",
                   {},
                   "read it in its own coordinates"};
  }
  return {};
}

namespace {

bool are_same(const MapPlace& x, const MapPlace& y) {
  return x.crs == y.crs && matrix_of(x.to_map) == matrix_of(y.to_map);
}

}  // namespace

Diagnostics place_diagnostics(const std::vector<FilePlace>& files, bool on_map) {
  Diagnostics diagnostics;
  const auto first =
      std::ranges::find_if(files, [](const FilePlace& f) { return f.place.has_value(); });
  if (first == files.end()) {
    if (on_map)
      for (const FilePlace& file : files)
        diagnostics.add(Severity::warning, "map-place-unknown",
                        "it says nothing of its place on a map: its coordinates stay its own",
                        file.file);
    return diagnostics;
  }
  for (const FilePlace& file : files) {
    if (!file.place) {
      if (on_map)
        diagnostics.add(Severity::warning, "map-place-unknown",
                        "it says nothing of its place on a map: its coordinates stay its own",
                        file.file);
    } else if (file.place->crs != first->place->crs) {
      if (on_map)
        diagnostics.add(Severity::warning, "map-other",
                        "it lies on the map " + in_quotes(file.place->crs) + ", and " +
                            first->file + " on " + in_quotes(first->place->crs) +
                            ": they do not meet",
                        file.file);
    } else if (!on_map && !are_same(*file.place, *first->place)) {
      diagnostics.add(Severity::note, "map-place-differs",
                      "it lies on the map " + in_quotes(file.place->crs) + " otherwise than " +
                          first->file +
                          ": in coordinates of their own they do not meet as they do there",
                      file.file);
    }
  }
  return diagnostics;
}

}  // namespace strake::io
