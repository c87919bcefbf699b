// SPDX-License-Identifier: Apache-2.0
#include "support/pixel_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "hlr/prepare/view_job.hpp"
#include "model/scene/view_tessellation.hpp"

namespace strake::test {
namespace {

using geometry::Vec3d;
using geometry::Vec3l;

constexpr double kFar = -std::numeric_limits<double>::infinity();
constexpr std::uint32_t kNothing = 0xffffffffU;

// Tolerances.
//
// Depths are in grid units (µm) along the unit direction. Two surfaces that touch may be off by the
// contact distance, 3 units or two spacings of float32 coordinates, measured along the normal:
// nothing nearer by less hides, and of such a tie the object with the lower number is in front.
// Seen along a slope a distance makes a greater depth.
constexpr double kTie = 100;
// A line lies on the border of what it belongs to, so one of the pixels round it sees it, unless
// the gap through which it is seen is narrower than a pixel: the place is then rendered again, so
// much finer in each of the steps. In plant files bodies side by side leave gaps of micrometres.
constexpr std::array<int, 5> kFiner{8, 64, 512, 4096, 32768};
// A surface goes on from a pixel to the next as its plane says. It jumps where it is farther off
// than both planes allow, by a share of what they may bend within a pixel, and by so many pixels.
constexpr double kBend = 3, kJumpPixels = 4;
// A line is near when it passes through one of the two pixels or one beside them.
constexpr int kNearPixels = 1;

struct Sample {
  double depth = kFar;
  std::uint32_t object = kNothing;
  double du = 0, dv = 0;  ///< slopes of the surface

  [[nodiscard]] bool empty() const { return object == kNothing; }
};

struct Corner {
  double u = 0, v = 0, w = 0;
};

struct Face {
  std::array<Corner, 3> at;
  std::uint32_t object = 0;
  double du = 0, dv = 0;

  /// Its depth above a point, where it covers that.
  [[nodiscard]] std::optional<double> depth(double u, double v) const {
    double turn[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner &p = at[k], &q = at[(k + 1) % 3];
      turn[k] = (q.u - p.u) * (v - p.v) - (q.v - p.v) * (u - p.u);
    }
    const bool in = (turn[0] >= 0 && turn[1] >= 0 && turn[2] >= 0) ||
                    (turn[0] <= 0 && turn[1] <= 0 && turn[2] <= 0);
    if (!in) return std::nullopt;
    return at[0].w + du * (u - at[0].u) + dv * (v - at[0].v);
  }
};

Vec3d unit(const Vec3d& v) { return v * (1 / std::sqrt(dot(v, v))); }

class PixelView {
 public:
  PixelView(const model::Scene& scene, const hlr::View& view, int width) : width_(width) {
    const Vec3d d = view.direction.as<double>(), up = view.up.as<double>();
    toward_ = unit(d);
    right_ = unit(cross(up, d));
    up_ = cross(toward_, right_);
    if (!scene.bodies.empty()) origin_ = scene.bodies.front().origin;
    add_faces(scene);
    find_frame();
    fill_bins();
    render();
  }

  [[nodiscard]] Corner corner(const Vec3l& p) const {
    const Vec3d q = (p - origin_).as<double>();
    return {dot(right_, q), dot(up_, q), dot(toward_, q)};
  }
  [[nodiscard]] double pixel() const { return pixel_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int column(double u) const {
    return static_cast<int>(std::floor((u - left_) / pixel_));
  }
  [[nodiscard]] int row(double v) const {
    return static_cast<int>(std::floor((v - bottom_) / pixel_));
  }
  [[nodiscard]] bool inside(int x, int y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_;
  }
  [[nodiscard]] const Sample& at(int x, int y) const { return pixels_[index(x, y)]; }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  /// What is in front above a point.
  [[nodiscard]] Sample sample(double u, double v) const {
    Sample best;
    const int x = column(u) / kBin, y = row(v) / kBin;
    if (!inside(column(u), row(v))) return best;
    for (const std::uint32_t f :
         bins_[static_cast<std::size_t>(y) * static_cast<std::size_t>(bins_across_) +
               static_cast<std::size_t>(x)])
      if (const auto depth = faces_[f].depth(u, v)) put(best, faces_[f], *depth);
    return best;
  }

 private:
  static constexpr int kBin = 8;

  static void put(Sample& pixel, const Face& face, double depth) {
    const bool tie = std::fabs(depth - pixel.depth) <= kTie;
    if (tie ? face.object < pixel.object : depth > pixel.depth)
      pixel = {depth, face.object, face.du, face.dv};
  }

  void add_faces(const model::Scene& scene) {
    for (const model::GridBody& body : scene.bodies) {
      if (scene.model->bodies[body.body].color.alpha != 255) continue;
      for (const geometry::Part& part : scene.shapes[body.grid_shape].parts)
        for (const geometry::Triangle& t : part.triangles) {
          Face face;
          face.object = model::index(body.object);
          for (std::size_t k = 0; k < 3; ++k)
            face.at[k] = corner(body.origin + part.vertices[t[k]].as<std::int64_t>());
          const Corner &a = face.at[0], &b = face.at[1], &c = face.at[2];
          const double area = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
          // Seen edge-on it covers no pixel.
          if (std::fabs(area) < 1e-3) continue;
          face.du = ((b.w - a.w) * (c.v - a.v) - (c.w - a.w) * (b.v - a.v)) / area;
          face.dv = ((c.w - a.w) * (b.u - a.u) - (b.w - a.w) * (c.u - a.u)) / area;
          faces_.push_back(face);
        }
    }
  }

  void find_frame() {
    double right = -std::numeric_limits<double>::max(), top = right;
    left_ = bottom_ = std::numeric_limits<double>::max();
    for (const Face& face : faces_)
      for (const Corner& c : face.at) {
        left_ = std::min(left_, c.u);
        right = std::max(right, c.u);
        bottom_ = std::min(bottom_, c.v);
        top = std::max(top, c.v);
      }
    if (faces_.empty()) left_ = bottom_ = right = top = 0;
    pixel_ = std::max({right - left_, top - bottom_, 1.0}) / (width_ - 8);
    // Off the round numbers, where edges lie.
    left_ -= pixel_ * 3.7182818;
    bottom_ -= pixel_ * 3.4142136;
    height_ = static_cast<int>(std::ceil((top - bottom_) / pixel_)) + 4;
    pixels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  }

  struct Range {
    int x0, x1, y0, y1;
  };
  [[nodiscard]] Range range(const Face& face) const {
    const auto [u0, u1] = std::minmax({face.at[0].u, face.at[1].u, face.at[2].u});
    const auto [v0, v1] = std::minmax({face.at[0].v, face.at[1].v, face.at[2].v});
    return {std::clamp(column(u0), 0, width_ - 1), std::clamp(column(u1), 0, width_ - 1),
            std::clamp(row(v0), 0, height_ - 1), std::clamp(row(v1), 0, height_ - 1)};
  }

  void fill_bins() {
    bins_across_ = width_ / kBin + 1;
    bins_.resize(static_cast<std::size_t>(bins_across_) *
                 static_cast<std::size_t>(height_ / kBin + 1));
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      const Range r = range(faces_[f]);
      for (int y = r.y0 / kBin; y <= r.y1 / kBin; ++y)
        for (int x = r.x0 / kBin; x <= r.x1 / kBin; ++x)
          bins_[static_cast<std::size_t>(y) * static_cast<std::size_t>(bins_across_) +
                static_cast<std::size_t>(x)]
              .push_back(f);
    }
  }

  void render() {
    for (const Face& face : faces_) {
      const Range r = range(face);
      for (int y = r.y0; y <= r.y1; ++y)
        for (int x = r.x0; x <= r.x1; ++x) {
          const double u = left_ + (x + 0.5) * pixel_, v = bottom_ + (y + 0.5) * pixel_;
          if (const auto depth = face.depth(u, v)) put(pixels_[index(x, y)], face, *depth);
        }
    }
  }

  int width_, height_ = 0, bins_across_ = 0;
  Vec3d toward_, right_, up_;
  Vec3l origin_;
  double left_ = 0, bottom_ = 0, pixel_ = 1;
  std::vector<Face> faces_;
  std::vector<std::vector<std::uint32_t>> bins_;
  std::vector<Sample> pixels_;
};

std::string place(const PixelView& view, int x, int y) {
  return "pixel " + std::to_string(x) + "," + std::to_string(y) + " of " +
         std::to_string(view.width()) + "x" + std::to_string(view.height());
}

/// Calls visit(point) for points of a line, two a pixel or more, its ends left out.
template <class Visit>
void walk(const PixelView& view, const Corner& a, const Corner& b, Visit&& visit) {
  const double pixels = std::hypot(b.u - a.u, b.v - a.v) / view.pixel();
  const auto steps = static_cast<int>(std::ceil(pixels * 2)) + 1;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps;
    visit(Corner{a.u + (b.u - a.u) * t, a.v + (b.v - a.v) * t, a.w + (b.w - a.w) * t});
  }
}

/// Whether the surface in front is nearer than a point by more than what it climbs on the way.
bool hides(const Sample& front, const Corner& p, double u, double v) {
  if (front.empty()) return false;
  const double above = front.depth + front.du * (p.u - u) + front.dv * (p.v - v);
  const double tie = kTie * (1 + std::fabs(front.du) + std::fabs(front.dv));
  return std::min(front.depth, above) > p.w + tie;
}

enum class Observation { at_once, magnified, no };

/// Whether any of the pixels round a point of a line sees it.
Observation observe(const PixelView& view, const Corner& p) {
  const auto any = [&](double step) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        // Round the point, but not on it: there the line's own faces end.
        const double u = p.u + (dx + 0.17) * step, v = p.v + (dy + 0.13) * step;
        if (!hides(view.sample(u, v), p, u, v)) return true;
      }
    return false;
  };
  if (any(view.pixel())) return Observation::at_once;
  for (const int finer : kFiner)
    if (any(view.pixel() / finer)) return Observation::magnified;
  return Observation::no;
}

void check_lines(const PixelView& view, const hlr::Drawing& drawing, std::vector<bool>& inked,
                 PixelCheck& check) {
  for (const hlr::EdgePiece& piece : drawing.pieces) {
    if (piece.state != hlr::State::visible) continue;
    const Corner a = view.corner(piece.a), b = view.corner(piece.b);
    int last_x = -1, last_y = -1;
    walk(view, a, b, [&](const Corner& p) {
      const int x = view.column(p.u), y = view.row(p.v);
      if (!view.inside(x, y) || (x == last_x && y == last_y)) return;
      last_x = x;
      last_y = y;
      inked[view.index(x, y)] = true;
      // A wire may be seen through the solids of its own object.
      if (piece.kind == hlr::EdgeKind::polyline &&
          drawing.options.own_polylines == hlr::OwnPolylines::visible)
        return;
      ++check.line_pixels;
      const Observation how = observe(view, p);
      if (how == Observation::magnified) ++check.magnified;
      if (how != Observation::no) return;
      if (check.covered++ > 0 || !check.first.empty()) return;
      const Sample front = view.sample(p.u, p.v);
      check.first = place(view, x, y) + ": a line of object " +
                    std::to_string(model::index(piece.object)) + " lies " +
                    std::to_string(front.depth - p.w) + " um behind object " +
                    std::to_string(front.object) + ", whose slopes are " +
                    std::to_string(front.du) + " and " + std::to_string(front.dv);
    });
  }
}

/// Of neighbouring pixels.
bool jumps(const Sample& p, const Sample& q, double pixel, bool across) {
  if (p.empty() || q.empty()) return p.empty() != q.empty();
  const double slope_p = across ? p.du : p.dv, slope_q = across ? q.du : q.dv;
  const double off = std::fabs(q.depth - p.depth);
  const double may = kBend * (std::fabs(slope_p) + std::fabs(slope_q)) * pixel;
  return off > may + kJumpPixels * pixel;
}

void check_jumps(const PixelView& view, const std::vector<bool>& inked, PixelCheck& check) {
  const auto near_line = [&](int x0, int y0, int x1, int y1) {
    for (int y = std::min(y0, y1) - kNearPixels; y <= std::max(y0, y1) + kNearPixels; ++y)
      for (int x = std::min(x0, x1) - kNearPixels; x <= std::max(x0, x1) + kNearPixels; ++x)
        if (view.inside(x, y) && inked[view.index(x, y)]) return true;
    return false;
  };
  for (int y = 0; y < view.height(); ++y)
    for (int x = 0; x < view.width(); ++x)
      for (const bool across : {true, false}) {
        const int x1 = x + (across ? 1 : 0), y1 = y + (across ? 0 : 1);
        if (!view.inside(x1, y1)) continue;
        const Sample &p = view.at(x, y), &q = view.at(x1, y1);
        const bool jump = jumps(p, q, view.pixel(), across), border = p.object != q.object;
        if (jump) ++check.jumps;
        if (border) ++check.borders;
        if ((!jump && !border) || near_line(x, y, x1, y1)) continue;
        if (check.without_line++ == 0 && check.first.empty())
          check.first = place(view, x, y) + ": no line between object " + std::to_string(p.object) +
                        " and " + std::to_string(q.object) + (jump ? ", which are apart" : "");
      }
}

}  // namespace

PixelCheck check_by_pixels(const model::Scene& scene, const hlr::Drawing& drawing, int width) {
  PixelCheck check;
  // The meshes that the view is made of, with contours of round primitives.
  const auto tessellation_options = hlr::tessellation_of(drawing.view, drawing.options);
  if (!tessellation_options) return check;
  const auto tessellated = model::tessellate_for_view(scene, {}, *tessellation_options, {});
  if (!tessellated) return check;
  const PixelView view(*tessellated ? **tessellated : scene, drawing.view, width);
  std::vector<bool> inked(static_cast<std::size_t>(view.width()) *
                          static_cast<std::size_t>(view.height()));
  check_lines(view, drawing, inked, check);
  check_jumps(view, inked, check);
  return check;
}

}  // namespace strake::test
