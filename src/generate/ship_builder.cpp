// SPDX-License-Identifier: Apache-2.0
#include "generate/ship_builder.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

namespace strake::generate {
namespace {

using geometry::Vec3d;
using geometry::Vec3l;

enum ShapeKind : std::int64_t {
  kBox = 1,
  kShellBox,
  kBar,
  kCollar,
  kTube,
  kLines,
  kHashed,
};

/// Returns a recipe for long parameter lists (profiles, paths), which go in as two independent
/// 64-bit hashes; the few hundred shapes of a ship are some 2^-110 away from a collision.
Recipe hashed(std::int64_t maker, std::span<const Vec3d> points, const Vec3l& more) {
  std::uint64_t h1 = 0x9ae16a3b2f90404fU, h2 = 0xc949d7c7509e6557U;
  const auto take = [&](std::int64_t value) {
    h1 = (h1 ^ static_cast<std::uint64_t>(value)) * 0x9fb21c651e98df25U;
    h1 ^= h1 >> 32U;
    h2 = (h2 + static_cast<std::uint64_t>(value)) * 0xd6e8feb86659fd93U;
    h2 ^= h2 >> 29U;
  };
  for (const Vec3d& p : points) take(um(p.x)), take(um(p.y)), take(um(p.z));
  return {kHashed,
          maker,
          static_cast<std::int64_t>(h1),
          static_cast<std::int64_t>(h2),
          static_cast<std::int64_t>(points.size()),
          more.x,
          more.y,
          more.z};
}

constexpr std::array<std::string_view, static_cast<std::size_t>(PairReason::count)> kWhyTexts{
    "welded edge to face",
    "rests on its support",
    "flange faces bolted together",
    "fitted face to face",
    "planted: runs through a plate",
    "planted: two bodies overlap",
    "planted: two thin plates cross",
    "planted: two runs cross",
    "planted: one lies wholly inside the other",
    "planted: modelled twice in the same place",
    "planted: touches with a gap below the touch gap",
    "planted: pressed in by less than the touch overlap",
    "planted: face to face, too near",
    "planted: corner to corner, too near",
    "planted: slanted faces, too near",
    "planted: too near to the wall of a cavity",
};

}  // namespace

std::span<const std::string_view> why_texts() { return kWhyTexts; }

Vec3l grid(const Vec3d& mm) { return {um(mm.x), um(mm.y), um(mm.z)}; }

Vec3l AxisFrame::operator*(const Vec3l& v) const {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z + t.x, m[3] * v.x + m[4] * v.y + m[5] * v.z + t.y,
          m[6] * v.x + m[7] * v.y + m[8] * v.z + t.z};
}

AxisFrame AxisFrame::operator*(const AxisFrame& inner) const {
  AxisFrame result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      result.m[3 * i + j] = static_cast<std::int8_t>(
          m[3 * i] * inner.m[j] + m[3 * i + 1] * inner.m[3 + j] + m[3 * i + 2] * inner.m[6 + j]);
  result.t = *this * inner.t;
  return result;
}

AxisFrame facing(FacingAxis axis, const Vec3d& at_mm) {
  AxisFrame frame;
  frame.t = grid(at_mm);
  if (axis == FacingAxis::along) frame.m = {0, 0, 1, 1, 0, 0, 0, 1, 0};
  if (axis == FacingAxis::beside) frame.m = {0, 1, 0, 0, 0, 1, 1, 0, 0};
  if (axis == FacingAxis::down) frame.m = {1, 0, 0, 0, -1, 0, 0, 0, -1};
  return frame;
}

AxisFrame at(const Vec3d& mm) { return facing(FacingAxis::up, mm); }

std::uint32_t ShipBuilder::shape(const Recipe& recipe,
                                 const std::function<MicrometreMesh()>& make) {
  const auto [place, fresh] =
      known_.try_emplace(recipe, static_cast<std::uint32_t>(shapes_.size()));
  if (fresh) {
    const MicrometreMesh mesh = make();
    shapes_.emplace_back(to_mesh(mesh));
    volumes_.push_back(volume_mm3(mesh));
  }
  return place->second;
}

std::uint32_t ShipBuilder::late_shape(std::function<MicrometreMesh()> make) {
  const auto shape = static_cast<std::uint32_t>(shapes_.size());
  late_.emplace_back(shape, std::move(make));
  shapes_.emplace_back(geometry::TriangleMesh{});
  volumes_.push_back(0);
  return shape;
}

Status ShipBuilder::make_late_shapes(const std::stop_token& stop) {
  for (const auto& [shape, make] : late_) {
    if (stop.stop_requested())
      return Error{ErrorCode::cancelled, "cancelled while generating", "", ""};
    const MicrometreMesh mesh = make();
    shapes_[shape] = to_mesh(mesh);
    volumes_[shape] = volume_mm3(mesh);
  }
  late_.clear();
  return {};
}

std::uint32_t ShipBuilder::reversed(std::uint32_t shape) {
  const auto [place, fresh] =
      reversed_.try_emplace(shape, static_cast<std::uint32_t>(shapes_.size()));
  if (fresh) {
    geometry::TriangleMesh mesh = std::get<geometry::TriangleMesh>(shapes_[shape]);
    for (geometry::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    shapes_.emplace_back(std::move(mesh));
    volumes_.push_back(volumes_[shape]);
  }
  return place->second;
}

std::uint32_t ShipBuilder::lines(const Recipe& recipe,
                                 const std::function<geometry::Polylines()>& make) {
  const auto [place, fresh] =
      known_.try_emplace(recipe, static_cast<std::uint32_t>(shapes_.size()));
  if (fresh) {
    shapes_.emplace_back(make());
    volumes_.push_back(0);
  }
  return place->second;
}

Handle ShipBuilder::add(ObjectKind kind, const ShipCell& cell, std::uint32_t shape,
                        const AxisFrame& frame) {
  std::uint16_t& number =
      next_number_[{static_cast<std::uint32_t>(kind), cell.bay, cell.lane, cell.level}];
  objects_.push_back({frame, shape, kind, cell, ++number, false, false});
  return static_cast<Handle>(objects_.size() - 1);
}

void ShipBuilder::turn_inside_out(Handle object) {
  ShipObject& built = objects_[object];
  if (built.inside_out) return;
  built.shape = reversed(built.shape);
  built.inside_out = true;
}

void ShipBuilder::declare(const DeclaredPair& pair) {
  if (pair.a != kNothing && pair.b != kNothing) pairs_.push_back(pair);
}

Site Site::moved(const Vec3d& mm) const { return in(at(mm)); }

Handle Site::box(ObjectKind kind, const Vec3d& lo, const Vec3d& hi) const {
  const Vec3l size = grid(hi) - grid(lo);
  const std::uint32_t shape =
      builder->shape({kBox, size.x, size.y, size.z}, [&] { return make_box(size); });
  return builder->add(kind, cell, shape, frame * at(lo));
}

Handle Site::shell_box(ObjectKind kind, const Vec3d& lo, const Vec3d& hi, double wall) const {
  const Vec3l size = grid(hi) - grid(lo);
  const std::int64_t w = um(wall);
  const std::uint32_t shape = builder->shape({kShellBox, size.x, size.y, size.z, w}, [&] {
    MicrometreMesh mesh = make_box(size);
    MicrometreMesh cavity = make_box(size - Vec3l{2 * w, 2 * w, 2 * w});
    reverse(cavity);
    append(mesh, cavity, {w, w, w});
    return mesh;
  });
  return builder->add(kind, cell, shape, frame * at(lo));
}

Handle Site::turned(ObjectKind kind, std::span<const Vec3d> profile, const AxisFrame& where,
                    int sides) const {
  const std::uint32_t shape = builder->shape(hashed(1, profile, {sides, 0, 0}), [&] {
    std::vector<RevolutionPoint> points;
    for (const Vec3d& p : profile) points.push_back({um(p.x), um(p.y)});
    return revolve(points, sides);
  });
  return builder->add(kind, cell, shape, frame * where);
}

Handle Site::bar(ObjectKind kind, double r, double length, const AxisFrame& where,
                 int sides) const {
  const std::uint32_t shape = builder->shape({kBar, um(r), um(length), sides}, [&] {
    return extrude(ring(sides, um(r)), {}, um(length));
  });
  return builder->add(kind, cell, shape, frame * where);
}

Handle Site::collar(ObjectKind kind, double bore, double outer, double length,
                    const AxisFrame& where) const {
  const std::int64_t r = um(bore), big = um(outer), l = um(length);
  const std::uint32_t shape = builder->shape({kCollar, r, big, l}, [&] {
    const std::array<RevolutionPoint, 4> profile{{{r, 0}, {big, 0}, {big, l}, {r, l}}};
    return revolve_ring(profile, 24);
  });
  return builder->add(kind, cell, shape, frame * where);
}

Handle Site::extruded(ObjectKind kind, std::span<const Vec3d> profile, double length,
                      const AxisFrame& where) const {
  const std::uint32_t shape = builder->shape(hashed(2, profile, {um(length), 0, 0}), [&] {
    return extrude(outline(profile), {}, um(length));
  });
  return builder->add(kind, cell, shape, frame * where);
}

Handle Site::tube(ObjectKind kind, const Vec3d& size, double wall, const AxisFrame& where) const {
  const Vec3l s = grid(size);
  const std::int64_t w = um(wall);
  const std::uint32_t shape = builder->shape({kTube, s.x, s.y, s.z, w}, [&] {
    const OutlinePolygon outer{{0, 0}, {s.x, 0}, {s.x, s.y}, {0, s.y}};
    const std::array<OutlinePolygon, 1> hole{
        {{{w, w}, {s.x - w, w}, {s.x - w, s.y - w}, {w, s.y - w}}}};
    return extrude(outer, hole, s.z);
  });
  return builder->add(kind, cell, shape, frame * where);
}

Handle Site::swept(ObjectKind kind, std::span<const Vec3d> path, double r, double bend) const {
  const Vec3d start = path.front();
  std::vector<Vec3d> local;
  for (const Vec3d& p : path) local.push_back(p - start);
  const std::uint32_t shape = builder->shape(hashed(3, local, {um(r), um(bend), 0}), [&] {
    std::vector<Vec3l> points;
    for (const Vec3d& p : local) points.push_back(grid(p));
    return sweep(points, um(r), um(bend), 24);
  });
  return builder->add(kind, cell, shape, frame * at(start));
}

Handle Site::centre_line(std::span<const Vec3d> path) const {
  const Vec3d start = path.front();
  std::vector<Vec3d> local;
  for (const Vec3d& p : path) local.push_back(p - start);
  const std::uint32_t shape = builder->lines(hashed(4, local, {}), [&] {
    geometry::Polylines result;
    result.points = local;
    result.first.push_back(static_cast<std::uint32_t>(local.size()));
    return result;
  });
  return builder->add(ObjectKind::centre_line, cell, shape, frame * at(start));
}

}  // namespace strake::generate
