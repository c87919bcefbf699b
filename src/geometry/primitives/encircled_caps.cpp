// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/primitives/domes.hpp"
#include "geometry/primitives/mesh_builder.hpp"

// Dishes whose silhouette is a whole circle over the base circle (decision 0111). The
// planes of both meet in a line that misses the ball; all planes through it cut the ball in circles
// that do not meet, and these are the rows of the net. The columns are at right angles to them:
// circles through the two points in which planes through the line touch the ball, of which one,
// within the silhouette, is the pole. Such a net is the image of one of meridians and parallels
// under a map that takes circles to circles: its quads are planar, and face the right way however
// large they are.

namespace strake::geometry::tessellation {
namespace {

/// A point or direction of the upright plane through the eye: along `out`, and up from the base.
struct Upright {
  double out = 0, up = 0;
};

class EncircledCap {
 public:
  EncircledCap(const SphericalDishPrimitive& p, const TessellationTarget& target)
      : p_(p), ball_(ball_of(p)) {
    const Vec3d viewer = target.eye ? *target.eye - Vec3d{0, 0, ball_.centre} : *target.towards;
    const double distance = std::sqrt(dot(viewer, viewer));
    // Of a view in one direction the eye is infinitely far away.
    const double nearness = target.eye ? 1 / distance : 0;
    const double level = std::sqrt(viewer.x * viewer.x + viewer.y * viewer.y) / distance;
    const double up = viewer.z / distance;
    out_ = level > 0 ? Vec3d{viewer.x, viewer.y, 0} * (1 / (level * distance)) : Vec3d{1, 0, 0};
    from_apex_ = 2 * arc_tan2(p.height, p.radius);
    if (!(kNearestEye * ball_.ball * nearness < 1)) return;
    const double middle = arc_tan2(level, up), half = arc_cos(ball_.ball * nearness);
    near_ = within_turn(middle + half);
    far_ = within_turn(middle - half);
    if (near_ < far_) std::swap(near_, far_);
    const double plane = ball_.ball * ball_.ball * nearness + ball_.centre * up;
    is_whole_ = std::fabs(plane) > p.radius * level && near_ < from_apex_ && far_ > -from_apex_;
    if (!is_whole_) return;
    slope_ = level / plane;
    set_pole();
  }

  /// Returns the net; none where there is no such silhouette, or it nearly touches the base circle.
  [[nodiscard]] std::optional<Tessellation> make(const std::vector<SinCos>& rim, int rows) {
    // In rows: narrower than that, the net between the two circles is made of slivers.
    constexpr double kNarrowest = 0.01;
    const double step = from_apex_ / rows;
    const double to_near = from_apex_ - near_, to_far = far_ + from_apex_;
    if (!is_whole_ || !(std::min(to_near, to_far) > kNarrowest * step)) return std::nullopt;
    std::vector<double> tilts;
    const auto add = [&](double from, double to) {
      const int parts =
          std::max(1, static_cast<int>(std::ceil(std::fabs(to - from) / step * (1 - 1e-9))));
      for (int k = 0; k < parts; ++k) tilts.push_back(from + (to - from) * k / parts);
    };
    // On the side where the circles are farther from each other.
    if (to_near > to_far)
      add(from_apex_, near_);
    else
      add(-from_apex_, far_);
    if (near_ - pole_ > pole_ - far_)
      add(near_, pole_);
    else
      add(far_, pole_);
    return net(rim, tilts);
  }

 private:
  using Row = std::vector<Vec3d>;

  [[nodiscard]] static double within_turn(double angle) {
    return angle > kPi ? angle - 2 * kPi : angle;
  }
  [[nodiscard]] Upright on_ball(double tilt) const {
    const SinCos t = sin_cos(tilt);
    return {ball_.ball * t.sin, ball_.centre + ball_.ball * t.cos};
  }
  [[nodiscard]] Vec3d placed(const Upright& at, double across) const {
    return {out_.x * at.out - out_.y * across, out_.y * at.out + out_.x * across, at.up};
  }

  /// The points where planes through the line touch the ball lie on that line's polar: out = offset
  /// + lean·(up - centre).
  void set_pole() {
    lean_ = slope_ * ball_.centre;
    offset_ = slope_ * ball_.ball * ball_.ball;
    const double a = 1 + lean_ * lean_, b = lean_ * offset_;
    const double c = (offset_ - ball_.ball) * (offset_ + ball_.ball);
    const double up = (std::sqrt(std::max(0.0, b * b - a * c)) - b) / a;
    pole_ = arc_tan2(offset_ + lean_ * up, up);
  }

  /// Where the column of a point of the base circle meets the row through a point of the upright
  /// plane.
  [[nodiscard]] Vec3d crossing(const Upright& of_row, const Upright& base, double across) const {
    // Along the row, in the upright plane: towards the line that all rows' planes have in common.
    const Upright along{1 - of_row.out * slope_, -of_row.up * slope_};
    const Upright middle = on_polar(of_row, along);
    const Upright foot = on_polar({0, 0}, {1, 0});
    // How far a column leaves the polar, square to it, for each unit across.
    const double leaves = base.out - foot.out;
    const double turn = leaves / (along.out - lean_ * along.up);
    const Upright way{along.out * turn, along.up * turn};
    const double a = way.out * way.out + way.up * way.up + across * across;
    const double rise = middle.up - ball_.centre;
    const double b = middle.out * way.out + rise * way.up;
    const double c = middle.out * middle.out + rise * rise - ball_.ball * ball_.ball;
    const double s = (std::sqrt(std::max(0.0, b * b - a * c)) - b) / a;
    return placed({middle.out + s * way.out, middle.up + s * way.up}, s * across);
  }
  [[nodiscard]] Upright on_polar(const Upright& from, const Upright& along) const {
    const double s =
        (offset_ + lean_ * (from.up - ball_.centre) - from.out) / (along.out - lean_ * along.up);
    return {from.out + s * along.out, from.up + s * along.up};
  }

  /// A column's point on the row through a tilt.
  [[nodiscard]] Vec3d on_row(double tilt, const SinCos& column) const {
    const Vec3d base = on_base(column);
    return crossing(on_ball(tilt), {dot(base, out_), 0}, out_.x * base.y - out_.y * base.x);
  }
  [[nodiscard]] Vec3d on_base(const SinCos& column) const {
    return {p_.radius * column.cos, p_.radius * column.sin, 0};
  }

  /// Returns the columns through the base circle's vertices, and more between two of them that
  /// spread: of more than half a ball, those on the side of the pole are far from each other where
  /// the ball is wide.
  [[nodiscard]] std::vector<SinCos> columns_of(const std::vector<SinCos>& rim,
                                               const std::vector<double>& tilts) const {
    if (!(p_.height > p_.radius)) return rim;
    const double widest = 2 * kPi * ball_.ball / static_cast<double>(rim.size());
    std::vector<SinCos> columns;
    for (std::size_t k = 0; k < rim.size(); ++k) {
      columns.push_back(rim[k]);
      divide(rim[k], rim[k + 1 == rim.size() ? 0 : k + 1], tilts, widest, columns, 0);
    }
    return columns;
  }
  void divide(const SinCos& from, const SinCos& to, const std::vector<double>& tilts, double widest,
              std::vector<SinCos>& columns, int depth) const {
    constexpr int kDeepest = 12;
    constexpr double kSlack = 1.05;
    const auto chord = [&](double tilt) {
      const Vec3d across = on_row(tilt, to) - on_row(tilt, from);
      return dot(across, across);
    };
    const double largest = kSlack * widest;
    if (depth == kDeepest ||
        std::ranges::none_of(tilts, [&](double tilt) { return chord(tilt) > largest * largest; }))
      return;
    const double x = from.cos + to.cos, y = from.sin + to.sin, length = std::sqrt(x * x + y * y);
    const SinCos middle{y / length, x / length};
    divide(from, middle, tilts, widest, columns, depth + 1);
    columns.push_back(middle);
    divide(middle, to, tilts, widest, columns, depth + 1);
  }

  [[nodiscard]] Tessellation net(const std::vector<SinCos>& rim, const std::vector<double>& tilts) {
    const std::vector<SinCos> columns = columns_of(rim, tilts);
    std::vector<Row> rows;
    for (std::size_t i = 0; i < tilts.size(); ++i) {
      rows.emplace_back();
      for (const SinCos& a : columns)
        rows.back().push_back(i == 0 ? on_base(a) : on_row(tilts[i], a));
    }
    return meshed(rows);
  }

  [[nodiscard]] Tessellation meshed(const std::vector<Row>& rows) {
    const std::size_t count = rows.front().size();
    MeshBuilder builder;
    std::vector<std::uint32_t> before, row;
    double widest = 0;  // circle of a facet, its radius squared
    for (std::size_t i = 0; i < rows.size(); ++i) {
      row.clear();
      for (const Vec3d& v : rows[i]) row.push_back(builder.vertex(v));
      if (i == 0) builder.polygon(row, true);
      for (std::size_t k = 0; k < count && i > 0; ++k) {
        const std::size_t next = k + 1 == count ? 0 : k + 1;
        builder.quad(before[k], before[next], row[next], row[k]);
        widest = std::max(widest, circle_squared(rows[i - 1][k], rows[i - 1][next], rows[i][k]));
      }
      std::swap(before, row);
    }
    const Vec3d top = placed(on_ball(pole_), 0);
    const std::uint32_t pole = builder.vertex(top);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t next = k + 1 == count ? 0 : k + 1;
      builder.quad(before[k], before[next], pole, pole);
      widest = std::max(widest, circle_squared(rows.back()[k], rows.back()[next], top));
    }
    // No point of a facet is farther under the ball than the middle of its circle.
    const double under = std::sqrt(std::max(0.0, ball_.ball * ball_.ball - widest));
    return std::move(builder).take(widest / (ball_.ball + under));
  }

  /// Returns the square of the radius of the circle through three points; 0 where they are in line.
  [[nodiscard]] static double circle_squared(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d u = b - a, v = c - b, w = a - c, area = cross(u, v);
    const double square = dot(area, area);
    return square > 0 ? dot(u, u) * dot(v, v) * dot(w, w) / (4 * square) : 0;
  }

  const SphericalDishPrimitive& p_;
  CapContour ball_;
  Vec3d out_;
  double from_apex_ = 0;
  double near_ = 0, far_ = 0, pole_ = 0;  ///< tilts of the silhouette on either side, of the pole
  bool is_whole_ = false;
  double slope_ = 0;  ///< 1 over where the planes of both circles meet, along `out`
  double lean_ = 0, offset_ = 0;
};

}  // namespace

std::optional<Tessellation> encircled_cap(const SphericalDishPrimitive& p,
                                          const TessellationTarget& target,
                                          const std::vector<SinCos>& rim, int rows) {
  return EncircledCap(p, target).make(rim, rows);
}

}  // namespace strake::geometry::tessellation
