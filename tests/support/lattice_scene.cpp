// SPDX-License-Identifier: Apache-2.0
#include "support/lattice_scene.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "strake/geometry/wide_int.hpp"

namespace strake::test {

using geometry::Triangle;
using geometry::Vec3i;
using geometry::Vec3l;

namespace {

class Maker {
 public:
  Maker(Random& random, const LatticeOptions& options) : random_(random), options_(options) {}

  HandPart part() {
    HandPart made = any_part();
    if (options_.edit) options_.edit(made);
    return made;
  }

 private:
  HandPart any_part() {
    switch (random_.below(10)) {
      case 0:
      case 1:
      case 2:
        return box();
      case 3:
        return tetrahedron();
      case 4:
        return notched();
      case 5:
        return sheet();
      case 6:
        return fan();
      case 7:
        return wire();
      case 8:
        return pyramid();
      default:
        return bowl();
    }
  }

  std::int32_t coordinate() {
    return static_cast<std::int32_t>(random_.below(options_.steps + 1)) * options_.unit;
  }
  Vec3i point() { return {coordinate(), coordinate(), coordinate()}; }

  HandPart box() {
    for (;;) {
      const Vec3i p = point(), q = point();
      const Vec3i lo{std::min(p.x, q.x), std::min(p.y, q.y), std::min(p.z, q.z)};
      const Vec3i hi{std::max(p.x, q.x), std::max(p.y, q.y), std::max(p.z, q.z)};
      if (lo.x < hi.x && lo.y < hi.y && lo.z < hi.z) return maybe_unfaced(hand_box(lo, hi));
    }
  }

  // Half of the parts come without source faces: every diagonal is then a flat edge.
  HandPart maybe_unfaced(HandPart part) {
    if (random_.one_in(2)) part.faces.clear();
    return part;
  }

  /// Six times the volume of a tetrahedron; on the huge lattice it needs more than 64 bits.
  static geometry::Int128 volume(const Vec3i& a, const Vec3i& b, const Vec3i& c, const Vec3i& d) {
    const Vec3l o = a.as<std::int64_t>(), p = b.as<std::int64_t>() - o;
    const Vec3l n = cross(c.as<std::int64_t>() - o, d.as<std::int64_t>() - o);
    return static_cast<geometry::Int128>(n.x) * p.x + static_cast<geometry::Int128>(n.y) * p.y +
           static_cast<geometry::Int128>(n.z) * p.z;
  }

  HandPart tetrahedron() {
    for (;;) {
      std::array<Vec3i, 4> v{point(), point(), point(), point()};
      const geometry::Int128 six = volume(v[0], v[1], v[2], v[3]);
      if (six == 0) continue;
      if (six < 0) std::swap(v[2], v[3]);
      return {{v.begin(), v.end()},
              {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{0, 3, 2}},
              {},
              {}};
    }
  }

  // Four corners of a lattice rectangle and an apex: a pyramid whose base is a quad.
  HandPart pyramid() {
    for (;;) {
      const Vec3i p = point(), q = point(), apex = point();
      if (p.x >= q.x || p.y >= q.y || apex.z <= p.z) continue;
      return maybe_unfaced({{p, {q.x, p.y, p.z}, {q.x, q.y, p.z}, {p.x, q.y, p.z}, apex},
                            {Triangle{0, 2, 1}, Triangle{0, 3, 2}, Triangle{0, 1, 4},
                             Triangle{1, 2, 4}, Triangle{2, 3, 4}, Triangle{3, 0, 4}},
                            {0, 0, 1, 2, 3, 4},
                            {}});
    }
  }

  // An L-shaped prism: concave, with a T-free side wall of quads.
  HandPart notched() {
    const std::int32_t u = options_.unit;
    const Vec3i o{coordinate(), coordinate(), coordinate()};
    const std::array<std::array<std::int32_t, 2>, 6> outline{
        {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
    const std::uint32_t turn = random_.below(3);
    HandPart part;
    for (std::int32_t level = 0; level < 2; ++level)
      for (const auto& c : outline) {
        const std::int32_t a = c[0] * u, b = c[1] * u, h = level * u;
        const Vec3i v = turn == 0 ? Vec3i{a, b, h} : turn == 1 ? Vec3i{h, a, b} : Vec3i{b, h, a};
        part.vertices.push_back(v + o);
      }
    const std::array<Triangle, 4> cap{Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4},
                                      Triangle{0, 4, 5}};
    for (const Triangle& t : cap) {
      part.triangles.push_back({t[0], t[2], t[1]});
      part.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
      part.faces.insert(part.faces.end(), {0, 1});
    }
    for (std::uint32_t i = 0; i < 6; ++i) {
      const std::uint32_t j = (i + 1) % 6;
      part.triangles.push_back({i, j, j + 6});
      part.triangles.push_back({i, j + 6, i + 6});
      part.faces.insert(part.faces.end(), {i + 2, i + 2});
    }
    return maybe_unfaced(std::move(part));
  }

  // A lone triangle, or two that share an edge (folded, flat or turned over).
  HandPart sheet() {
    for (;;) {
      const std::array<Vec3i, 4> v{point(), point(), point(), point()};
      const auto flat = [&](std::size_t a, std::size_t b, std::size_t c) {
        const Vec3l p = v[a].as<std::int64_t>();
        return cross(v[b].as<std::int64_t>() - p, v[c].as<std::int64_t>() - p) == Vec3l{0, 0, 0};
      };
      if (flat(0, 1, 2)) continue;
      if (random_.one_in(3)) return {{v[0], v[1], v[2]}, {Triangle{0, 1, 2}}, {}, {}};
      if (v[3] == v[0] || v[3] == v[1] || v[3] == v[2] || flat(0, 2, 3)) continue;
      const bool turned = random_.one_in(3);
      return {{v.begin(), v.end()},
              {Triangle{0, 1, 2}, turned ? Triangle{0, 3, 2} : Triangle{0, 2, 3}},
              {},
              {}};
    }
  }

  // Three or more triangles on one edge.
  HandPart fan() {
    for (;;) {
      HandPart part;
      part.vertices = {point(), point()};
      const Vec3l p = part.vertices[0].as<std::int64_t>(), q = part.vertices[1].as<std::int64_t>();
      for (int tries = 0; tries < 12 && part.triangles.size() < 4; ++tries) {
        const Vec3i c = point();
        if (cross(q - p, c.as<std::int64_t>() - p) == Vec3l{0, 0, 0}) continue;
        if (std::find(part.vertices.begin(), part.vertices.end(), c) != part.vertices.end())
          continue;
        const auto k = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.push_back(c);
        part.triangles.push_back(random_.one_in(2) ? Triangle{0, 1, k} : Triangle{1, 0, k});
      }
      if (part.triangles.size() >= 2) return part;
    }
  }

  HandPart wire() {
    HandPart part;
    const std::uint32_t chains = 1 + random_.below(2);
    for (std::uint32_t c = 0; c < chains; ++c) {
      std::vector<Vec3i> chain;
      const std::uint32_t points = 2 + random_.below(3);
      while (chain.size() < points) {
        const Vec3i p = point();
        if (chain.empty() || chain.back() != p) chain.push_back(p);
      }
      part.chains.push_back(chain);
    }
    return part;
  }

  // Part of a box: an open shell of some of its faces, in either orientation.
  HandPart bowl() {
    HandPart part = box();
    part.faces.clear();
    const std::uint32_t keep = 2 + random_.below(9);
    part.triangles.resize(keep);
    if (random_.one_in(2))
      for (Triangle& t : part.triangles) std::swap(t[1], t[2]);
    return part;
  }

  Random& random_;
  const LatticeOptions& options_;
};

}  // namespace

SceneBuilder lattice_scene(std::uint64_t seed, const LatticeOptions& options) {
  Random random(seed);
  Maker maker(random, options);
  SceneBuilder builder;
  for (std::uint32_t i = 0; i < options.objects; ++i) {
    const auto shift = [&] {
      return (static_cast<std::int64_t>(random.below(3)) - 1) * options.unit;
    };
    if (i > 0 && random.one_in(5)) {  // a copy, often in the very same place
      const Vec3l offset = random.one_in(2) ? Vec3l{} : Vec3l{shift(), shift(), shift()};
      builder.instance(random.below(i), offset);
      continue;
    }
    std::vector<HandBody> bodies;
    const std::uint32_t count = random.one_in(4) ? 2 : 1;
    for (std::uint32_t b = 0; b < count; ++b) {
      HandBody body;
      body.parts.push_back(maker.part());
      if (random.one_in(4)) body.parts.push_back(maker.part());
      if (random.one_in(8)) body.alpha = 100;
      bodies.push_back(std::move(body));
    }
    builder.object(bodies);
  }
  return builder;
}

Vec3l direction_of(std::uint32_t index) {
  constexpr std::array<Vec3l, kDirections> directions{Vec3l{0, 0, 1},
                                                      Vec3l{0, 0, -1},
                                                      Vec3l{0, -1, 0},
                                                      Vec3l{0, 1, 0},
                                                      Vec3l{1, 0, 0},
                                                      Vec3l{-1, 0, 0},
                                                      Vec3l{1, -1, 1},
                                                      Vec3l{1, 1, 1},
                                                      Vec3l{1, 1, 0},
                                                      Vec3l{0, -1, 2},
                                                      Vec3l{1, 2, 3},
                                                      Vec3l{-3, 1, 2},
                                                      Vec3l{2, -2, 1},
                                                      Vec3l{3, 0, -1},
                                                      Vec3l{1048576, -524287, 7},
                                                      Vec3l{-1000003, 999983, 1048573}};
  return directions[index % kDirections];
}

std::optional<geometry::Box3l> random_limits(Random& random, const LatticeOptions& options) {
  if (!random.one_in(3)) return std::nullopt;
  geometry::Box3l box;
  for (int k = 0; k < 3; ++k) {
    const auto pick = [&] {
      const std::int64_t step = static_cast<std::int64_t>(random.below(options.steps + 3)) - 1;
      return step * options.unit + (random.one_in(3) ? options.unit / 3 : 0);
    };
    const std::int64_t p = pick(), q = pick();
    box.lo[k] = std::min(p, q);
    box.hi[k] = std::max(p, q);
  }
  return box;
}

hlr::View random_perspective(Random& random, const LatticeOptions& options) {
  const auto steps = static_cast<std::int64_t>(options.steps);
  const std::int64_t half = options.unit % 2 == 0 ? options.unit / 2 : 0;
  const auto coordinate = [&](std::int64_t lo, std::int64_t hi) {
    const std::int64_t step = lo + random.below(static_cast<std::uint32_t>(hi - lo + 1));
    return step * options.unit + (random.one_in(4) ? half : 0);
  };
  hlr::Perspective p;
  do {
    const std::int64_t far = random.one_in(6) ? 50 : random.one_in(2) ? 3 * steps : steps;
    for (int k = 0; k < 3; ++k) {
      p.eye[k] = coordinate(-far, far + steps);
      p.target[k] = coordinate(0, steps);
    }
  } while (p.eye == p.target);
  p.near_mm = 0.001;
  p.field_of_view_deg = random.one_in(3) ? 160 : 20 + random.below(120);
  hlr::View view{.limits = std::nullopt, .perspective = p};
  const Vec3l way = p.eye - p.target;
  const std::int64_t largest =
      std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)}) / (std::int64_t{1} << 20) + 1;
  for (int k = 0; k < 3; ++k) view.direction[k] = way[k] / largest;
  // Now and then the paper is not square to the way to the target.
  const Vec3l other = direction_of(random.below(kDirections));
  const std::int64_t size = std::abs(other.x) + std::abs(other.y) + std::abs(other.z);
  if (random.one_in(4) && dot(other, way) > size) view.direction = other;
  return view;
}

hlr::Section random_section(Random& random, const LatticeOptions& options) {
  hlr::Section section;
  do {
    for (int k = 0; k < 3; ++k) section.normal[k] = static_cast<std::int64_t>(random.below(5)) - 2;
    if (random.one_in(8)) section.normal = direction_of(kDirections - 1 - random.below(2));
    if (random.one_in(2)) {
      const int axis = static_cast<int>(random.below(3));
      section.normal = {};
      section.normal[axis] = random.one_in(2) ? 1 : -1;
    }
  } while (section.normal == Vec3l{});
  for (int k = 0; k < 3; ++k) {
    section.point[k] = static_cast<std::int64_t>(random.below(options.steps + 1)) * options.unit;
    if (random.one_in(3)) section.point[k] += options.unit / (random.one_in(2) ? 2 : 3);
  }
  return section;
}

}  // namespace strake::test
