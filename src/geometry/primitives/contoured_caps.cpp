// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "geometry/primitives/domes.hpp"
#include "geometry/primitives/mesh_builder.hpp"

// Spherical dishes whose contour in a view meets the base circle. The base circle is no great
// circle of the ball, so no net of meridians contains both it and the silhouette. But all planes
// through the two points where they meet cut the ball in circles through these, base circle and
// silhouette among them: their arcs over the dish are the rows of the net. The columns are circles
// at right angles to them (the circles of Apollonius), on each of which the distances from the two
// points are in one ratio. Such a net is the image of one of meridians and parallels under a map
// that takes circles to circles: its quads are planar, and those along the silhouette face the
// right way.

namespace strake::geometry::tessellation {
namespace {

using Row = std::vector<std::uint32_t>;

double tan_of_half(double angle) {
  const SinCos half = sin_cos(angle / 2);
  return half.sin / half.cos;
}

/// A row's circle, through both ends, in the plane of the line between them and `up`.
struct Arc {
  Vec3d up;
  double centre = 0;  ///< along `up`, from the middle between the ends
  double radius = 0, half_angle = 0;
  double tan = 0;  ///< of half of half_angle
};

/// Where a column meets an arc: the tangent of half the angle from the arc's top, over Arc::tan. -1
/// and 1 are the ends.
using Column = double;

/// One of the two arcs of the rim between the contour's ends, from the right one to the left one.
struct RimArc {
  Arc arc;
  double side = 1;                 ///< towards the viewer, or -1
  std::vector<Vec3d> points;       ///< between the ends
  std::vector<std::size_t> place;  ///< of these among the columns, counted from 1
};

class ContouredCap {
 public:
  ContouredCap(const SphericalDishPrimitive& p, const CapContour& contour,
               const TessellationTarget& target)
      : radius_(p.radius),
        contour_(contour),
        target_(target),
        from_apex_(2 * arc_tan2(p.height, p.radius)),
        builder_(target.towards, target.eye) {}

  /// `rim` has the contour's ends at `right` and `left`; `step` is the longest chord wanted.
  [[nodiscard]] Tessellation make(const std::vector<SinCos>& rim, std::size_t right,
                                  std::size_t left, double step,
                                  const std::vector<double>& tilts) && {
    RimArc near = rim_arc(rim, right, left, 1), far = rim_arc(rim, right, left, -1);
    std::vector<Arc> arcs;
    for (const double tilt : tilts) arcs.push_back(arc(tilt));
    const Arc& largest = *std::ranges::max_element(arcs, {}, &Arc::half_angle);
    unite(near, far, largest, step);
    add_where_flat(near, arcs.front());
    add_where_flat(far, arcs.back());

    right_ = builder_.vertex(end(-1));
    left_ = builder_.vertex(end(1));
    const Row low = row_through(near.points), high = row_through(far.points);
    Row before;
    for (const Arc& a : arcs) {
      Row row = row_of(a);
      if (before.empty())
        lace(near, low, row);
      else
        for (std::size_t k = 0; k + 1 < row.size(); ++k)
          builder_.quad(before[k], before[k + 1], row[k + 1], row[k]);
      before = std::move(row);
    }
    lace(far, high, before);
    Row base = low;
    base.insert(base.end(), high.rbegin() + 1, high.rend() - 1);
    builder_.polygon(base, true);
    return std::move(builder_).take(surface_sag(largest, tilts, widest_step(rim)));
  }

 private:
  [[nodiscard]] Vec3d end(double side) const {
    return contour_.out * contour_.at + contour_.across * (side * contour_.half);
  }

  /// Through the point of the ball that is tilted so far from the apex, over the middle.
  [[nodiscard]] Arc arc(double tilt) const {
    const SinCos t = sin_cos(tilt);
    const double out = contour_.ball * t.sin - contour_.at;
    const double up = contour_.centre + contour_.ball * t.cos;
    const double size = std::sqrt(out * out + up * up);
    return arc_along(out / size, up / size);
  }
  /// In a direction from the middle.
  [[nodiscard]] Arc arc_along(double out, double up) const {
    Arc a;
    a.up = contour_.out * out + Vec3d{0, 0, up};
    a.centre = contour_.centre * up - contour_.at * out;
    a.radius = std::sqrt(a.centre * a.centre + contour_.half * contour_.half);
    a.half_angle = arc_tan2(contour_.half, -a.centre);
    a.tan = tan_of_half(a.half_angle);
    return a;
  }

  /// The points of the rim on one side, and their columns.
  [[nodiscard]] RimArc rim_arc(const std::vector<SinCos>& rim, std::size_t right, std::size_t left,
                               double side) {
    RimArc arc{arc_along(side, 0), side, {}, {}};
    const std::size_t count = rim.size(), step = side > 0 ? 1 : count - 1;
    for (std::size_t k = (right + step) % count; k != left; k = (k + step) % count) {
      const Vec3d at{rim[k].cos, rim[k].sin, 0};
      // The tangent of half an angle from its sine and cosine.
      const double cosine = dot(at, contour_.out) * side, sine = dot(at, contour_.across);
      columns_.push_back(sine / (1 + cosine) / arc.arc.tan);
      arc.points.push_back(at * radius_);
    }
    return arc;
  }

  [[nodiscard]] static double angle_on(const Arc& a, Column column) {
    return 2 * arc_tan2(column * a.tan, 1);
  }
  [[nodiscard]] Vec3d at(const Arc& a, Column column) const {
    const double t = column * a.tan, size = 1 + t * t;
    return contour_.out * contour_.at + a.up * (a.centre + a.radius * (1 - t * t) / size) +
           contour_.across * (a.radius * 2 * t / size);
  }

  /// Makes columns of those of both arcs of the rim, and more where they are wider than `step` on
  /// the arc that turns most, which is where they are widest. Of two that are nearly one the first
  /// stands for both.
  void unite(RimArc& near, RimArc& far, const Arc& largest, double step) {
    const std::vector<Column> of_rim = std::exchange(columns_, {});
    std::vector<Column> some = of_rim;
    some.push_back(1);
    std::ranges::sort(some);
    double from = -largest.half_angle;
    for (const Column column : some) {
      const double to = column < 1 ? angle_on(largest, column) : largest.half_angle;
      const double length = (to - from) * largest.radius;
      if (!columns_.empty() && length < step / 1000) continue;
      const int parts = std::max(1, static_cast<int>(std::ceil(length / step * (1 - 1e-9))));
      for (int k = 1; k < parts; ++k)
        columns_.push_back(tan_of_half(from + (to - from) * k / parts) / largest.tan);
      if (column < 1) columns_.push_back(column);
      from = to;
    }
    for (std::size_t i = 0; i < of_rim.size(); ++i)
      (i < near.points.size() ? near : far).place.push_back(place_of(of_rim[i]));
  }

  [[nodiscard]] Vec3d viewer_from(const Vec3d& p) const {
    return target_.eye ? *target_.eye - p : *target_.towards;
  }

  /// Of the nearest column, counted from 1.
  [[nodiscard]] std::size_t place_of(Column c) const {
    auto next = std::ranges::lower_bound(columns_, c);
    if (next == columns_.end() || (next != columns_.begin() && c - next[-1] < *next - c)) --next;
    return static_cast<std::size_t>(next - columns_.begin()) + 1;
  }

  /// Calls use(a, b, c) for the triangles between two neighbours of the rim, 0 and 1, and the
  /// columns from one's place to the other's, which are their numbers plus 2. A triangle that does
  /// not have both neighbours fans from the one that stands beside it.
  template <class Use>
  void fan(std::size_t from, std::size_t to, Use&& use) const {
    const std::size_t last = columns_.size() + 1;
    const std::size_t top = from == 0 ? from + 1 : to == last ? to - 1 : (from + to) / 2;
    for (std::size_t k = from; k < top && from > 0; ++k) use(std::size_t{0}, k + 3, k + 2);
    use(std::size_t{0}, std::size_t{1}, top + 2);
    for (std::size_t k = top; k < to && to < last; ++k) use(std::size_t{1}, k + 3, k + 2);
  }

  /// Where rows come together, the rim's chord between two neighbours may lie on the other side of
  /// what the next row has between them; triangles there look the wrong way. The rim then gets the
  /// columns that it lacks.
  void add_where_flat(RimArc& rim, const Arc& next) const {
    const std::size_t last = columns_.size() + 1;
    const auto in_row = [&](std::size_t place) {
      return place == 0 ? end(-1) : place == last ? end(1) : at(next, columns_[place - 1]);
    };
    std::vector<Vec3d> points;
    std::vector<std::size_t> places;
    Vec3d before = end(-1);
    std::size_t from = 0;
    for (std::size_t i = 0; i <= rim.points.size(); ++i) {
      const bool ends = i == rim.points.size();
      const Vec3d to_point = ends ? end(1) : rim.points[i];
      const std::size_t to = ends ? last : rim.place[i];
      bool wrong = from == 0 && to == last;  // then nothing stands beside the columns
      fan(from, to, [&](std::size_t a, std::size_t b, std::size_t c) {
        const auto point = [&](std::size_t n) {
          return n == 0 ? before : n == 1 ? to_point : in_row(n - 2);
        };
        const Vec3d n = cross(point(b) - point(a), point(c) - point(a));
        wrong = wrong || !(dot(n, viewer_from(point(a))) > 0);
      });
      for (std::size_t k = from + 1; k < to && wrong; ++k) {
        points.push_back(at(rim.arc, columns_[k - 1]));
        places.push_back(k);
      }
      if (!ends) {
        points.push_back(to_point);
        places.push_back(to);
      }
      before = to_point;
      from = to;
    }
    rim.points = std::move(points);
    rim.place = std::move(places);
  }

  [[nodiscard]] Row row_through(const std::vector<Vec3d>& points) {
    Row row{right_};
    for (const Vec3d& p : points) row.push_back(builder_.vertex(p));
    row.push_back(left_);
    return row;
  }
  [[nodiscard]] Row row_of(const Arc& a) {
    std::vector<Vec3d> points;
    for (const Column column : columns_) points.push_back(at(a, column));
    return row_through(points);
  }

  /// Between the rim and the row next to it.
  void lace(const RimArc& rim, const Row& low, const Row& row) {
    for (std::size_t i = 0; i + 1 < low.size(); ++i) {
      const std::size_t from = i == 0 ? 0 : rim.place[i - 1];
      const std::size_t to = i + 2 == low.size() ? row.size() - 1 : rim.place[i];
      if (to == from + 1) {
        const std::array quad{low[i], low[i + 1], row[to], row[from]};
        if (rim.side > 0)
          builder_.quad(quad[0], quad[1], quad[2], quad[3]);
        else
          builder_.quad(quad[3], quad[2], quad[1], quad[0]);
        continue;
      }
      fan(from, to, [&](std::size_t a, std::size_t b, std::size_t c) {
        const auto vertex = [&](std::size_t n) { return n < 2 ? low[i + n] : row[n - 2]; };
        builder_.polygon(rim.side > 0 ? std::array{vertex(a), vertex(b), vertex(c)}
                                      : std::array{vertex(a), vertex(c), vertex(b)});
      });
    }
  }

  /// Facets between the rim and the next row have the chords of the one and the height of the
  /// other.
  [[nodiscard]] double surface_sag(const Arc& largest, const std::vector<double>& tilts,
                                   double rim_step) const {
    double across = std::max(from_apex_ - tilts.front(), tilts.back() + from_apex_);
    for (std::size_t i = 0; i + 1 < tilts.size(); ++i)
      across = std::max(across, tilts[i] - tilts[i + 1]);
    double along = 0, from = -largest.half_angle;
    for (const Column column : columns_) {
      const double to = angle_on(largest, column);
      along = std::max(along, to - from);
      from = to;
    }
    along = std::max(along, largest.half_angle - from) * largest.radius / contour_.ball;
    along = std::max(along, rim_step * radius_ / contour_.ball);
    return contour_.ball * (along * along + across * across) / 8;
  }

  double radius_;
  CapContour contour_;
  const TessellationTarget& target_;
  double from_apex_;
  MeshBuilder builder_;
  std::vector<Column> columns_;
  std::uint32_t right_ = 0, left_ = 0;
};

/// Tilts of the rows from the near side of the rim to the far one, without these, with the contour
/// among them and at least one more on either side of it.
std::vector<double> tilts_of(double from_apex, double contour, int rows) {
  const double step = from_apex / rows;
  std::vector<double> tilts;
  const auto divide = [&](double from, double to) {
    const int parts = std::max(2, static_cast<int>(std::ceil((from - to) / step * (1 - 1e-9))));
    for (int k = 1; k < parts; ++k) tilts.push_back(from + (to - from) * k / parts);
  };
  divide(from_apex, contour);
  tilts.push_back(contour);
  divide(contour, -from_apex);
  return tilts;
}

/// Returns the silhouette with where it meets the base circle; none where it does not.
std::optional<CapContour> meeting(CapContour c, double base_radius) {
  if (!(std::fabs(c.at) < base_radius)) return std::nullopt;
  c.half = std::sqrt((base_radius - c.at) * (base_radius + c.at));
  return c;
}

}  // namespace

CapContour ball_of(const SphericalDishPrimitive& p) {
  CapContour c;
  c.ball = (p.radius / p.height * p.radius + p.height) / 2;
  c.centre = p.height - c.ball;
  return c;
}

std::optional<CapContour> CapContour::of(const SphericalDishPrimitive& p, const Vec3d& towards) {
  const double level = std::sqrt(towards.x * towards.x + towards.y * towards.y);
  if (!(level > 1e-9)) return std::nullopt;
  CapContour c = ball_of(p);
  c.out = {towards.x / level, towards.y / level, 0};
  c.across = {-c.out.y, c.out.x, 0};
  c.at = towards.z * c.centre / level;
  c.tilt = arc_tan2(-towards.z, level);
  return meeting(c, p.radius);
}

std::optional<CapContour> CapContour::from(const SphericalDishPrimitive& p, const Vec3d& eye) {
  CapContour c = ball_of(p);
  const double level = std::sqrt(eye.x * eye.x + eye.y * eye.y), up = eye.z - c.centre;
  const double distance = std::sqrt(level * level + up * up);
  if (!(level > 1e-9 * distance) || !(distance > kNearestEye * c.ball)) return std::nullopt;
  c.out = {eye.x / level, eye.y / level, 0};
  c.across = {-c.out.y, c.out.x, 0};
  // The silhouette lies in the plane of the points whose product with the eye, from the middle of
  // the ball, is the square of its radius.
  c.at = (c.ball * c.ball + c.centre * up) / level;
  c.tilt = arc_tan2(level, up) - arc_cos(c.ball / distance);
  return meeting(c, p.radius);
}

std::optional<Tessellation> contoured_cap(const SphericalDishPrimitive& p,
                                          const TessellationTarget& target, int segments,
                                          int rows) {
  const auto contour =
      target.eye ? CapContour::from(p, *target.eye) : CapContour::of(p, *target.towards);
  if (!contour) return std::nullopt;
  const double from_apex = 2 * arc_tan2(p.height, p.radius);
  if (!(from_apex - std::fabs(contour->tilt) > from_apex / rows / 4)) return std::nullopt;
  const auto on_rim = [&](double side) {
    const Vec3d q =
        (contour->out * contour->at + contour->across * (side * contour->half)) * (1 / p.radius);
    return SinCos{q.y, q.x};
  };
  const SinCos right = on_rim(-1), left = on_rim(1);
  const std::vector<SinCos> rim = rim_with(rim_of(target, p.radius, segments), {right, left});
  const auto place = [&](const SinCos& a) {
    const auto found = std::ranges::find_if(
        rim, [&](const SinCos& b) { return a.sin == b.sin && a.cos == b.cos; });
    return static_cast<std::size_t>(found - rim.begin());
  };
  const std::size_t first = place(right), last = place(left);
  if (first == rim.size() || last == rim.size()) return std::nullopt;
  const double widest = p.height > p.radius ? contour->ball : p.radius;
  return ContouredCap(p, *contour, target)
      .make(rim, first, last, 2 * kPi * widest / segments,
            tilts_of(from_apex, contour->tilt, rows));
}

}  // namespace strake::geometry::tessellation
