// SPDX-License-Identifier: Apache-2.0
#include "drawing/centre/axes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "geometry/numeric/trig.hpp"
#include "strake/geometry/primitive.hpp"

namespace strake::drawing {

namespace {

using geometry::Vec3d;

/// An axis that leans off the line of sight by a smaller sine is seen end-on: a cross stands for
/// it.
constexpr double kEndOn = 0.02;
/// A bend whose circle is so narrow on paper is the straight line that it looks like.
constexpr double kEdgeOn = 0.05;
/// Lines may lie so far outside of what they are the outlines of, mm: the snap and the sag.
constexpr double kBeside = 0.1;

/// The straight axis of a primitive in its own frame, and the largest radius about it.
struct LocalAxis {
  Vec3d a, b;
  double radius = 0;
};

/// The arc in the middle of a bend, in the XY plane of its own frame.
struct LocalBend {
  double radius = 0, angle = 0, tube = 0;
};

std::optional<LocalAxis> axis_of(const geometry::Primitive& primitive) {
  using geometry::is_full_turn;
  if (const auto* const c = std::get_if<geometry::CylinderPrimitive>(&primitive))
    return LocalAxis{{0, 0, c->height / -2}, {0, 0, c->height / 2}, c->radius};
  if (const auto* const s = std::get_if<geometry::SnoutPrimitive>(&primitive)) {
    const Vec3d top{s->offset_x / 2, s->offset_y / 2, s->height / 2};
    return LocalAxis{-top, top, std::max(s->bottom_radius, s->top_radius)};
  }
  if (const auto* const d = std::get_if<geometry::EllipticalDishPrimitive>(&primitive))
    return LocalAxis{{0, 0, 0}, {0, 0, d->height}, d->radius};
  if (const auto* const d = std::get_if<geometry::SphericalDishPrimitive>(&primitive))
    return LocalAxis{{0, 0, 0}, {0, 0, d->height}, d->radius};
  if (const auto* const t = std::get_if<geometry::CircularTorusPrimitive>(&primitive))
    if (is_full_turn(t->angle))
      return LocalAxis{
          {0, 0, -t->tube_radius}, {0, 0, t->tube_radius}, t->centre_radius + t->tube_radius};
  if (const auto* const t = std::get_if<geometry::RectangularTorusPrimitive>(&primitive))
    if (is_full_turn(t->angle))
      return LocalAxis{{0, 0, t->height / -2}, {0, 0, t->height / 2}, t->outer_radius};
  return std::nullopt;
}

std::optional<LocalBend> bend_of(const geometry::Primitive& primitive) {
  const auto* const t = std::get_if<geometry::CircularTorusPrimitive>(&primitive);
  if (t == nullptr || geometry::is_full_turn(t->angle)) return std::nullopt;
  return LocalBend{t->centre_radius, t->angle, t->tube_radius};
}

/// Intervals that cover a line, from its beginning to its end.
class AxisCover {
 public:
  void add(double from, double to) { all_.emplace_back(std::min(from, to), std::max(from, to)); }

  /// Returns the intervals within [0, length], in order; those nearer than `gap` are one.
  [[nodiscard]] std::vector<std::pair<double, double>> within(double length, double gap) {
    std::sort(all_.begin(), all_.end());
    std::vector<std::pair<double, double>> joined;
    for (const auto& [from, to] : all_) {
      const double a = std::max(from, 0.0), b = std::min(to, length);
      if (a > b) continue;
      if (!joined.empty() && a <= joined.back().second + gap)
        joined.back().second = std::max(joined.back().second, b);
      else
        joined.emplace_back(a, b);
    }
    return joined;
  }

 private:
  std::vector<std::pair<double, double>> all_;
};

/// The lines of an object from left to right: an object may have ten thousand primitives, each of
/// which requests those beside it.
class LinesAcross {
 public:
  explicit LinesAcross(std::span<const Line> lines) {
    for (const Line& line : lines) {
      // A pipe that is drawn as its axis needs no centre line.
      if (line.kind == hlr::EdgeKind::single_line) continue;
      by_left_.emplace_back(std::min(line.a_paper.x, line.b_paper.x), &line);
      widest_ = std::max(widest_, std::fabs(line.b_paper.x - line.a_paper.x));
    }
    std::ranges::sort(by_left_, {}, &Place::first);
  }

  /// Calls `f` with all lines that reach between two places, and maybe with others.
  template <class F>
  void between(double left, double right, F&& f) const {
    auto it = std::ranges::lower_bound(by_left_, left - widest_ - kBeside, {}, &Place::first);
    for (; it != by_left_.end() && it->first <= right + kBeside; ++it) f(*it->second);
  }

 private:
  using Place = std::pair<double, const Line*>;
  std::vector<Place> by_left_;
  double widest_ = 0;
};

class ObjectAxes {
 public:
  ObjectAxes(std::span<const Line> lines, const OrthographicPaper& paper, double min_diameter_mm,
             Axes2d& out)
      : lines_(lines),
        object_(lines.front().object),
        paper_(paper),
        least_(min_diameter_mm),
        out_(out) {}

  void add(const model::Body& body, const geometry::Primitive& primitive) {
    const geometry::Mat3d& m = body.placement.linear;
    const Vec3d x{m.row[0].x, m.row[1].x, m.row[2].x}, y{m.row[0].y, m.row[1].y, m.row[2].y};
    const double stretch = std::sqrt(std::max(dot(x, x), dot(y, y)));
    if (const auto axis = axis_of(primitive))
      straight(body.placement * axis->a, body.placement * axis->b, axis->radius * stretch);
    if (const auto bend = bend_of(primitive))
      curved(body.placement.translation, x * bend->radius, y * bend->radius, bend->angle,
             bend->tube * stretch);
  }

 private:
  [[nodiscard]] model::ObjectId object() const { return object_; }

  void straight(const Vec3d& a, const Vec3d& b, double radius_mm) {
    const double radius = radius_mm / paper_.scale();
    const Vec3d along = b - a;
    const double length_mm = std::sqrt(dot(along, along));
    if (!(2 * radius >= least_) || !(length_mm > 0)) return;
    const PaperPoint from = paper_.point(a), way = paper_.vector(along);
    const double length = std::sqrt(way.x * way.x + way.y * way.y);
    if (!(length > kEndOn * length_mm / paper_.scale()) || !(length > 1e-6)) return;
    // A rim reaches beyond the end of an axis that comes towards the viewer.
    const double rim = radius * std::fabs(dot(along, paper_.toward())) / length_mm;
    const PaperPoint unit{way.x / length, way.y / length};
    AxisCover cover = cover_of(from, unit, length, radius);
    const double over = overhang_mm(2 * radius);
    for (const auto& [s, t] : cover.within(length, 2 * over + rim)) {
      const bool first = s <= rim + kBeside, last = t >= length - rim - kBeside;
      const double begin = first ? 0 : s, end = last ? length : t;
      if (!(end - begin > 1e-3) || (!first && !last && end - begin < 2 * over)) continue;
      out_.parts.push_back({{from.x + unit.x * begin, from.y + unit.y * begin},
                            {from.x + unit.x * end, from.y + unit.y * end},
                            first ? rim + over : 0,
                            last ? rim + over : 0,
                            object(),
                            false,
                            radius});
    }
  }

  /// Returns which parts of a straight axis have lines no farther off than the radius.
  [[nodiscard]] AxisCover cover_of(const PaperPoint& from, const PaperPoint& unit, double length,
                                   double radius) const {
    const double end = from.x + unit.x * length, reach = radius + kBeside;
    AxisCover cover;
    lines_.between(std::min(from.x, end) - reach, std::max(from.x, end) + reach,
                   [&](const Line& line) {
                     const auto [s, t] = beside(line.a_paper, from, unit);
                     const auto [u, v] = beside(line.b_paper, from, unit);
                     if (std::max(std::fabs(t), std::fabs(v)) <= reach) cover.add(s, u);
                   });
    return cover;
  }

  /// Returns how far along an axis, and beside it, a point lies.
  static std::pair<double, double> beside(const PaperPoint& p, const PaperPoint& from,
                                          const PaperPoint& unit) {
    const double x = p.x - from.x, y = p.y - from.y;
    return {x * unit.x + y * unit.y, y * unit.x - x * unit.y};
  }

  void curved(const Vec3d& centre_mm, const Vec3d& u_mm, const Vec3d& v_mm, double angle,
              double tube_mm) {
    const double tube = tube_mm / paper_.scale();
    if (!(2 * tube >= least_)) return;
    const PaperCurve c{paper_.point(centre_mm), paper_.vector(u_mm), paper_.vector(v_mm)};
    const double area = c.u.x * c.v.y - c.u.y * c.v.x;
    const double square = dot(u_mm, u_mm) / (paper_.scale() * paper_.scale());
    if (!(std::fabs(area) > kEdgeOn * square)) return add_edge_on(c, angle, tube);
    const double ring = tube / std::sqrt(square) * square / std::fabs(area);
    AxisCover cover;
    const double reach = (std::fabs(c.u.x) + std::fabs(c.v.x)) * (1 + ring * 1.05);
    lines_.between(c.centre.x - reach, c.centre.x + reach, [&](const Line& line) {
      const auto [s, r] = around(c, area, line.a_paper, angle);
      const auto [t, q] = around(c, area, line.b_paper, angle);
      if (std::max(std::fabs(r - 1), std::fabs(q - 1)) <= ring * 1.05 &&
          std::fabs(s - t) < geometry::kPi / 2)
        cover.add(s, t);
    });
    const double gap = std::max(0.3, overhang_mm(2 * tube) / std::sqrt(square));
    for (const auto& [s, t] : cover.within(angle, gap)) {
      const double begin = s <= gap ? 0 : s, end = t >= angle - gap ? angle : t;
      if (end - begin >= gap) arc(c, begin, end);
    }
  }

  /// Returns the angle of a point on the ellipse, from before 0 to after the end of the arc, and
  /// its distance from the centre in radii.
  static std::pair<double, double> around(const PaperCurve& c, double area, const PaperPoint& p,
                                          double angle) {
    const double x = p.x - c.centre.x, y = p.y - c.centre.y;
    const double s = (x * c.v.y - y * c.v.x) / area, t = (c.u.x * y - c.u.y * x) / area;
    double at = geometry::arc_tan2(t, s);
    if (at < (angle - 2 * geometry::kPi) / 2) at += 2 * geometry::kPi;
    return {at, std::sqrt(s * s + t * t)};
  }

  void arc(const PaperCurve& c, double begin, double end) {
    constexpr double kStep = 0.05;
    const double steps = std::max(2.0, std::ceil((end - begin) / kStep));
    BendPart bend{{}, object()};
    for (double k = 0; k <= steps; ++k)
      bend.points.push_back(at(c, begin + (end - begin) * k / steps));
    out_.bends.push_back(std::move(bend));
  }

  static PaperPoint at(const PaperCurve& c, double angle) {
    const geometry::SinCos turn = geometry::sin_cos(angle);
    return {c.centre.x + c.u.x * turn.cos + c.v.x * turn.sin,
            c.centre.y + c.u.y * turn.cos + c.v.y * turn.sin};
  }

  /// A bend in a plane along the line of sight looks straight, from one of its ends to the other,
  /// or to where it turns back.
  void add_edge_on(const PaperCurve& c, double angle, double tube) {
    const PaperPoint a = at(c, 0), b = at(c, angle);
    const double x = b.x - a.x, y = b.y - a.y, length = std::sqrt(x * x + y * y);
    if (!(length > 1e-3)) return;
    const PaperPoint unit{x / length, y / length};
    AxisCover cover = cover_of(a, unit, length, tube);
    for (const auto& [s, t] : cover.within(length, overhang_mm(2 * tube)))
      if (t - s > 1e-3)
        out_.parts.push_back({{a.x + unit.x * s, a.y + unit.y * s},
                              {a.x + unit.x * t, a.y + unit.y * t},
                              0,
                              0,
                              object(),
                              false,
                              tube});
  }

  LinesAcross lines_;
  model::ObjectId object_;
  const OrthographicPaper& paper_;
  double least_;
  Axes2d& out_;
};

}  // namespace

double overhang_mm(double diameter_mm) { return std::clamp(diameter_mm / 4, 1.0, 3.0); }

void find_axes(const model::Model& model, std::span<const Line> lines,
               const OrthographicPaper& paper, double min_diameter_mm, Axes2d& out) {
  ObjectAxes axes(lines, paper, min_diameter_mm, out);
  const model::Object& object = model.object(lines.front().object);
  for (std::uint32_t b = 0; b < object.body_count; ++b) {
    const model::Body& body = model.bodies[object.first_body + b];
    const auto* const primitive =
        std::get_if<geometry::Primitive>(&model.shapes[model::index(body.shape)]);
    if (primitive != nullptr) axes.add(body, *primitive);
  }
}

}  // namespace strake::drawing
