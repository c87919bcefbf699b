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

// Dishes whose silhouette from an eye is a whole circle over the base circle (decision 0111). The
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
  EncircledCap(const SphericalDishPrimitive& p, const Vec3d& eye) : p_(p), ball_(ball_of(p)) {
    const double level = std::sqrt(eye.x * eye.x + eye.y * eye.y), up = eye.z - ball_.centre;
    distance_ = std::sqrt(level * level + up * up);
    out_ = level > 0 ? Vec3d{eye.x / level, eye.y / level, 0} : Vec3d{1, 0, 0};
    from_apex_ = 2 * arc_tan2(p.height, p.radius);
    if (!(distance_ > kNearestEye * ball_.ball)) return;
    const double middle = arc_tan2(level, up), half = arc_cos(ball_.ball / distance_);
    near_ = within_turn(middle + half);
    far_ = within_turn(middle - half);
    if (near_ < far_) std::swap(near_, far_);
    const double plane = ball_.ball * ball_.ball + ball_.centre * up;
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

  [[nodiscard]] Tessellation net(const std::vector<SinCos>& rim, const std::vector<double>& tilts) {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < tilts.size(); ++i) {
      rows.emplace_back();
      const Upright of_row = on_ball(tilts[i]);
      for (const SinCos& a : rim) {
        const Vec3d base{p_.radius * a.cos, p_.radius * a.sin, 0};
        const Upright in_plane{dot(base, out_), 0};
        const double across = out_.x * base.y - out_.y * base.x;
        rows.back().push_back(i == 0 ? base : crossing(of_row, in_plane, across));
      }
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
  double distance_ = 0, from_apex_ = 0;
  double near_ = 0, far_ = 0, pole_ = 0;  ///< tilts of the silhouette on either side, of the pole
  bool is_whole_ = false;
  double slope_ = 0;  ///< 1 over where the planes of both circles meet, along `out`
  double lean_ = 0, offset_ = 0;
};

}  // namespace

std::optional<Tessellation> encircled_cap(const SphericalDishPrimitive& p,
                                          const TessellationTarget& target,
                                          const std::vector<SinCos>& rim, int rows) {
  return EncircledCap(p, *target.eye).make(rim, rows);
}

}  // namespace strake::geometry::tessellation
