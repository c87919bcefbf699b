// SPDX-License-Identifier: Apache-2.0
#include "surface_sag.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <GeomAbs_CurveType.hxx>
#include <GeomAbs_SurfaceType.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <array>
#include <cmath>

namespace strake::import_step {
namespace {

double sag_of_face(const TopoDS_Face& face) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) made = BRep_Tool::Triangulation(face, location);
  if (made.IsNull() || !made->HasUVNodes()) return 0;
  const BRepAdaptor_Surface surface(face, Standard_False);
  if (surface.GetType() == GeomAbs_Plane) return 0;
  double largest = 0;
  for (int i = 1; i <= made->NbTriangles(); ++i) {
    std::array<int, 3> corner{};
    made->Triangle(i).Get(corner[0], corner[1], corner[2]);
    std::array<gp_XYZ, 3> at;
    std::array<gp_XY, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = made->Node(corner[k]).Transformed(location.Transformation()).XYZ();
      uv[k] = made->UVNode(corner[k]).XY();
    }
    const gp_XYZ normal = (at[1] - at[0]).Crossed(at[2] - at[0]);
    const double twice_area = normal.Modulus();
    // A sliver has no plane; the triangles beside it tell of the surface there.
    if (!(twice_area > 0)) continue;
    const auto measure = [&](const gp_XY& middle) {
      const gp_XYZ on_surface = surface.Value(middle.X(), middle.Y()).XYZ();
      const double off = std::abs((on_surface - at[0]).Dot(normal)) / twice_area;
      if (std::isfinite(off)) largest = std::max(largest, off);
    };
    measure((uv[0] + uv[1] + uv[2]) / 3);
    for (std::size_t k = 0; k < 3; ++k) measure((uv[k] + uv[(k + 1) % 3]) / 2);
  }
  return largest;
}

}  // namespace

bool has_flat_faces_only(const TopoDS_Shape& shape) {
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next())
    if (BRepAdaptor_Surface(TopoDS::Face(at.Current()), Standard_False).GetType() != GeomAbs_Plane)
      return false;
  for (TopExp_Explorer at(shape, TopAbs_EDGE); at.More(); at.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(at.Current());
    if (BRep_Tool::Degenerated(edge)) continue;
    if (BRepAdaptor_Curve(edge).GetType() != GeomAbs_Line) return false;
  }
  return true;
}

double largest_sag_found(const TopoDS_Shape& shape) {
  double largest = 0;
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next())
    largest = std::max(largest, sag_of_face(TopoDS::Face(at.Current())));
  return largest;
}

}  // namespace strake::import_step
