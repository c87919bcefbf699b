// SPDX-License-Identifier: Apache-2.0
#include "model.hpp"

#include <numeric>

#include "strake/parallel/distinct.hpp"

namespace convert {
namespace {

/// A number below `range`, the same for the same keys on any machine.
std::int32_t number(std::uint64_t key, std::uint64_t of, std::uint64_t range) {
  using strake::parallel::mixed;
  return static_cast<std::int32_t>((mixed(mixed(mixed(0, key), of), key) >> 20U) % range);
}

Point moved(Point at, std::int32_t x, std::int32_t y, std::int32_t z) {
  return {at.x + x, at.y + y, at.z + z};
}

/// The grid points along the rim of a sheet, counter-clockwise from above.
std::vector<std::uint32_t> rim(std::uint32_t nx, std::uint32_t ny) {
  std::vector<std::uint32_t> all;
  const std::uint32_t row = nx + 1;
  for (std::uint32_t i = 0; i < nx; ++i) all.push_back(i);
  for (std::uint32_t j = 0; j < ny; ++j) all.push_back(j * row + nx);
  for (std::uint32_t i = nx; i > 0; --i) all.push_back(ny * row + i);
  for (std::uint32_t j = ny; j > 0; --j) all.push_back(j * row);
  return all;
}

/// A slab of nx × ny cells with a flat base and an uneven top: 4·(nx·ny + nx + ny) triangles.
Part slab(std::uint32_t nx, std::uint32_t ny, std::int32_t cell, Point at, std::uint64_t key) {
  Part part;
  const std::uint32_t row = nx + 1, top = row * (ny + 1);
  for (const bool above : {false, true})
    for (std::uint32_t j = 0; j <= ny; ++j)
      for (std::uint32_t i = 0; i <= nx; ++i)
        part.points.push_back(moved(at, static_cast<std::int32_t>(i) * cell,
                                    static_cast<std::int32_t>(j) * cell,
                                    above ? 50 + number(key, j * row + i, 100) : 0));
  for (std::uint32_t j = 0; j < ny; ++j)
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t a = j * row + i, b = a + 1, c = b + row, d = a + row;
      part.triangles.push_back({a, c, b});
      part.triangles.push_back({a, d, c});
      part.triangles.push_back({top + a, top + b, top + c});
      part.triangles.push_back({top + a, top + c, top + d});
    }
  const std::vector<std::uint32_t> edge = rim(nx, ny);
  for (std::size_t k = 0; k < edge.size(); ++k) {
    const std::uint32_t p = edge[k], q = edge[(k + 1) % edge.size()];
    part.triangles.push_back({p, q, top + q});
    part.triangles.push_back({p, top + q, top + p});
  }
  return part;
}

}  // namespace

Model make_model(std::size_t small, std::uint32_t cells) {
  Model model;
  for (std::uint64_t i = 0; i < small; ++i) {
    const Point at{number(1, i, 60'000), number(2, i, 20'000), number(3, i, 20'000)};
    const auto nx = static_cast<std::uint32_t>(1 + number(4, i, 4));
    const auto ny = static_cast<std::uint32_t>(1 + number(5, i, 3));
    model.push_back(i % 97 == 5 ? Part() : slab(nx, ny, 30 + number(6, i, 90), at, i));
  }
  if (small > 42) model[42].triangles.pop_back();
  // Where a sequential program meets them: somewhere in the middle, not in order of size.
  const std::array<std::size_t, 3> places{small / 3, small / 2, small * 2 / 3};
  const std::array<std::uint32_t, 3> wide{2, 4, 1};
  for (std::size_t g = 0; g < places.size(); ++g) {
    const Point at{static_cast<std::int32_t>(g) * 15'000, -1000, 5000};
    const auto place = static_cast<std::ptrdiff_t>(places[g] + g);
    model.insert(model.begin() + place, slab(cells * wide[g] / 2, cells / 2, 20, at, small + g));
  }
  return model;
}

std::size_t triangles_of(const Model& model) {
  return std::accumulate(
      model.begin(), model.end(), std::size_t{0},
      [](std::size_t sum, const Part& part) { return sum + part.triangles.size(); });
}

std::vector<Valve> make_valves(std::size_t count) {
  std::vector<Valve> valves;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Point above{number(7, i, 3) * 15'000 + number(8, i, 1200), -1000 + number(9, i, 600),
                      5300 + number(10, i, 500)};
    const Point anywhere{number(7, i, 60'000), number(8, i, 20'000), number(9, i, 20'000)};
    valves.push_back({i % 4 == 0 ? above : anywhere, 200 + number(11, i, 800)});
  }
  return valves;
}

}  // namespace convert
