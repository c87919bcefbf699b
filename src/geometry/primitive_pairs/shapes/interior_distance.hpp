// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "geometry/primitive_pairs/shapes/convex_body.hpp"
#include "geometry/primitive_pairs/shapes/quadric.hpp"

namespace strake::geometry::primitive_pairs {

/// The depth of points in a convex primitive: the primitive is the intersection of half-spaces and
/// at most one quadric, so a ball lies in it when it lies in each of them.
class InteriorDistance {
 public:
  /// Prepares a primitive; Prepares a primitive; `body` is convex_body(p, origin). Nothing for
  /// bodies without thickness and for shapes so slender that a face has no normal to working
  /// precision.
  [[nodiscard]] static std::optional<InteriorDistance> of(const PlacedPrimitive& p,
                                                          const ConvexBody& body,
                                                          const Vec3l& origin);

  /// The face nearest to a point: its outward normal and the depth under it, negative beyond it.
  /// The ball of radius `certain` about the point lies in the body; 0 outside.
  struct NearestFace {
    double depth = 0, certain = 0;
    Vec3d normal;
  };
  [[nodiscard]] NearestFace nearest(const Vec3d& x) const;

  [[nodiscard]] std::size_t planes() const { return planes_; }
  [[nodiscard]] const Vec3d& normal(std::size_t i) const { return faces_[i].normal; }
  [[nodiscard]] bool curved() const { return quadric_.has_value(); }
  [[nodiscard]] const Quadric& quadric() const { return *quadric_; }

 private:
  struct BoundaryPlane {
    Vec3d normal;       ///< unit
    double offset = 0;  ///< of the body's support
    double error = 0;   ///< of the depth under the face
  };
  /// Adds the face spanned by two directions; false when they are parallel to working precision.
  bool add_face(const ConvexBody& body, const Vec3d& u, const Vec3d& v, const Vec3d& through);
  bool add_faces(const ConvexBody& body, const Prismoid& s);
  bool add_apex(const ConvexBody& body, const Prismoid& s);
  bool add_faces(const ConvexBody& body, const EllipsoidCap& s);

  std::array<BoundaryPlane, 6> faces_;
  std::size_t planes_ = 0;
  std::optional<Quadric> quadric_;
  double reach_ = 0;  ///< of lengths about the quadric's centre
  double error_ = 0;
};

}  // namespace strake::geometry::primitive_pairs
