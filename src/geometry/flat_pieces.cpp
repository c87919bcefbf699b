// SPDX-License-Identifier: Apache-2.0
#include "geometry/flat_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geometry/corners.hpp"
#include "geometry/range.hpp"

namespace strake::geometry {
namespace {

/// Cosine of the angle by which a triangle may be turned from a rough direction: needles are turned
/// by the snap.
constexpr double kAlike = 0.999;
/// Grid units that the triangles of one level may lie apart: each corner is snapped by up to
/// sqrt(3)/2.
constexpr double kLevel = 4;
/// Levels of fewer triangles are not worth a piece.
constexpr std::size_t kFewest = 32;
/// Triangles that are looked at for a direction, and how many of them have to be alike.
constexpr std::size_t kSamples = 32, kAlikeSamples = 4;
/// Least share of all pairs of triangles that has to be parted, as a divisor.
constexpr std::size_t kShare = 4;

bool alike(const Vec3d& n, const Vec3d& m) {
  const double along = dot(n, m);
  return along * along >= kAlike * kAlike * dot(n, n) * dot(m, m);
}

std::vector<Vec3d> sample_normals(const Part& part) {
  std::vector<Vec3d> normals;
  const std::size_t n = part.triangles.size(), count = std::min(n, kSamples);
  for (std::size_t i = 0; i < count; ++i)
    normals.push_back(normal_of(corners_of(part, part.triangles[i * n / count])));
  return normals;
}

std::size_t count_alike(const std::vector<Vec3d>& normals, const Vec3d& n) {
  return static_cast<std::size_t>(
      std::ranges::count_if(normals, [&](const Vec3d& m) { return alike(n, m); }));
}

/// The one with the most others like it.
Vec3d commonest(const std::vector<Vec3d>& normals) {
  Vec3d best;
  std::size_t most = 0;
  for (const Vec3d& n : normals)
    if (const std::size_t count = count_alike(normals, n); count > most) {
      most = count;
      best = n;
    }
  return best;
}

/// Directions that both parts have many triangles square to.
std::vector<Vec3d> rough_directions(const Part& a, const Part& b,
                                    const std::optional<Vec3d>& hint) {
  const std::vector<Vec3d> of_a = sample_normals(a), of_b = sample_normals(b);
  std::vector<Vec3d> tries{commonest(of_a), commonest(of_b)};
  if (hint) tries.insert(tries.begin(), *hint);
  std::vector<Vec3d> rough;
  for (const Vec3d& n : tries)
    if (count_alike(of_a, n) >= kAlikeSamples && count_alike(of_b, n) >= kAlikeSamples &&
        count_alike(rough, n) == 0)
      rough.push_back(n);
  return rough;
}

/// A unit vector but for rounding.
struct Direction {
  Vec3d normal;
  double rounding = 0;  ///< bound on what a difference of heights may be off by; 0 along an axis
};

void add_alike(const Part& part, const Vec3d& rough, Vec3d& sum) {
  for (const Triangle& t : part.triangles) {
    const Vec3d n = normal_of(corners_of(part, t));
    if (alike(n, rough)) sum = dot(n, rough) > 0 ? sum + n : sum - n;
  }
}

std::optional<Direction> mean_direction(const PartView& a, const PartView& b, const Vec3d& rough) {
  Vec3d sum;
  add_alike(a.part(), rough, sum);
  add_alike(b.part(), rough, sum);
  const double squared = dot(sum, sum);
  if (!(squared > 0)) return std::nullopt;
  for (int k = 0; k < 3; ++k)
    if (sum[k] * sum[k] == squared) {
      Direction axis;
      axis.normal[k] = 1;
      return axis;
    }
  double reach = 0;
  for (const PartView* view : {&a, &b}) {
    const Box3d box = view->box(view->part().box).as<double>();
    const auto shift = view->shift().as<double>();
    for (int k = 0; k < 3; ++k)
      reach += std::fabs(box.lo[k]) + std::fabs(box.hi[k]) + std::fabs(shift[k]);
  }
  return Direction{sum * (1 / std::sqrt(squared)),
                   16 * std::numeric_limits<double>::epsilon() * reach};
}

/// A triangle and the heights that it lies between.
struct Height : Range {
  std::uint32_t triangle = 0;
};

/// The flat levels of a part, and what lies in none.
struct Levels {
  std::vector<std::vector<Height>> flat;
  std::vector<Height> rest;
};

std::vector<Height> heights(const PartView& view, const Vec3d& normal) {
  const Part& part = view.part();
  const double base = dot(normal, view.shift().as<double>());
  std::vector<double> at(part.vertices.size());
  for (std::size_t v = 0; v < at.size(); ++v)
    at[v] = dot(normal, part.vertices[v].as<double>()) + base;
  std::vector<Height> all;
  all.reserve(part.triangles.size());
  for (const Triangle& t : part.triangles) {
    const auto [lo, hi] = std::minmax({at[t[0]], at[t[1]], at[t[2]]});
    all.push_back({{lo, hi}, static_cast<std::uint32_t>(all.size())});
  }
  return all;
}

Levels levels_of(const PartView& view, const Vec3d& normal) {
  Levels levels;
  std::vector<Height> flat;
  for (const Height& h : heights(view, normal))
    (h.hi - h.lo > kLevel ? levels.rest : flat).push_back(h);
  std::ranges::sort(flat, [](const Height& x, const Height& y) {
    return x.lo != y.lo ? x.lo < y.lo : x.triangle < y.triangle;
  });
  for (auto from = flat.begin(); from != flat.end();) {
    const auto to =
        std::find_if(from, flat.end(), [&](const Height& h) { return h.lo > from->lo + kLevel; });
    if (static_cast<std::size_t>(to - from) < kFewest)
      levels.rest.insert(levels.rest.end(), from, to);
    else
      levels.flat.emplace_back(from, to);
    from = to;
  }
  return levels;
}

struct CountedRange {
  Range heights;
  std::size_t count = 0;
};

std::vector<CountedRange> ranges_of(const Levels& levels) {
  std::vector<CountedRange> ranges;
  const auto add = [&](const std::vector<Height>& of) {
    CountedRange& range = ranges.emplace_back();
    range.count = of.size();
    for (const Height& h : of) range.heights.include(h);
  };
  for (const std::vector<Height>& level : levels.flat) add(level);
  if (!levels.rest.empty()) add(levels.rest);
  return ranges;
}

/// A certain lower bound on the distance of what lies between these heights.
double gap_of(const Range& a, const Range& b, const Direction& direction) {
  const double gap = std::max(b.lo - a.hi, a.lo - b.hi);
  return direction.rounding > 0 ? gap - std::fabs(gap) * 1e-14 - direction.rounding : gap;
}

std::vector<FlatPiece> pieces_of(const Part& part, const Levels& levels) {
  std::vector<FlatPiece> pieces;
  const auto add = [&](const std::vector<Height>& of) {
    std::vector<std::uint32_t> triangles;
    triangles.reserve(of.size());
    for (const Height& h : of) triangles.push_back(h.triangle);
    std::ranges::sort(triangles);
    pieces.push_back({&part, PartTree(part, triangles)});
  };
  for (const std::vector<Height>& level : levels.flat) add(level);
  if (!levels.rest.empty()) add(levels.rest);
  return pieces;
}

std::optional<FlatPieces> parted_along(const PartView& a, const PartView& b, double apart,
                                       const Direction& direction) {
  const Levels levels_a = levels_of(a, direction.normal), levels_b = levels_of(b, direction.normal);
  if (levels_a.flat.empty() || levels_b.flat.empty()) return std::nullopt;
  // Stairs of very many steps: telling each pair of steps would take longer than it saves.
  if (levels_a.flat.size() * levels_b.flat.size() >
      a.part().triangles.size() + b.part().triangles.size())
    return std::nullopt;
  const std::vector<CountedRange> of_a = ranges_of(levels_a), of_b = ranges_of(levels_b);
  FlatPieces pieces;
  struct Open {
    std::size_t a, b;
    double gap;
  };
  std::vector<Open> open;
  std::size_t parted = 0;
  for (std::size_t i = 0; i < of_a.size(); ++i)
    for (std::size_t j = 0; j < of_b.size(); ++j) {
      const double gap = gap_of(of_a[i].heights, of_b[j].heights, direction);
      if (gap >= apart) {
        pieces.gap = std::min(pieces.gap, gap);
        parted += of_a[i].count * of_b[j].count;
      } else {
        open.push_back({i, j, gap});
      }
    }
  if (parted < a.part().triangles.size() * b.part().triangles.size() / kShare) return std::nullopt;
  if (open.empty()) return pieces;
  pieces.a = pieces_of(a.part(), levels_a);
  pieces.b = pieces_of(b.part(), levels_b);
  for (const Open& o : open) pieces.open.push_back({&pieces.a[o.a], &pieces.b[o.b], o.gap});
  return pieces;
}

}  // namespace

std::optional<FlatPieces> parted_by_heights(const PartView& a, const PartView& b, double apart,
                                            const std::optional<Vec3d>& hint) {
  for (const Vec3d& rough : rough_directions(a.part(), b.part(), hint))
    if (const auto direction = mean_direction(a, b, rough))
      if (auto pieces = parted_along(a, b, apart, *direction)) return pieces;
  return std::nullopt;
}

}  // namespace strake::geometry
