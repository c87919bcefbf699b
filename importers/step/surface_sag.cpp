// SPDX-License-Identifier: Apache-2.0
#include "surface_sag.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <GeomAbs_CurveType.hxx>
#include <GeomAbs_SurfaceType.hxx>
#include <Geom_Surface.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
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

/// Finds how far the triangles of a face are from its surface.
class FaceSag {
 public:
  FaceSag(const TopoDS_Face& face, double wanted_sag_mm)
      : surface_(BRep_Tool::Surface(face)), largest_(wanted_sag_mm) {}

  void add(const std::array<gp_XYZ, 3>& at, const std::array<gp_XY, 3>& uv) {
    const gp_XYZ normal = (at[1] - at[0]).Crossed(at[2] - at[0]);
    const double twice_area = normal.Modulus();
    // A sliver has no plane; the triangles beside it tell of the surface there.
    if (!(twice_area > 0)) return;
    const gp_XYZ unit = normal / twice_area;
    measure((at[0] + at[1] + at[2]) / 3, (uv[0] + uv[1] + uv[2]) / 3, unit);
    for (std::size_t k = 0; k < 3; ++k)
      measure((at[k] + at[(k + 1) % 3]) / 2, (uv[k] + uv[(k + 1) % 3]) / 2, unit);
  }
  [[nodiscard]] double largest() const { return largest_; }

 private:
  /// How far the surface is from the plane of the triangle is quickly told, but too much where
  /// parameters run together, as at the pole of a ball: there the point is put on the surface.
  void measure(const gp_XYZ& middle, const gp_XY& uv, const gp_XYZ& unit) {
    const gp_XYZ on_surface = surface_->Value(uv.X(), uv.Y()).XYZ();
    double off = std::abs((on_surface - middle).Dot(unit));
    if (!(off > largest_)) return;
    if (by_point_.IsNull()) by_point_ = new ShapeAnalysis_Surface(surface_);
    by_point_->ValueOfUV(gp_Pnt(middle), Precision::Confusion());
    off = std::min(off, by_point_->Gap());
    if (off > largest_ && std::isfinite(off)) largest_ = off;
  }

  Handle(Geom_Surface) surface_;
  Handle(ShapeAnalysis_Surface) by_point_;
  double largest_;
};

double sag_of_face(const TopoDS_Face& face, double wanted_sag_mm) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) made = BRep_Tool::Triangulation(face, location);
  if (made.IsNull() || !made->HasUVNodes()) return wanted_sag_mm;
  if (BRepAdaptor_Surface(face, Standard_False).GetType() == GeomAbs_Plane) return wanted_sag_mm;
  FaceSag sag(face, wanted_sag_mm);
  for (int i = 1; i <= made->NbTriangles(); ++i) {
    std::array<int, 3> corner{};
    made->Triangle(i).Get(corner[0], corner[1], corner[2]);
    std::array<gp_XYZ, 3> at;
    std::array<gp_XY, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = made->Node(corner[k]).Transformed(location.Transformation()).XYZ();
      uv[k] = made->UVNode(corner[k]).XY();
    }
    sag.add(at, uv);
  }
  return sag.largest();
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

double largest_sag_found(const TopoDS_Shape& shape, double wanted_sag_mm) {
  double largest = wanted_sag_mm;
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next())
    largest = std::max(largest, sag_of_face(TopoDS::Face(at.Current()), wanted_sag_mm));
  // The mesher stops where it is within the last digits of what was requested of it.
  constexpr double kRounding = 1.001;
  return largest > wanted_sag_mm * kRounding ? largest : wanted_sag_mm;
}

}  // namespace strake::import_step
