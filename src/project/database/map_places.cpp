// SPDX-License-Identifier: Apache-2.0
#include "project/database/map_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/text_encoding.hpp"

namespace strake::project {
namespace {

using Matrix = std::array<double, 16>;

/// Names of maps are short, and shown to people as they are.
constexpr std::size_t kLongestCrs = 1000;

/// The numbers go column by column, and the last of each column is that of a placement.
bool is_placement(const Matrix& m) {
  return std::ranges::all_of(m, [](double number) { return std::isfinite(number); }) && m[3] == 0 &&
         m[7] == 0 && m[11] == 0 && m[15] == 1;
}

}  // namespace

std::optional<io::MapPlace> map_place_of(std::string_view crs, std::span<const std::byte> to_map) {
  Matrix m{};
  if (to_map.size() != sizeof m || crs.size() > kLongestCrs || printable(crs) != crs)
    return std::nullopt;
  std::memcpy(m.data(), to_map.data(), sizeof m);
  if (!is_placement(m)) return std::nullopt;
  io::MapPlace place;
  place.crs = crs;
  for (std::size_t row = 0; row < 3; ++row)
    place.to_map.linear.row[row] = {m.at(row), m.at(4 + row), m.at(8 + row)};
  place.to_map.translation = {m[12], m[13], m[14]};
  return place;
}

Status write_map_place(Database& database, std::int64_t file,
                       const std::optional<io::MapPlace>& place) {
  Result<Statement> remove = database.prepare("DELETE FROM map_place WHERE file = ?1");
  if (!remove) return remove.error();
  if (const Status status = remove->bind(1, file).run(); !status) return status;
  if (!place) return {};
  Result<Statement> put =
      database.prepare("INSERT INTO map_place (file, crs, to_map) VALUES (?1, ?2, ?3)");
  if (!put) return put.error();
  const Matrix m = io::matrix_of(place->to_map);
  put->bind(1, file).bind(2, std::string_view(place->crs));
  return put->bind(3, std::as_bytes(std::span(m))).run();
}

void add_to(Hasher& hasher, const io::MapPlace& place) {
  hasher.add(place.crs);
  for (const double number : io::matrix_of(place.to_map)) hasher.add(number);
}

}  // namespace strake::project
