// SPDX-License-Identifier: Apache-2.0
#include "drawing/layout/view_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/number.hpp"
#include "drawing/layout/paper_size.hpp"
#include "geometry/numeric/trig.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::drawing {

namespace {

using geometry::Vec3d;

/// The papers on which views lie that have none of their own.
constexpr auto kSheets = std::span(kNamedPapers).subspan<1>();

std::optional<Vec3d> unit(const Vec3d& v) {
  const double length = std::sqrt(dot(v, v));
  if (!(length > 0)) return std::nullopt;
  return Vec3d{v.x / length, v.y / length, v.z / length};
}

PaperSize usable_size(const PaperSize& sheet, double margin) {
  return {sheet.width_mm - 2 * margin, sheet.height_mm - 2 * margin - kTitleStrip};
}

bool fits(const PlaneBox& box, double scale, const PaperSize& space) {
  return box.width() <= space.width_mm * scale && box.height() <= space.height_mm * scale;
}

/// Returns the largest usual scale at which the box fits, or the intermediate one above it, where
/// the box fits that; 1:1 for an empty box.
double best_scale(const PlaneBox& box, const PaperSize& space) {
  if (!(box.width() > 0 || box.height() > 0)) return 1;
  const auto usual = usual_scales();
  const auto found =
      std::ranges::find_if(usual, [&](double scale) { return fits(box, scale, space); });
  if (found == usual.end()) return usual.back();
  const auto between = intermediate_scale(*found);
  return between && fits(box, *between, space) ? *between : *found;
}

/// Rounds off the last digits that division leaves: 49:1 is kept as 1/49, and 1 over that is not
/// 49.
double neat(double value) {
  const double rounded = std::nearbyint(value * 1e6) / 1e6;
  return std::fabs(rounded - value) <= 1e-12 * value ? rounded : value;
}

/// Writes 100000, not 1e+05.
std::string plain(double value) {
  return value == std::nearbyint(value) ? fixed(value, 0) : shortest(value);
}

double next_ten(double mm) { return std::ceil(mm / 10) * 10; }

}  // namespace

std::optional<PaperAxes> paper_axes(const hlr::View& view) {
  // Exact while components stay within 2^20: the first product is within 2^41, the second within
  // 2^62.
  const geometry::Vec3l right = cross(view.up, view.direction);
  const geometry::Vec3l up = cross(view.direction, right);
  const auto r = unit(right.as<double>()), u = unit(up.as<double>()),
             d = unit(view.direction.as<double>());
  if (!r || !u || !d) return std::nullopt;
  PaperAxes axes{*r, *u, *d};
  if (view.perspective) {
    const hlr::Perspective& p = *view.perspective;
    axes.eye = Eye{p.eye, p.target, dot(*d, geometry::to_mm(p.eye - p.target)), p.near_mm};
  }
  return axes;
}

double nearness(const geometry::Vec3l& direction, const geometry::Vec3l& a,
                const geometry::Vec3l& b) {
  return static_cast<double>(dot(direction.as<geometry::Int128>(), (a + b).as<geometry::Int128>()));
}

double PaperAxes::magnification(const Vec3d& mm) const {
  if (!eye) return 1;
  const double depth = dot(toward, geometry::to_mm(eye->at) - mm);
  return eye->distance_mm / std::max(depth, eye->near_mm);
}

double PaperAxes::share_in_model(const Vec3d& a_mm, const Vec3d& b_mm, double t) const {
  if (!eye) return t;
  // Depths are the inverses of the magnifications.
  const double of_b = t / magnification(a_mm), of_a = (1 - t) / magnification(b_mm);
  return of_b / (of_a + of_b);
}

ViewPlane::ViewPlane(const PaperAxes& axes, const geometry::Vec3l& origin)
    : axes_(axes), from_(axes.eye ? axes.eye->at : origin) {
  const PlanePoint p = project(origin);
  x_ = p.x;
  y_ = p.y;
}

PlanePoint ViewPlane::operator()(const geometry::Vec3l& grid) const {
  PlanePoint p = project(grid);
  p.x -= x_;
  p.y -= y_;
  return p;
}

PlanePoint ViewPlane::project(const geometry::Vec3l& grid) const {
  const Vec3d p = geometry::to_mm(grid - from_);
  PlanePoint at{dot(axes_.right, p), dot(axes_.up, p), dot(axes_.toward, p)};
  if (!axes_.eye) return at;
  at.magnification = axes_.eye->distance_mm / std::max(-at.toward, axes_.eye->near_mm);
  at.x *= at.magnification;
  at.y *= at.magnification;
  return at;
}

std::optional<PlaneBox> field_of_view(const hlr::View& view, const geometry::Vec3l& origin) {
  const auto axes = paper_axes(view);
  if (!axes || !axes->eye) return std::nullopt;
  const PlanePoint target = ViewPlane(*axes, origin)(axes->eye->target);
  const auto half =
      geometry::sin_cos(view.perspective->field_of_view_deg / 2 * (std::numbers::pi / 180));
  const double reach = axes->eye->distance_mm * half.sin / half.cos;
  return PlaneBox{target.x - reach, target.x + reach, target.y - reach, target.y + reach};
}

std::span<const double> usual_scales() {
  static constexpr std::array kScales{0.02, 0.05, 0.1, 0.2, 0.5, 1.,  2.,  5.,  10., 20., 50.,
                                      1e2,  2e2,  5e2, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5,
                                      5e5,  1e6,  2e6, 5e6, 1e7, 2e7, 5e7, 1e8, 2e8, 5e8, 1e9};
  return kScales;
}

std::optional<double> intermediate_scale(double usual) {
  for (double five = 5; five <= usual; five *= 10)
    if (usual == five) return five / 2;
  return std::nullopt;
}

double rounded_paper(double mm) { return std::nearbyint(mm * 1000) / 1000 + 0.0; }

std::string scale_text(double scale) {
  return scale >= 1 ? "1:" + plain(neat(scale)) : plain(neat(1 / scale)) + ":1";
}

Sheet choose_sheet(const PlaneBox& box, const LayoutOptions& options) {
  const PaperSize paper = options.paper.value_or(kSheets.front().size);
  Sheet sheet;
  sheet.scale = options.scale.value_or(best_scale(box, usable_size(paper, options.margin_mm)));
  sheet.scale_text = scale_text(sheet.scale);
  sheet.width_mm = paper.width_mm;
  sheet.height_mm = paper.height_mm;
  if (options.paper) return sheet;
  for (const auto& [name, size] : kSheets) {
    sheet.width_mm = size.width_mm;
    sheet.height_mm = size.height_mm;
    if (fits(box, sheet.scale, usable_size(size, options.margin_mm))) return sheet;
  }
  sheet.width_mm =
      std::max(sheet.width_mm, next_ten(box.width() / sheet.scale + 2 * options.margin_mm));
  sheet.height_mm = std::max(
      sheet.height_mm, next_ten(box.height() / sheet.scale + 2 * options.margin_mm + kTitleStrip));
  return sheet;
}

Status check_fit(const PlaneBox& box, const Sheet& sheet, const LayoutOptions& options) {
  const PaperSize space = usable_size({sheet.width_mm, sheet.height_mm}, options.margin_mm);
  if (fits(box, sheet.scale, space)) return {};
  const auto whole = [](double mm) { return fixed(std::ceil(mm), 0); };
  return Error{ErrorCode::usage,
               "at " + sheet.scale_text + " the view is " + whole(box.width() / sheet.scale) +
                   " x " + whole(box.height() / sheet.scale) + " mm, and of the paper of " +
                   plain(sheet.width_mm) + " x " + plain(sheet.height_mm) + " mm " +
                   plain(space.width_mm) + " x " + plain(space.height_mm) + " mm are for it",
               "--paper",
               "give larger paper, or no larger scale than " + scale_text(best_scale(box, space))};
}

}  // namespace strake::drawing
