// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/geometry/mesh.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::generate {

/// A closed mesh in whole micrometres. Every maker returns one shell whose directed edges cancel,
/// outward counter-clockwise; `append` puts several into one mesh.
struct MicrometreMesh {
  std::vector<geometry::Vec3l> vertices;
  std::vector<geometry::Triangle> triangles;
  std::vector<std::uint32_t> faces;  ///< the planar face of each triangle, or geometry::kNoIndex
};

/// A point of a profile, micrometres.
struct ProfilePoint {
  std::int64_t u = 0, v = 0;
  friend bool operator==(const ProfilePoint&, const ProfilePoint&) = default;
};
using OutlinePolygon =
    std::vector<ProfilePoint>;  ///< a simple polygon, counter-clockwise, no three in line

/// A point of a body of revolution: distance from the axis (of the flats, not of the corners) and
/// height, micrometres.
struct RevolutionPoint {
  std::int64_t r = 0, z = 0;
};

/// Returns the whole micrometres nearest to a length in millimetres.
[[nodiscard]] std::int64_t um(double mm);
/// Returns an outline from pairs of millimetres.
[[nodiscard]] OutlinePolygon outline(std::span<const geometry::Vec3d> uv_mm);

/// Returns a regular polygon of `sides` (8, 12, 16, 24 or 48) about the origin whose flats lie at
/// exactly ±r across both axes, counter-clockwise from the corner above +u.
[[nodiscard]] OutlinePolygon ring(int sides, std::int64_t r);

/// Returns cos and sin of step·15°, from square roots.
[[nodiscard]] geometry::Vec3d unit_15deg(int step);

/// Makes a box that spans [0, size] on each axis.
[[nodiscard]] MicrometreMesh make_box(const geometry::Vec3l& size);
/// Extrudes an outline in (x, y), z from 0 to length; holes are counter-clockwise too and become
/// openings.
[[nodiscard]] MicrometreMesh extrude(const OutlinePolygon& outer,
                                     std::span<const OutlinePolygon> holes, std::int64_t length);
/// Revolves a profile about z, by rising z (equal z: a shoulder); ends with r = 0 are points of the
/// axis, other ends become flat caps.
[[nodiscard]] MicrometreMesh revolve(std::span<const RevolutionPoint> profile, int sides);
/// Revolves a closed profile about z, counter-clockwise in (r, z), r > 0 everywhere: a ring.
[[nodiscard]] MicrometreMesh revolve_ring(std::span<const RevolutionPoint> profile, int sides);
/// Makes a round bar of radius r along a path of axis-parallel legs with 90° bends of radius
/// `bend`.
[[nodiscard]] MicrometreMesh sweep(std::span<const geometry::Vec3l> path, std::int64_t r,
                                   std::int64_t bend, int sides);

void append(MicrometreMesh& mesh, const MicrometreMesh& other, const geometry::Vec3l& offset);
/// Permutes x→y, y→z, z→x `times` times, then moves the mesh.
[[nodiscard]] MicrometreMesh cycled(MicrometreMesh mesh, int times,
                                    const geometry::Vec3l& offset = {});
void reverse(MicrometreMesh& mesh);
/// Returns the volume in cubic millimetres.
[[nodiscard]] double volume_mm3(const MicrometreMesh& mesh);
[[nodiscard]] geometry::TriangleMesh to_mesh(const MicrometreMesh& mesh);

/// Returns triangles of a simple polygon with holes: indices into outer followed by each hole's
/// points.
[[nodiscard]] std::vector<geometry::Triangle> triangulate_outline(
    const OutlinePolygon& outer, std::span<const OutlinePolygon> holes);

}  // namespace strake::generate
