// SPDX-License-Identifier: Apache-2.0
#include "geometry/distance/slab_partition.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "geometry/numeric/morton_order.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

/// Radians: the angle by which a triangle may differ from a rough direction besides the error of
/// the snap, and the most of both together; half of either for each of two triangles.
constexpr double kAlike = 0.0224, kMaxAlike = 0.25;
/// Grid units that the triangles of one level may lie apart: each corner is snapped by up to
/// sqrt(3)/2.
constexpr double kLevel = 4;
/// Levels of fewer triangles get no piece of their own. It is part of results: with 8 the brackets
/// of four in 8,096 results of a turned ship end up to 0.43 um elsewhere (decision 0073).
constexpr std::size_t kFewestPieces = 32;
/// Number of triangles sampled for a direction, and how many of them have to be alike.
constexpr std::size_t kSlabSamples = 32, kAlikeSamples = 4;
/// The least share of all pairs of triangles that has to be separated, as a divisor. Caps that are
/// fans of slivers cost the square of their number without slabs.
constexpr std::size_t kSlabShare = 4;

/// A unit normal and its error.
struct Facing {
  Vec3d normal;
  double angle = kAlike;

  explicit Facing(const Vec3d& n) : normal(n * (1 / length(n))) {}
  Facing(const Corners& t, const Vec3d& n) : Facing(n) {
    angle = std::min(kMaxAlike, kAlike + snap_angle_error(t, n));
  }
};

bool may_be_parallel(const Facing& x, const Facing& y) {
  const Vec3d other = dot(x.normal, y.normal) < 0 ? -y.normal : y.normal;
  return may_be_one_face(x.normal, x.angle, other, y.angle);
}

std::vector<Facing> sample_facings(const Part& part) {
  std::vector<Facing> facings;
  const std::size_t count = std::min(part.triangles.size(), kSlabSamples);
  for (std::size_t i = 0; i < count; ++i) {
    const Corners t = corners_of(part, sample(part.triangles, i, count));
    facings.emplace_back(t, normal_of(t));
  }
  return facings;
}

std::size_t count_parallel(const std::vector<Facing>& facings, const Facing& x) {
  return static_cast<std::size_t>(
      std::ranges::count_if(facings, [&](const Facing& y) { return may_be_parallel(x, y); }));
}

/// Returns the facing with the most others like it.
std::optional<Facing> commonest(const std::vector<Facing>& facings) {
  std::optional<Facing> best;
  std::size_t largest = 0;
  for (const Facing& x : facings)
    if (const std::size_t count = count_parallel(facings, x); count > largest) {
      largest = count;
      best = x;
    }
  return best;
}

/// Returns the directions to which both parts have many perpendicular triangles.
std::vector<Facing> rough_directions(const Part& a, const Part& b,
                                     const std::optional<Vec3d>& hint) {
  const std::vector<Facing> of_a = sample_facings(a), of_b = sample_facings(b);
  std::vector<Facing> rough;
  const auto offer = [&](const Facing& x) {
    if (count_parallel(of_a, x) >= kAlikeSamples && count_parallel(of_b, x) >= kAlikeSamples &&
        count_parallel(rough, x) == 0)
      rough.push_back(x);
  };
  if (hint && dot(*hint, *hint) > 0) offer(Facing(*hint));
  if (const auto x = commonest(of_a)) offer(*x);
  if (const auto x = commonest(of_b)) offer(*x);
  return rough;
}

/// A unit vector but for rounding.
struct Direction {
  Vec3d normal;
  double rounding = 0;  ///< error bound of a difference of heights; 0 along an axis
};

void add_parallel_normals(const Part& part, const Facing& rough, Vec3d& sum) {
  for (const Triangle& triangle : part.triangles) {
    const Corners t = corners_of(part, triangle);
    const Vec3d n = normal_of(t);
    if (may_be_parallel(Facing(t, n), rough)) sum = dot(n, rough.normal) > 0 ? sum + n : sum - n;
  }
}

std::optional<Direction> mean_direction(const PairLocalPart& a, const PairLocalPart& b,
                                        const Facing& rough) {
  Vec3d sum;
  add_parallel_normals(a.part(), rough, sum);
  add_parallel_normals(b.part(), rough, sum);
  const double squared = dot(sum, sum);
  if (!(squared > 0)) return std::nullopt;
  for (int k = 0; k < 3; ++k)
    if (sum[k] * sum[k] == squared) {
      Direction axis;
      axis.normal[k] = 1;
      return axis;
    }
  double reach = 0;
  for (const PairLocalPart* view : {&a, &b}) {
    const Box3d box = view->box(view->part().box).as<double>();
    const auto shift = view->shift().as<double>();
    for (int k = 0; k < 3; ++k)
      reach += std::fabs(box.lo[k]) + std::fabs(box.hi[k]) + std::fabs(shift[k]);
  }
  return Direction{sum * (1 / std::sqrt(squared)),
                   16 * std::numeric_limits<double>::epsilon() * reach};
}

/// A triangle and its interval of heights.
struct Height : ProjectionInterval {
  std::uint32_t triangle = 0;
};

/// The flat levels of a part, and the triangles in none.
struct Levels {
  std::vector<std::vector<Height>> flat;
  std::vector<Height> rest;
};

std::vector<Height> heights(const PairLocalPart& view, const Vec3d& normal) {
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

Levels levels_of(const PairLocalPart& view, const Vec3d& normal) {
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
    if (static_cast<std::size_t>(to - from) < kFewestPieces)
      levels.rest.insert(levels.rest.end(), from, to);
    else
      levels.flat.emplace_back(from, to);
    from = to;
  }
  return levels;
}

struct CountedRange {
  ProjectionInterval heights;
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

/// Returns a certain lower bound on the distance of triangles in these intervals of heights.
double gap_of(const ProjectionInterval& a, const ProjectionInterval& b,
              const Direction& direction) {
  const double gap = std::max(b.lo - a.hi, a.lo - b.hi);
  return direction.rounding > 0 ? gap - std::fabs(gap) * 1e-14 - direction.rounding : gap;
}

std::vector<SlabPiece> pieces_of(const Part& part, const Levels& levels) {
  std::vector<SlabPiece> pieces;
  const auto add = [&](const std::vector<Height>& of) {
    std::vector<std::uint32_t> triangles;
    triangles.reserve(of.size());
    for (const Height& h : of) triangles.push_back(h.triangle);
    std::ranges::sort(triangles);
    pieces.push_back({&part, TriangleBvh(part, triangles)});
  };
  for (const std::vector<Height>& level : levels.flat) add(level);
  if (!levels.rest.empty()) add(levels.rest);
  return pieces;
}

std::optional<SlabPartition> parted_along(const PairLocalPart& a, const PairLocalPart& b,
                                          const SlabOptions& question, const Direction& direction) {
  const Levels levels_a = levels_of(a, direction.normal), levels_b = levels_of(b, direction.normal);
  if (levels_a.flat.empty() || levels_b.flat.empty()) return std::nullopt;
  // Stairs of very many steps: testing each pair of steps would take longer than it saves.
  if (levels_a.flat.size() * levels_b.flat.size() >
      a.part().triangles.size() + b.part().triangles.size())
    return std::nullopt;
  const std::vector<CountedRange> of_a = ranges_of(levels_a), of_b = ranges_of(levels_b);
  SlabPartition pieces;
  struct Open {
    std::size_t a, b;
    double gap;
  };
  std::vector<Open> open;
  std::size_t parted = 0;
  for (std::size_t i = 0; i < of_a.size(); ++i)
    for (std::size_t j = 0; j < of_b.size(); ++j) {
      const double gap = gap_of(of_a[i].heights, of_b[j].heights, direction);
      if (gap >= question.apart) {
        pieces.gap = std::min(pieces.gap, gap);
        parted += of_a[i].count * of_b[j].count;
      } else {
        open.push_back({i, j, gap});
      }
    }
  if (!question.whatever_is_left &&
      parted < a.part().triangles.size() * b.part().triangles.size() / kSlabShare)
    return std::nullopt;
  if (open.empty()) return pieces;
  std::ranges::sort(open, {}, [](const Open& o) { return std::tuple(o.gap, o.a, o.b); });
  pieces.a = pieces_of(a.part(), levels_a);
  pieces.b = pieces_of(b.part(), levels_b);
  for (const Open& o : open) pieces.open.push_back({&pieces.a[o.a], &pieces.b[o.b], o.gap});
  return pieces;
}

}  // namespace

std::optional<SlabPartition> partition_by_height(const PairLocalPart& a, const PairLocalPart& b,
                                                 const SlabOptions& question) {
  for (const Facing& rough : rough_directions(a.part(), b.part(), question.hint))
    if (const auto direction = mean_direction(a, b, rough))
      if (auto pieces = parted_along(a, b, question, *direction)) return pieces;
  return std::nullopt;
}

}  // namespace strake::geometry
