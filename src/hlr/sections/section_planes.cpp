// SPDX-License-Identifier: Apache-2.0
// Section planes in world coordinates, and the space that limits, sections and frustum leave.
#include "hlr/sections/section_planes.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace strake::hlr {
namespace {

using geometry::Int128;
using geometry::Vec3l;

constexpr std::int64_t kMaxNormal = std::int64_t{1} << 20;
constexpr std::int64_t kMaxPoint = std::int64_t{1} << 50;
constexpr std::size_t kMaxPlanes = 16;

Error section_error(std::string message, std::string mend) {
  return {ErrorCode::usage, std::move(message), "section", std::move(mend)};
}

Int128 product(const Vec3l& n, const Vec3l& p) {
  return static_cast<Int128>(n.x) * p.x + static_cast<Int128>(n.y) * p.y +
         static_cast<Int128>(n.z) * p.z;
}

Status check(const Section& section) {
  if (section.normal == Vec3l{})
    return section_error("the normal of a section plane is zero",
                         "give the direction in which it cuts away");
  for (int k = 0; k < 3; ++k) {
    if (section.normal[k] > kMaxNormal || section.normal[k] < -kMaxNormal)
      return section_error("a component of the normal of a section plane exceeds 1048576",
                           "round the normal to 20 bits");
    if (section.point[k] > kMaxPoint || section.point[k] < -kMaxPoint)
      return section_error("a section plane lies beyond a million kilometres",
                           "give a plane nearer by");
  }
  return {};
}

}  // namespace

geometry::CutPlane SectionPlane::at(const Vec3l& origin) const {
  constexpr Int128 kBeyond = Int128{1} << 53;
  const Int128 local = offset - product(normal, origin);
  return {normal, static_cast<std::int64_t>(std::clamp(local, -kBeyond, kBeyond))};
}

Int128 SectionPlane::height(const Vec3l& p) const { return product(normal, p) - offset; }

Int128 SectionPlane::least(const geometry::Box3l& box) const {
  Vec3l p;
  for (int k = 0; k < 3; ++k) p[k] = normal[k] < 0 ? box.hi[k] : box.lo[k];
  return height(p);
}

Int128 SectionPlane::greatest(const geometry::Box3l& box) const {
  return SectionPlane{-normal, -offset}.least(box) * -1;
}

Result<std::vector<SectionPlane>> section_planes(std::span<const Section> sections) {
  std::vector<SectionPlane> planes;
  for (const Section& section : sections) {
    if (const Status status = check(section); !status) return status.error();
    const Vec3l& n = section.normal;
    const std::int64_t g = std::gcd(std::gcd(n.x, n.y), n.z);
    const Vec3l normal{n.x / g, n.y / g, n.z / g};
    planes.push_back({normal, product(normal, section.point)});
  }
  std::ranges::sort(planes);
  const auto repeated = std::ranges::unique(planes);
  planes.erase(repeated.begin(), repeated.end());
  if (planes.size() > kMaxPlanes) return section_error("more than 16 section planes", "give fewer");
  return planes;
}

ViewVolume::ViewVolume(const View& view, std::span<const SectionPlane> sections)
    : limits_(view.limits), planes_(sections.begin(), sections.end()) {
  for (const HalfSpace& side : window(view)) {
    // What is at least this high over the plane through the eye is kept.
    const geometry::Int128 of_eye = SectionPlane{side.normal}.height(view.perspective->eye);
    planes_.push_back({-side.normal, -of_eye - side.least});
  }
}

bool ViewVolume::meets(const geometry::Box3l& box) const {
  return (!limits_ || box.meets(*limits_)) &&
         std::ranges::all_of(planes_,
                             [&](const SectionPlane& plane) { return plane.least(box) < 0; });
}

}  // namespace strake::hlr
