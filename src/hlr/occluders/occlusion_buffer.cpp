// SPDX-License-Identifier: Apache-2.0
#include "hlr/occluders/occlusion_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();
constexpr float kNothing = -kEndless;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kMaxAcross = 4096;
/// Rows whose polygons are listed together, and rows that are painted as one item.
constexpr std::size_t kListedRows = 64;
constexpr std::size_t kPaintedRows = 8;
/// Tiles of a row whose farthest depth is kept, so that what lies behind all of them is passed by.
constexpr std::size_t kBlockTiles = 8;
/// Polygons in a row that are passed by together where none reaches into the rows.
constexpr std::size_t kBlockFaces = 256;
constexpr std::size_t kDepthClasses = 1024;
/// Relative margin for rounding: doubles hold view coordinates and what is computed from them far
/// more exactly, and a whole unit is added where they are compared.
constexpr double kShare = 1e-12;
/// With more gaps the rest of the edge is one: each is a query of its own.
constexpr std::size_t kMaxGaps = 16;
/// A box over more tiles is not looked up: its edges are, one by one.
constexpr double kMaxInBox = 1024;
/// Margin at the sides of tiles, in tiles, for the place of a point of an edge.
constexpr double kBeside = 1e-6;

double as_double(std::int64_t x) { return static_cast<double>(x); }

std::size_t bands_of(std::size_t count, std::size_t size) { return (count + size - 1) / size; }

/// A stretch of the paper's height; there are millions of these.
struct RowRange {
  float lo = kEndless, hi = kNothing;

  [[nodiscard]] bool meets(const RowRange& other) const { return lo < other.hi && hi > other.lo; }
  void include(const RowRange& other) {
    lo = std::min(lo, other.lo);
    hi = std::max(hi, other.hi);
  }
};

/// A polygon of a body, or the outline of a convex part of it, whose box holds a tile or more.
struct Large {
  const OccluderPolygon* polygon = nullptr;
  std::uint32_t body = 0;
  std::uint32_t convex = kNoPart;  ///< the part of the shape, where the polygon is its outline
  RowRange across;                 ///< rounded outwards
  float nearest = 0;               ///< no tile that it covers gets a depth nearer than this

  static constexpr std::uint32_t kNoPart = 0xffffffffU;
};

/// What decides whether a large polygon changes tiles at all, by itself in memory: few do.
struct Listed {
  float nearest = 0;
  std::uint32_t large = 0;
  std::uint16_t first_row = 0, last_row = 0, first_column = 0, last_column = 0;  ///< of its box
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
    if (!(facing * facing > 1e-4 * size * squared_)) return {.behind = kInfinity};
    return {-dot(along_u_) / w, -dot(along_v_) / w, contact_ * sum * squared_ / facing};
  }

 private:
  double contact_, squared_ = 1;
  double along_u_[3], along_v_[3], along_w_[3];
  geometry::Vec3d direction_;
};

}  // namespace

/// Rows of an occlusion buffer with the farthest depth of each block of their tiles.
class OcclusionBuffer::Rows {
 public:
  Rows(OcclusionBuffer& buffer, std::size_t first, std::size_t last)
      : buffer_(buffer),
        first_(first),
        last_(last),
        blocks_((buffer.columns_ + kBlockTiles - 1) / kBlockTiles),
        farthest_((last - first) * blocks_, kNothing) {}

  [[nodiscard]] std::size_t first() const { return first_; }
  [[nodiscard]] std::size_t last() const { return last_; }

  /// Returns whether all tiles [from, to) of a row have a depth as near as this one already.
  [[nodiscard]] bool are_nearer(std::size_t row, std::size_t from, std::size_t to,
                                float depth) const {
    const float* const farthest = farthest_.data() + (row - first_) * blocks_;
    for (std::size_t block = from / kBlockTiles; block * kBlockTiles < to; ++block)
      if (farthest[block] < depth) return false;
    return true;
  }

  /// Brings tiles [from, to) of a row nearer: depth_of(column) -> float.
  template <class DepthOf>
  void paint(std::size_t row, std::size_t from, std::size_t to, DepthOf&& depth_of) {
    float* const depth = buffer_.depth_.data() + row * buffer_.columns_;
    bool changed = false;
    for (std::size_t column = from; column < to; ++column) {
      const float f = depth_of(column);
      changed = changed || f > depth[column];
      depth[column] = std::max(depth[column], f);
    }
    if (!changed) return;
    float* const farthest = farthest_.data() + (row - first_) * blocks_;
    for (std::size_t block = from / kBlockTiles; block * kBlockTiles < to; ++block) {
      const std::size_t begin = block * kBlockTiles;
      const std::size_t end = std::min(begin + kBlockTiles, buffer_.columns_);
      farthest[block] = *std::min_element(depth + begin, depth + end);
    }
  }

 private:
  OcclusionBuffer& buffer_;
  std::size_t first_, last_, blocks_;
  std::vector<float> farthest_;  ///< by row, then block
};

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
      const auto nearest = static_cast<float>(polygon.box.hi.w + placed.at.w);
      out.push_back({&polygon,
                     body,
                     convex,
                     {std::nextafter(lo, -kEndless), std::nextafter(hi, kEndless)},
                     std::nextafter(nearest, kEndless)});
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

  /// Returns the polygons that reach into some rows, about the nearest first: most of the others
  /// then lie behind what is painted already. Which come first changes no depth.
  [[nodiscard]] std::vector<Listed> nearest_first(std::span<const Large> all,
                                                  std::span<const RowRange> blocks,
                                                  std::size_t first_row,
                                                  std::size_t last_row) const {
    std::vector<Listed> found;
    const RowRange rows{static_cast<float>(side_of(first_row)),
                        static_cast<float>(side_of(last_row))};
    float nearest = kNothing, farthest = kEndless;
    for (std::size_t block = 0; block < blocks.size(); ++block) {
      if (!blocks[block].meets(rows)) continue;
      const std::size_t end = std::min(all.size(), (block + 1) * kBlockFaces);
      for (std::size_t i = block * kBlockFaces; i < end; ++i) {
        const Large& large = all[i];
        if (!large.across.meets(rows)) continue;
        found.push_back(listed(large, static_cast<std::uint32_t>(i)));
        nearest = std::max(nearest, large.nearest);
        farthest = std::min(farthest, large.nearest);
      }
    }
    // A counting sort by depth: within a class the order is of no account.
    const auto depth_class = [&](const Listed& one) {
      const float share = (nearest - one.nearest) / std::max(nearest - farthest, 1.0F);
      return static_cast<std::size_t>(share * static_cast<float>(kDepthClasses - 1));
    };
    std::vector<std::size_t> begin(kDepthClasses + 1);
    for (const Listed& one : found) ++begin[depth_class(one) + 1];
    for (std::size_t k = 0; k < kDepthClasses; ++k) begin[k + 1] += begin[k];
    std::vector<Listed> sorted(found.size());
    for (const Listed& one : found) sorted[begin[depth_class(one)]++] = one;
    return sorted;
  }

  void paint(std::span<const Large> all, std::span<const Listed> listed, Rows& rows) const {
    for (const Listed& one : listed) {
      const std::size_t from = std::max<std::size_t>(rows.first(), one.first_row);
      const std::size_t to = std::min<std::size_t>(rows.last(), one.last_row);
      if (from < to) paint(all[one.large], one, from, to, rows);
    }
  }

 private:
  struct Span {
    double lo, hi;
  };

  [[nodiscard]] bool large(const ViewBox& box) const {
    return !box.empty() && as_double(box.hi.u - box.lo.u) > occlusion_buffer_.width_ &&
           as_double(box.hi.v - box.lo.v) > occlusion_buffer_.height_;
  }

  /// Returns the height at which a row begins.
  [[nodiscard]] double side_of(std::size_t row) const {
    return occlusion_buffer_.v0_ + occlusion_buffer_.height_ * static_cast<double>(row);
  }

  [[nodiscard]] Listed listed(const Large& large, std::uint32_t number) const {
    const OcclusionBuffer& c = occlusion_buffer_;
    const auto tile = [](double at, double size, std::size_t count) {
      return static_cast<std::uint16_t>(
          std::clamp(std::floor(at / size), 0.0, static_cast<double>(count)));
    };
    const auto after = [](std::uint16_t last, std::size_t count) {
      return static_cast<std::uint16_t>(std::min<std::size_t>(last + std::size_t{1}, count));
    };
    const ViewBox& box = large.polygon->box;
    const double u = as_double(placed_[large.body].at.u);
    return {large.nearest,
            number,
            tile(large.across.lo - c.v0_, c.height_, c.rows_),
            after(tile(large.across.hi - c.v0_, c.height_, c.rows_), c.rows_),
            tile(as_double(box.lo.u) + u - c.u0_, c.width_, c.columns_),
            after(tile(as_double(box.hi.u) + u - c.u0_, c.width_, c.columns_), c.columns_)};
  }

  void paint(const Large& large, const Listed& box, std::size_t from_row, std::size_t to_row,
             Rows& rows) const {
    const BodyInstance& placed = placed_[large.body];
    const auto corners = [&] {
      return std::span(placed.shape->corners)
          .subspan(large.polygon->first_corner, large.polygon->corners);
    };
    std::optional<DepthPlane> plane;
    Span lower{};
    bool follows = false;  // on a row whose upper chord is this one's lower
    for (std::size_t row = from_row; row < to_row; ++row) {
      if (rows.are_nearer(row, box.first_column, box.last_column, box.nearest)) {
        follows = false;
        continue;
      }
      if (!plane) plane = plane_of(large);
      if (!plane->slope.is_finite()) return;
      if (!follows) lower = chord(corners(), placed.at, side_of(row));
      const Span upper = chord(corners(), placed.at, side_of(row + 1));
      paint_row(row, {std::max(lower.lo, upper.lo), std::min(lower.hi, upper.hi)}, *plane, rows);
      lower = upper;
      follows = true;
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

  void paint_row(std::size_t row, const Span& span, const DepthPlane& plane, Rows& rows) const {
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
    rows.paint(row, from, to, [&](std::size_t column) {
      // Rounded to the next float below.
      const double w = start + step * static_cast<double>(column);
      return static_cast<float>(w - std::fabs(w) * 1.2e-7);
    });
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
  const auto extent = parallel::reduce(
      context, {.name = "hidden lines: extent", .n = placed.size(), .grain = 1024}, ViewBox{},
      [&](ViewBox& of_block, std::size_t b) {
        const BodyInstance& p = placed[b];
        if (p.shape != nullptr && p.opaque && !p.shape->box.empty())
          of_block.include(p.shape->box.moved(p.at));
      },
      [](ViewBox& into, const ViewBox& of_block) { into.include(of_block); });
  if (!extent) return extent.error();
  const ViewBox& box = *extent;
  if (box.empty() || box.lo.u == box.hi.u || box.lo.v == box.hi.v) return occlusion_buffer;
  const auto a_side = static_cast<std::size_t>(std::sqrt(static_cast<double>(tiles)));
  occlusion_buffer.columns_ = occlusion_buffer.rows_ =
      std::clamp<std::size_t>(a_side, 16, kMaxAcross);
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
  const std::size_t rows = occlusion_buffer.rows_;
  const auto blocks = parallel::transform(
      context, {.name = "hidden lines: rows of faces", .n = bands_of(large->size(), kBlockFaces)},
      [&](std::size_t block) {
        RowRange across;
        const std::size_t end = std::min(large->size(), (block + 1) * kBlockFaces);
        for (std::size_t i = block * kBlockFaces; i < end; ++i) across.include((*large)[i].across);
        return across;
      });
  if (!blocks) return blocks.error();
  const auto listed = parallel::transform(
      context, {.name = "hidden lines: faces by rows", .n = bands_of(rows, kListedRows)},
      [&](std::size_t band) {
        return painter.nearest_first(*large, *blocks, band * kListedRows,
                                     std::min(rows, (band + 1) * kListedRows));
      });
  if (!listed) return listed.error();
  // Most faces lie where the model is.
  const auto order = parallel::longest_first(bands_of(rows, kPaintedRows), [&](std::size_t item) {
    return (*listed)[item * kPaintedRows / kListedRows].size();
  });
  const Status painted = parallel::for_each(
      context,
      {.name = "hidden lines: covered tiles", .n = bands_of(rows, kPaintedRows), .order = order},
      [&](std::size_t item) {
        const std::size_t first = item * kPaintedRows;
        Rows some(occlusion_buffer, first, std::min(rows, first + kPaintedRows));
        painter.paint(*large, (*listed)[first / kListedRows], some);
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
    if (!gaps.empty() && (lo <= gaps.back().hi || gaps.size() == kMaxGaps))
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
      high >= static_cast<double>(rows_) || (right - left + 1) * (high - low + 1) > kMaxInBox)
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
