// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <variant>

namespace strake::geometry {

/// The analytic primitives of plant and ship models, each in its own local frame.
/// Lengths are millimetres, angles radians. Full definitions: docs/formats/primitives.md.

/// A box centred on the origin. A zero length makes a two-sided sheet.
struct BoxPrimitive {
  double length_x = 0, length_y = 0, length_z = 0;
};

/// Two parallel rectangles h apart, each centred, the top one displaced by +offset/2, the bottom
/// one by -offset/2; a top of zero size is an apex or a ridge.
struct PyramidPrimitive {
  double bottom_x = 0, bottom_y = 0, top_x = 0, top_y = 0, offset_x = 0, offset_y = 0, height = 0;
};

/// A cylinder about the Z axis, centred on the origin.
struct CylinderPrimitive {
  double radius = 0, height = 0;
};

/// Cone frustum between two circles (possibly eccentric) whose end planes may be sheared:
/// bottom z = -h/2 + tan(bottom_shear_x)·dx + tan(bottom_shear_y)·dy, top likewise.
struct SnoutPrimitive {
  double bottom_radius = 0, top_radius = 0, height = 0, offset_x = 0, offset_y = 0;
  double bottom_shear_x = 0, bottom_shear_y = 0, top_shear_x = 0, top_shear_y = 0;
};

struct SpherePrimitive {
  double diameter = 0;
};

/// Half ellipsoid z >= 0 with semi-axes radius, radius, height; the base disc lies in z = 0.
struct EllipticalDishPrimitive {
  double radius = 0, height = 0;
};

/// Spherical cap with base disc radius in z = 0 and apex (0, 0, height).
struct SphericalDishPrimitive {
  double radius = 0, height = 0;
};

/// Tube of radius `tube_radius` round a circle of radius `centre_radius` in the XY plane, swept
/// from +X counter-clockwise about +Z by `angle`.
struct CircularTorusPrimitive {
  double centre_radius = 0, tube_radius = 0, angle = 0;
};

/// Rectangle [inner_radius, outer_radius] x [-height/2, height/2] in (radial, z), swept as a
/// circular torus.
struct RectangularTorusPrimitive {
  double inner_radius = 0, outer_radius = 0, height = 0, angle = 0;
};

/// A centre line along local Z, centred on the origin: drawn, and checked for clashes only on
/// request.
struct LinePrimitive {
  double half_width = 0, length = 0;
};

using Primitive = std::variant<BoxPrimitive, PyramidPrimitive, CylinderPrimitive, SnoutPrimitive,
                               SpherePrimitive, EllipticalDishPrimitive, SphericalDishPrimitive,
                               CircularTorusPrimitive, RectangularTorusPrimitive, LinePrimitive>;

/// Whether a primitive is curved all round: a cylinder, snout, sphere, dish or circular torus. Its
/// facets stand for a smooth surface, whose silhouette depends on the viewpoint.
[[nodiscard]] bool is_round(const Primitive& primitive);

/// Whether a primitive has a curved face at all, so that its triangles depend on the sag.
[[nodiscard]] bool is_curved(const Primitive& primitive);

/// Returns the stable name of a primitive's kind, as reports and JSON spell it ("circular_torus").
[[nodiscard]] std::string_view kind_name(const Primitive& primitive);

}  // namespace strake::geometry
