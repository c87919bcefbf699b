// SPDX-License-Identifier: Apache-2.0
// Other programs at the question that Strake answers: which objects' surfaces share a point.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/evaluate/peers/peer_row.hpp"
#include "geometry/bvh/scene_bvh.hpp"
#include "strake/geometry/mesh.hpp"
#include "strake/parallel/context.hpp"

namespace strake::bench {

/// All triangles of an object, millimetres.
struct PeerObject {
  std::vector<geometry::Vec3d> points;
  std::vector<geometry::Triangle> triangles;
  geometry::Box3d box = geometry::empty_box<double>();
};

struct PeerAnswer {
  std::string_view outcome = cli::kMeasured;
  std::string why;  ///< there is no answer; empty: there is
  std::string version;
  std::vector<geometry::IndexPair> pairs;  ///< ascending
  double build_s = 0, query_s = 0;         ///< CPU seconds of all threads
  double wall_s = 0;
  double load_s = 0;  ///< before: of reading files, by a peer that reads some
};

/// rtcCollide finds the boxes that meet, a test of separating axes the triangles that do: with
/// rtcCollide again between objects of more than a thousand triangles, by plain loops below that.
[[nodiscard]] PeerAnswer embree_overlaps(std::span<const PeerObject> objects,
                                         const parallel::Context& context);

/// Trees of boxes and swept spheres over each object, in a dynamic tree over all. One thread:
/// the library has no way of its own to use more.
[[nodiscard]] PeerAnswer fcl_overlaps(std::span<const PeerObject> objects);
/// Pairs nearer than a distance; FCL measures each to its end.
[[nodiscard]] PeerAnswer fcl_within(std::span<const PeerObject> objects, double distance_mm);

/// Exact predicates: a tree over each object's triangles, asked about those of its smaller partner.
[[nodiscard]] PeerAnswer cgal_overlaps(std::span<const PeerObject> objects,
                                       const parallel::Context& context);

/// Bullet's boxes in a dynamic tree, and GImpact's trees of triangles; double precision, no margin.
/// Made for physics: it takes two triangles for touching where each reaches behind the plane of the
/// other and their boxes meet, which holds for more pairs than cross. One thread.
[[nodiscard]] PeerAnswer bullet_overlaps(std::span<const PeerObject> objects);

/// IfcOpenShell's tree of triangles, in a process of its own: what protrudes into what. `scene` is
/// an OBJ file with an `o` for each object; what the process writes lies beside it.
[[nodiscard]] PeerAnswer ifc_tree_overlaps(const std::filesystem::path& scene, unsigned threads,
                                           double limit_s);

}  // namespace strake::bench
