// SPDX-License-Identifier: Apache-2.0
#include "hlr/occluders/occlusion_buffer.hpp"

#include <algorithm>
#include <cmath>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::hlr {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();
constexpr float kNothing = -kEndless;
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostAcross = 4096;
constexpr std::size_t kBandRows = 64;
/// Relative margin for rounding: doubles hold view coordinates and what is computed from them far
/// more exactly, and a whole unit is added where they are compared.
constexpr double kShare = 1e-12;
/// With more gaps the rest of the edge is one: each is a query of its own.
constexpr std::size_t kMostGaps = 16;
/// A box over more tiles is not looked up: its edges are, one by one.
constexpr double kMostInBox = 1024;
/// Margin at the sides of tiles, in tiles, for the place of a point of an edge.
constexpr double kBeside = 1e-6;

double as_double(std::int64_t x) { return static_cast<double>(x); }

/// A polygon of a body, or the outline of a convex part of it, whose box holds a tile or more.
struct Large {
  const OccluderPolygon* polygon = nullptr;
  std::uint32_t body = 0;
  std::uint32_t convex = kNoPart;  ///< the part of the shape, where the polygon is its outline
  float v0 = 0, v1 = 0;            ///< rounded outwards; there are millions of these

  static constexpr std::uint32_t kNoPart = 0xffffffffU;
};

/// How the depth of a plane changes on paper, and how far behind it a point must lie.
struct Slope {
  double by_u = 0, by_v = 0, behind = 0;

  [[nodiscard]] bool is_finite() const {
    return std::isfinite(by_u) && std::isfinite(by_v) && std::isfinite(behind);
  }
};

/// A plane by a point of it on paper.
struct DepthPlane {
  ViewPoint at;
  Slope slope;
};

/// Solves for the plane's depth with the inverse of the projection's matrix.
class Planes {
 public:
  Planes(const ViewProjection& projection, std::int64_t contact) : contact_(as_double(contact)) {
    const geometry::Vec3l x[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double m[3][3];
    for (int k = 0; k < 3; ++k) {
      const ViewPoint p = projection(x[k]);
      m[0][k] = as_double(p.u);
      m[1][k] = as_double(p.v);
      m[2][k] = as_double(p.w);
    }
    // Rows of the inverse are cross products of columns; its columns are those of rows.
    const auto cross = [&](int i, int j, double* out) {
      for (int k = 0; k < 3; ++k)
        out[k] = m[i][(k + 1) % 3] * m[j][(k + 2) % 3] - m[i][(k + 2) % 3] * m[j][(k + 1) % 3];
    };
    cross(1, 2, along_u_);
    cross(2, 0, along_v_);
    cross(0, 1, along_w_);
    const auto& d = projection.direction();
    squared_ = as_double(geometry::dot(d, d));
    direction_ = d.as<double>();
  }

  [[nodiscard]] double contact() const { return contact_; }

  [[nodiscard]] Slope of(const ExactNormal& normal) const {
    double n[3], sum = 0;
    for (int k = 0; k < 3; ++k) {
      n[k] = static_cast<double>(normal[static_cast<std::size_t>(k)]);
      sum += std::fabs(n[k]);
    }
    const auto dot = [&](const double* x) { return n[0] * x[0] + n[1] * x[1] + n[2] * x[2]; };
    const double w = dot(along_w_);
    const double facing =
        std::fabs(n[0] * direction_.x + n[1] * direction_.y + n[2] * direction_.z);
    // Nearly edge-on, rounding of the normal would change the slope by more than kShare.
    const double size = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    if (!(facing * facing > 1e-4 * size * squared_)) return {.behind = kNever};
    return {-dot(along_u_) / w, -dot(along_v_) / w, contact_ * sum * squared_ / facing};
  }

 private:
  double contact_, squared_ = 1;
  double along_u_[3], along_v_[3], along_w_[3];
  geometry::Vec3d direction_;
};

}  // namespace

/// Fills bands of rows.
class OcclusionBuffer::Painter {
 public:
  Painter(OcclusionBuffer& occlusion_buffer, std::span<const BodyInstance> placed,
          const ViewProjection& projection, std::int64_t contact)
      : occlusion_buffer_(occlusion_buffer),
        placed_(placed),
        projection_(projection),
        planes_(projection, contact) {}

  /// Lists the polygons of a body whose box holds a tile. A convex part, as a cylinder, may cover
  /// tiles that none of its polygons covers: its outline at the depth of its farthest corner does.
  void list(std::uint32_t body, std::vector<Large>& out) const {
    const BodyInstance& placed = placed_[body];
    if (placed.shape == nullptr || !placed.opaque || placed.cut || placed.repeated ||
        !large(placed.shape->box))
      return;
    const auto add = [&](const OccluderPolygon& polygon, std::uint32_t convex) {
      const auto lo = static_cast<float>(polygon.box.lo.v + placed.at.v);
      const auto hi = static_cast<float>(polygon.box.hi.v + placed.at.v);
      out.push_back(
          {&polygon, body, convex, std::nextafter(lo, -kEndless), std::nextafter(hi, kEndless)});
    };
    const ProjectedShape& shape = *placed.shape;
    for (std::uint32_t p = 0; p < shape.parts.size(); ++p) {
      const OccluderPart& part = shape.parts[p];
      const bool outline = part.has_outline && part.last - part.first > 1 && large(part.box);
      if (outline) add(part.outline, p);
      // What the back of a convex part covers its outline covers as well.
      for (std::uint32_t i = part.first; i < part.last; ++i)
        if (const OccluderPolygon& polygon = shape.polygons[i];
            large(polygon.box) && !polygon.edge_on && !(outline && polygon.back))
          add(polygon, Large::kNoPart);
    }
  }

  void paint(std::span<const Large> all, std::size_t first_row, std::size_t last_row) const {
    const double low =
        occlusion_buffer_.v0_ + occlusion_buffer_.height_ * static_cast<double>(first_row);
    const double high =
        occlusion_buffer_.v0_ + occlusion_buffer_.height_ * static_cast<double>(last_row);
    for (const Large& large : all)
      if (large.v0 < high && large.v1 > low) paint(large, first_row, last_row);
  }

 private:
  struct Span {
    double lo, hi;
  };

  [[nodiscard]] bool large(const ViewBox& box) const {
    return !box.empty() && as_double(box.hi.u - box.lo.u) > occlusion_buffer_.width_ &&
           as_double(box.hi.v - box.lo.v) > occlusion_buffer_.height_;
  }

  void paint(const Large& large, std::size_t first_row, std::size_t last_row) const {
    const BodyInstance& placed = placed_[large.body];
    const auto corners = std::span(placed.shape->corners)
                             .subspan(large.polygon->first_corner, large.polygon->corners);
    const DepthPlane plane = plane_of(large);
    if (!plane.slope.is_finite()) return;
    const auto row_of = [&](double v) {
      return static_cast<std::size_t>(
          std::clamp(std::floor((v - occlusion_buffer_.v0_) / occlusion_buffer_.height_), 0.0,
                     static_cast<double>(occlusion_buffer_.rows_)));
    };
    const std::size_t from = std::max(first_row, row_of(large.v0));
    const std::size_t to = std::min(last_row, row_of(large.v1) + 1);
    for (std::size_t row = from; row < to; ++row) {
      const double v0 =
          occlusion_buffer_.v0_ + occlusion_buffer_.height_ * static_cast<double>(row);
      const double v1 = v0 + occlusion_buffer_.height_;
      const Span lower = chord(corners, placed.at, v0), upper = chord(corners, placed.at, v1);
      paint_row(row, {std::max(lower.lo, upper.lo), std::min(lower.hi, upper.hi)}, plane);
    }
  }

  /// Returns the plane of a polygon; of an outline, the level of the part's farthest corner.
  [[nodiscard]] DepthPlane plane_of(const Large& large) const {
    const BodyInstance& placed = placed_[large.body];
    if (large.convex == Large::kNoPart)
      return {projection_(large.polygon->at.as<std::int64_t>()) + placed.at,
              planes_.of(placed.shape->normal(*large.polygon))};
    const OccluderPart& part = placed.shape->parts[large.convex];
    ViewPoint at = placed.at;
    at.w += part.farthest;
    return {at, {.behind = planes_.contact() * part.deep_per_contact}};
  }

  /// Returns the open interval of a polygon at height v, shortened by the bound of rounding.
  static Span chord(std::span<const PaperCorner> corners, const ViewPoint& at, double v) {
    Span span{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const PaperCorner& p = corners[i];
      const PaperCorner& q = corners[i + 1 < corners.size() ? i + 1 : 0];
      const double up = as_double(q.v - p.v), right = as_double(q.u - p.u);
      const double above = v - as_double(p.v + at.v);
      const double margin = 1 + kShare * (std::fabs(v) + std::fabs(as_double(p.u + at.u)));
      if (up == 0) {
        if (right > 0 ? above <= margin : -above <= margin) return {1, -1};
        continue;
      }
      const double across = right / up * above;
      const double u = as_double(p.u + at.u) + across;
      const double slack = margin * (1 + std::fabs(right / up)) + kShare * std::fabs(across);
      if (up > 0)
        span.hi = std::min(span.hi, u - slack);
      else
        span.lo = std::max(span.lo, u + slack);
    }
    return span;
  }

  void paint_row(std::size_t row, const Span& span, const DepthPlane& plane) const {
    if (!(span.lo < span.hi)) return;
    const auto& [at, slope] = plane;
    const OcclusionBuffer& c = occlusion_buffer_;
    const double first = std::ceil((span.lo - c.u0_) / c.width_ + kBeside);
    const double last = std::floor((span.hi - c.u0_) / c.width_ - kBeside);
    if (!(first < last)) return;
    const auto from = static_cast<std::size_t>(std::max(first, 0.0));
    const auto to =
        static_cast<std::size_t>(std::clamp(last, 0.0, static_cast<double>(c.columns_)));
    // Start at the farthest corner of the first tile, and go on by steps.
    const double v = c.v0_ + c.height_ * static_cast<double>(row + (slope.by_v < 0 ? 1 : 0));
    const double u = c.u0_ + (slope.by_u < 0 ? c.width_ : 0);
    const double rise_v = slope.by_v * (v - as_double(at.v));
    const double base = as_double(at.w) + rise_v + slope.by_u * (u - as_double(at.u));
    const double size = std::fabs(as_double(at.w)) + std::fabs(rise_v) +
                        std::fabs(slope.by_u) * (std::fabs(u) + std::fabs(as_double(at.u)) +
                                                 c.width_ * static_cast<double>(c.columns_));
    const double start = base - slope.behind * (1 + 1e-9) - 2 - kShare * size;
    const double step = slope.by_u * c.width_;
    float* const depth = occlusion_buffer_.depth_.data() + row * c.columns_;
    for (std::size_t column = from; column < to; ++column) {
      // Rounded to the next float below.
      const double w = start + step * static_cast<double>(column);
      const auto f = static_cast<float>(w - std::fabs(w) * 1.2e-7);
      depth[column] = std::max(depth[column], f);
    }
  }

  OcclusionBuffer& occlusion_buffer_;
  std::span<const BodyInstance> placed_;
  const ViewProjection& projection_;
  Planes planes_;
};

Result<OcclusionBuffer> OcclusionBuffer::of(std::span<const BodyInstance> placed,
                                            const ViewProjection& projection, std::int64_t contact,
                                            std::size_t tiles, const parallel::Context& context) {
  OcclusionBuffer occlusion_buffer;
  ViewBox box;
  for (const BodyInstance& p : placed)
    if (p.shape != nullptr && p.opaque && !p.shape->box.empty())
      box.include(p.shape->box.moved(p.at));
  if (box.empty() || box.lo.u == box.hi.u || box.lo.v == box.hi.v) return occlusion_buffer;
  const auto across = static_cast<std::size_t>(std::sqrt(static_cast<double>(tiles)));
  occlusion_buffer.columns_ = occlusion_buffer.rows_ =
      std::clamp<std::size_t>(across, 16, kMostAcross);
  occlusion_buffer.u0_ = as_double(box.lo.u);
  occlusion_buffer.v0_ = as_double(box.lo.v);
  occlusion_buffer.width_ =
      (as_double(box.hi.u) - occlusion_buffer.u0_) / static_cast<double>(occlusion_buffer.columns_);
  occlusion_buffer.height_ =
      (as_double(box.hi.v) - occlusion_buffer.v0_) / static_cast<double>(occlusion_buffer.rows_);
  const Painter painter(occlusion_buffer, placed, projection, contact);
  const auto large = parallel::collect<Large>(
      context, {.name = "hidden lines: large faces", .n = placed.size(), .grain = 256},
      [&](std::size_t body, std::vector<Large>& out) {
        painter.list(static_cast<std::uint32_t>(body), out);
      });
  if (!large) return large.error();
  if (large->empty()) return OcclusionBuffer();
  occlusion_buffer.depth_.assign(occlusion_buffer.columns_ * occlusion_buffer.rows_, kNothing);
  const std::size_t bands = (occlusion_buffer.rows_ + kBandRows - 1) / kBandRows;
  const Status painted = parallel::for_each(
      context, {.name = "hidden lines: covered tiles", .n = bands}, [&](std::size_t band) {
        painter.paint(*large, band * kBandRows,
                      std::min(occlusion_buffer.rows_, (band + 1) * kBandRows));
      });
  if (!painted) return painted.error();
  return occlusion_buffer;
}

/// A segment in units of tiles, along the side of the paper along which it runs.
class OcclusionBuffer::TileTraversal {
 public:
  TileTraversal(const OcclusionBuffer& occlusion_buffer, const ViewPoint& a, const ViewPoint& b)
      : occlusion_buffer_(occlusion_buffer) {
    const double au = (as_double(a.u) - occlusion_buffer.u0_) / occlusion_buffer.width_;
    const double bu = (as_double(b.u) - occlusion_buffer.u0_) / occlusion_buffer.width_;
    const double av = (as_double(a.v) - occlusion_buffer.v0_) / occlusion_buffer.height_;
    const double bv = (as_double(b.v) - occlusion_buffer.v0_) / occlusion_buffer.height_;
    by_column_ = std::fabs(bu - au) >= std::fabs(bv - av);
    x_ = by_column_ ? au : av;
    dx_ = by_column_ ? bu - au : bv - av;
    y_ = by_column_ ? av : au;
    dy_ = by_column_ ? bv - av : bu - au;
    w_ = as_double(a.w);
    dw_ = as_double(b.w) - w_;
    slack_ = 1 + kShare * (std::fabs(w_) + std::fabs(dw_));
    across_ = static_cast<double>(by_column_ ? occlusion_buffer.rows_ : occlusion_buffer.columns_);
    along_ = static_cast<double>(by_column_ ? occlusion_buffer.columns_ : occlusion_buffer.rows_);
  }

  void find_gaps(const SegmentRange& part, std::vector<SegmentRange>& gaps) const {
    const auto& [start, end] = part;
    const double sign = dx_ > 0 ? 1 : -1;
    const double last = x_ + dx_ * end;
    double t = start, tile = std::floor(x_ + dx_ * start);
    // Where rounding puts an end into the wrong column, the right one is beside it.
    if (!covered(std::floor(x_ + dx_ * start - sign * kBeside), start, start))
      add_gap({start, start}, part, gaps);
    for (;;) {
      const double side = sign > 0 ? tile + 1 : tile;
      const bool ends = dx_ == 0 || (sign > 0 ? side >= last : side <= last);
      const double next = ends ? end : (side - x_) / dx_;
      if (!covered(tile, t, next)) add_gap({t, next}, part, gaps);
      if (ends) break;
      t = next;
      tile += sign;
    }
    if (!covered(std::floor(last + sign * kBeside), end, end)) add_gap({end, end}, part, gaps);
  }

 private:
  /// Appends a gap that is a little longer, lest rounding has put its ends into the next column.
  void add_gap(const SegmentRange& gap, const SegmentRange& part,
               std::vector<SegmentRange>& gaps) const {
    const double step = dx_ == 0 ? part.hi - part.lo : kBeside / std::fabs(dx_);
    const double lo = std::max(part.lo, gap.lo - step), hi = std::min(part.hi, gap.hi + step);
    if (!gaps.empty() && (lo <= gaps.back().hi || gaps.size() == kMostGaps))
      gaps.back().hi = hi;
    else
      gaps.push_back({lo, hi});
  }

  /// Returns whether the interval from t to u, in one column of tiles, is covered.
  [[nodiscard]] bool covered(double tile, double t, double u) const {
    const double w = std::max(w_ + dw_ * t, w_ + dw_ * u) + slack_;
    const double y0 = y_ + dy_ * t, y1 = y_ + dy_ * u;
    const double low = std::floor(std::min(y0, y1) - kBeside);
    const double high = std::floor(std::max(y0, y1) + kBeside);
    if (tile < 0 || tile >= along_ || low < 0 || high >= across_) return false;
    for (double y = low; y <= high; ++y)
      if (!(static_cast<double>(
                depth(static_cast<std::size_t>(tile), static_cast<std::size_t>(y))) > w))
        return false;
    return true;
  }

  [[nodiscard]] float depth(std::size_t x, std::size_t y) const {
    return by_column_ ? occlusion_buffer_.depth_[y * occlusion_buffer_.columns_ + x]
                      : occlusion_buffer_.depth_[x * occlusion_buffer_.columns_ + y];
  }

  const OcclusionBuffer& occlusion_buffer_;
  bool by_column_ = true;
  double x_ = 0, dx_ = 0, y_ = 0, dy_ = 0, w_ = 0, dw_ = 0, slack_ = 0;
  double along_ = 0, across_ = 0;
};

void OcclusionBuffer::find_gaps(const ViewPoint& a, const ViewPoint& b, const SegmentRange& part,
                                std::vector<SegmentRange>& gaps) const {
  gaps.clear();
  TileTraversal(*this, a, b).find_gaps(part, gaps);
}

bool OcclusionBuffer::covers(const ViewBox& box) const {
  if (empty() || box.empty()) return false;
  const auto first = [](double x) { return std::floor(x - kBeside); };
  const auto last = [](double x) { return std::floor(x + kBeside); };
  const double left = first((as_double(box.lo.u) - u0_) / width_);
  const double right = last((as_double(box.hi.u) - u0_) / width_);
  const double low = first((as_double(box.lo.v) - v0_) / height_);
  const double high = last((as_double(box.hi.v) - v0_) / height_);
  if (left < 0 || low < 0 || right >= static_cast<double>(columns_) ||
      high >= static_cast<double>(rows_) || (right - left + 1) * (high - low + 1) > kMostInBox)
    return false;
  const double nearest = as_double(box.hi.w);
  const double w = nearest + 1 + kShare * std::fabs(nearest);
  const auto count = static_cast<std::size_t>(right - left) + 1;
  for (auto row = static_cast<std::size_t>(low); row <= static_cast<std::size_t>(high); ++row) {
    const auto tiles =
        std::span(depth_).subspan(row * columns_ + static_cast<std::size_t>(left), count);
    if (!std::ranges::all_of(tiles, [&](float depth) { return depth > w; })) return false;
  }
  return true;
}

}  // namespace strake::hlr
