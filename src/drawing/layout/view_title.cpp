// SPDX-License-Identifier: Apache-2.0
#include "drawing/layout/view_title.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/number.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::drawing {

namespace {

using geometry::Vec3d;
using geometry::Vec3l;

/// Returns the axis that a normal runs along; -1: none.
int axis_of(const Vec3l& normal) {
  for (int k = 0; k < 3; ++k)
    if (normal[(k + 1) % 3] == 0 && normal[(k + 2) % 3] == 0) return k;
  return -1;
}

/// "4.5 m", "350 mm", "0 m"
std::string length_text(double mm) {
  const bool small = mm != 0 && std::fabs(mm) < 1000;
  std::string text = fixed(small ? mm : mm / 1000, 6);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + (small ? " mm" : " m");
}

/// Returns whether the first component of a vector that is not 0 is negative.
bool points_back(const Vec3l& v) {
  return v.x < 0 || (v.x == 0 && (v.y < 0 || (v.y == 0 && v.z < 0)));
}

/// "z = 4.5 m"; of both normals of a plane the one that does not point back, whichever side is cut
/// away.
std::string plane_text(const hlr::Section& section) {
  constexpr std::array kAxes{'x', 'y', 'z'};
  const Vec3l n = points_back(section.normal) ? -section.normal : section.normal;
  const Vec3d point = geometry::to_mm(section.point);
  if (const int axis = axis_of(n); axis >= 0)
    return fmt::format("{} = {}", kAxes.at(static_cast<std::size_t>(axis)),
                       length_text(point[axis]));
  // The plane goes through a grid point, beside the place that was requested.
  const Vec3d normal = n.as<double>();
  const double distance = dot(normal, point) / std::sqrt(dot(normal, normal));
  return fmt::format("{},{},{} = {}", n.x, n.y, n.z,
                     length_text(std::nearbyint(distance * 100) / 100 + 0.0));
}

}  // namespace

std::string title_of(std::string_view name, const hlr::View& view) {
  if (view.sections.empty()) return std::string(name);
  const bool square = !view.perspective && view.sections.size() == 1 &&
                      cross(view.sections.front().normal, view.direction) == Vec3l{};
  std::string title = square ? std::string() : fmt::format("{}, ", name);
  title += "SECTION ";
  for (const hlr::Section& section : view.sections) {
    if (&section != &view.sections.front()) title += ", ";
    title += plane_text(section);
  }
  return title;
}

}  // namespace strake::drawing
