// SPDX-License-Identifier: Apache-2.0
// peer_occt_poly SCENE.obj X,Y,Z DEGREES LINES: HLRBRep_PolyAlgo on a scene of meshes. Writes the
// visible lines into the file LINES (kind, two points of the model in mm) and prints one line,
// RESULT and JSON: seconds of the hiding alone.
//
// Every part becomes one shell with a planar face for each set of coplanar triangles that hang
// together: so OCCT has no edge more to hide than Strake. Edges flatter than DEGREES are marked
// smooth, and their lines come out apart.
#include <fmt/core.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Plane.hxx>
#include <HLRAlgo_Projector.hxx>
#include <HLRBRep_PolyAlgo.hxx>
#include <HLRBRep_PolyHLRToShape.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <Standard_Version.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gp_Pln.hxx>
#include <numbers>
#include <optional>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

#include "clocks.hpp"
#include "core/union_find.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/scene.hpp"

namespace {

using namespace strake;
using geometry::Part;
using geometry::PartEdge;
using geometry::PlacedPart;
using geometry::Vec3d;

/// What OCCT takes two points for one within, mm: that of vertices, edges and faces here.
constexpr double kTolerance_mm = 0.01;
/// How far rounding to the grid may have put a corner beside the plane of its face, mm.
constexpr double kBent_mm = 0.002;

gp_Pnt point_of(const Vec3d& p) { return {p.x, p.y, p.z}; }

/// A part as OCCT has shapes.
class ShellOf {
 public:
  ShellOf(const PlacedPart& placed, double sharp_deg)
      : part_(*placed.part),
        smooth_cosine_(std::cos(sharp_deg * std::numbers::pi / 180)),
        regions_(part_.triangles.size()) {
    for (const geometry::Vec3i& v : part_.vertices) {
      points_.push_back(to_mm(placed.origin + v.as<std::int64_t>()));
      builder_.MakeVertex(vertices_.emplace_back(), point_of(points_.back()), kTolerance_mm);
    }
    for (const geometry::Triangle& t : part_.triangles) normals_.push_back(normal_of(t));
    join_coplanar();
    make_faces();
  }

  [[nodiscard]] TopoDS_Shell shell() {
    TopoDS_Shell shell;
    builder_.MakeShell(shell);
    for (std::size_t i = 0; i + 1 < part_.edges.size(); ++i) add_edge(i);
    for (Face& f : faces_) {
      if (f.shape.IsNull()) continue;
      builder_.Add(f.shape, f.wire);
      builder_.Add(shell, f.shape);
    }
    return shell;
  }

 private:
  struct Face {
    TopoDS_Face shape;
    TopoDS_Wire wire;
    Handle(Poly_Triangulation) mesh;
    std::vector<std::uint32_t> vertices;  ///< of the part, ascending: node i + 1 is vertices[i]

    [[nodiscard]] int node(std::uint32_t vertex) const {
      const auto at = std::lower_bound(vertices.begin(), vertices.end(), vertex);
      return static_cast<int>(at - vertices.begin()) + 1;
    }
  };

  [[nodiscard]] Vec3d normal_of(const geometry::Triangle& t) const {
    const Vec3d n = cross(points_[t[1]] - points_[t[0]], points_[t[2]] - points_[t[0]]);
    return n * (1 / std::sqrt(dot(n, n)));
  }

  /// The triangles of an edge that has two, one on each side.
  [[nodiscard]] std::optional<std::pair<std::uint32_t, std::uint32_t>> two_of(
      std::size_t edge) const {
    const std::uint32_t first = part_.edges[edge].first_triangle;
    if (part_.edges[edge + 1].first_triangle != first + 2) return std::nullopt;
    return std::pair{part_.edge_triangles[first], part_.edge_triangles[first + 1]};
  }

  /// Whether no corner of triangle u lies off the plane of triangle t.
  [[nodiscard]] bool in_plane_of(std::uint32_t t, std::uint32_t u) const {
    const Vec3d& origin = points_[part_.triangles[t][0]];
    return std::ranges::all_of(part_.triangles[u], [&](std::uint32_t v) {
      return std::fabs(dot(normals_[t], points_[v] - origin)) < kBent_mm;
    });
  }

  void join_coplanar() {
    for (std::size_t i = 0; i + 1 < part_.edges.size(); ++i)
      if (const auto two = two_of(i); two && dot(normals_[two->first], normals_[two->second]) > 0 &&
                                      in_plane_of(two->first, two->second) &&
                                      in_plane_of(two->second, two->first))
        regions_.join(two->first, two->second);
  }

  void make_faces() {
    faces_.resize(part_.triangles.size());
    std::vector<std::vector<std::uint32_t>> members(part_.triangles.size());
    for (std::uint32_t t = 0; t < part_.triangles.size(); ++t)
      members[regions_.root(t)].push_back(t);
    for (std::size_t r = 0; r < members.size(); ++r)
      if (!members[r].empty()) make_face(members[r], faces_[r]);
  }

  void make_face(const std::vector<std::uint32_t>& triangles, Face& face) {
    for (const std::uint32_t t : triangles)
      face.vertices.insert(face.vertices.end(), part_.triangles[t].begin(),
                           part_.triangles[t].end());
    std::ranges::sort(face.vertices);
    const auto twice = std::ranges::unique(face.vertices);
    face.vertices.erase(twice.begin(), twice.end());
    face.mesh = new Poly_Triangulation(static_cast<int>(face.vertices.size()),
                                       static_cast<int>(triangles.size()), false);
    for (std::size_t i = 0; i < face.vertices.size(); ++i)
      face.mesh->SetNode(static_cast<int>(i) + 1, point_of(points_[face.vertices[i]]));
    int number = 0;
    for (const std::uint32_t t : triangles) {
      const geometry::Triangle& corner = part_.triangles[t];
      face.mesh->SetTriangle(++number, Poly_Triangle(face.node(corner[0]), face.node(corner[1]),
                                                     face.node(corner[2])));
    }
    const Vec3d& n = normals_[triangles.front()];
    builder_.MakeFace(
        face.shape, new Geom_Plane(point_of(points_[face.vertices.front()]), gp_Dir(n.x, n.y, n.z)),
        kTolerance_mm);
    builder_.UpdateFace(face.shape, face.mesh);
    builder_.MakeWire(face.wire);
  }

  /// An edge into the outlines of its faces; none within one face.
  void add_edge(std::size_t i) {
    const PartEdge& e = part_.edges[i];
    const auto two = two_of(i);
    if (two && regions_.joined(two->first, two->second)) return;
    const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(vertices_[e.v0], vertices_[e.v1]).Edge();
    for (std::uint32_t k = e.first_triangle; k < part_.edges[i + 1].first_triangle; ++k) {
      const std::uint32_t t = part_.edge_triangles[k];
      Face& face = faces_[regions_.root(t)];
      TColStd_Array1OfInteger nodes(1, 2);
      nodes(1) = face.node(e.v0);
      nodes(2) = face.node(e.v1);
      TColStd_Array1OfReal range(1, 2);
      BRep_Tool::Range(edge, range(1), range(2));
      builder_.UpdateEdge(edge, new Poly_PolygonOnTriangulation(nodes, range), face.mesh,
                          TopLoc_Location());
      builder_.Add(face.wire, edge.Oriented(runs_along(t, e) ? TopAbs_FORWARD : TopAbs_REVERSED));
    }
    if (two && dot(normals_[two->first], normals_[two->second]) > smooth_cosine_)
      builder_.Continuity(edge, faces_[regions_.root(two->first)].shape,
                          faces_[regions_.root(two->second)].shape, GeomAbs_G1);
  }

  /// Whether the triangle runs from v0 to v1.
  [[nodiscard]] bool runs_along(std::uint32_t triangle, const PartEdge& e) const {
    const geometry::Triangle& t = part_.triangles[triangle];
    for (std::size_t k = 0; k < 3; ++k)
      if (t[k] == e.v0) return t[(k + 1) % 3] == e.v1;
    return false;
  }

  const Part& part_;
  double smooth_cosine_;
  BRep_Builder builder_;
  UnionFind regions_;  ///< of triangles that are one face
  std::vector<Vec3d> points_, normals_;
  std::vector<TopoDS_Vertex> vertices_;
  std::vector<Face> faces_;  ///< by the root of their triangles
};

/// Points of the paper as points of the model, on the plane through its origin.
void write_lines(std::ostream& out, std::string_view kind, const TopoDS_Shape& shape,
                 const gp_Ax2& view) {
  if (shape.IsNull()) return;
  const auto text = [&](const gp_Pnt& p) {
    const gp_XYZ m = view.XDirection().XYZ() * p.X() + view.YDirection().XYZ() * p.Y();
    return fmt::format("{} {} {}", m.X(), m.Y(), m.Z());
  };
  for (TopExp_Explorer at(shape, TopAbs_EDGE); at.More(); at.Next()) {
    TopoDS_Vertex a, b;
    TopExp::Vertices(TopoDS::Edge(at.Current()), a, b);
    if (!a.IsNull() && !b.IsNull())
      out << kind << ' ' << text(BRep_Tool::Pnt(a)) << ' ' << text(BRep_Tool::Pnt(b)) << '\n';
  }
}

std::vector<TopoDS_Shell> shells_of(const model::Scene& scene, double sharp_deg) {
  std::vector<TopoDS_Shell> shells;
  for (const model::GridBody& body : scene.bodies)
    for (const Part& part : scene.shapes[body.grid_shape].parts)
      if (!part.triangles.empty())
        shells.push_back(ShellOf({&part, body.origin}, sharp_deg).shell());
  return shells;
}

struct Task {
  std::filesystem::path scene, lines;
  gp_Dir direction;
  double sharp_deg = 0;
};

int run(const Task& task) {
  bench::Lap lap;
  const auto model = io::read_models(std::vector<std::filesystem::path>{task.scene}, {}, {});
  if (!model) return fmt::print(stderr, "{}\n", model.error().text()), 1;
  const auto scene = model::make_scene(*model, {}, {});
  if (!scene) return fmt::print(stderr, "{}\n", scene.error().text()), 1;
  const std::vector<TopoDS_Shell> shells = shells_of(*scene, task.sharp_deg);
  const gp_Ax2 view(gp_Pnt(0, 0, 0), task.direction);
  const double load_s = lap();
  bench::CpuLap cpu;
  const Handle(HLRBRep_PolyAlgo) algo = new HLRBRep_PolyAlgo;
  for (const TopoDS_Shell& s : shells) algo->Load(s);
  algo->Projector(HLRAlgo_Projector(view));
  algo->Update();
  HLRBRep_PolyHLRToShape result;
  result.Update(algo);
  const TopoDS_Shape sharp = result.VCompound(), contours = result.OutLineVCompound();
  const double hide_cpu_s = cpu(), hide_s = lap();
  std::ofstream out(task.lines);
  write_lines(out, "sharp", sharp, view);
  write_lines(out, "contour", contours, view);
  fmt::print("RESULT {{\"version\": \"OCCT {}\", \"load_s\": {}, \"wall_s\": {}, \"cpu_s\": {}}}\n",
             OCC_VERSION_COMPLETE, load_s, hide_s, hide_cpu_s);
  return out.flush() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::array<double, 3> d{};
  if (argc != 5 || std::sscanf(argv[2], "%lf,%lf,%lf", &d[0], &d[1], &d[2]) != 3) {
    fmt::print(stderr, "usage: peer_occt_poly SCENE.obj X,Y,Z DEGREES LINES\n");
    return 2;
  }
  try {
    return run({argv[1], argv[4], gp_Dir(d[0], d[1], d[2]), std::atof(argv[3])});
  } catch (const Standard_Failure& failure) {
    fmt::print(stderr, "OCCT: {}\n", failure.GetMessageString());
    return 1;
  }
}
