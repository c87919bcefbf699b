// SPDX-License-Identifier: Apache-2.0
#include "meshed_piece.hpp"

#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <Bnd_Box.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <cmath>
#include <utility>

#include "message_log.hpp"
#include "stitched_mesh.hpp"
#include "surface_sag.hpp"

namespace strake::import_step {
namespace {

/// Beyond this, in mm, nothing is built; Open CASCADE says 1e100 for what has no end.
constexpr double kLargest = 1e9;

/// Returns the length of the diagonal of a shape's box; nothing where it has no end or no
/// beginning.
std::optional<double> diagonal_of(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box, Standard_False);
  if (box.IsVoid() || box.IsOpen()) return std::nullopt;
  const gp_Pnt low = box.CornerMin(), high = box.CornerMax();
  for (const gp_Pnt& corner : {low, high})
    for (const double x : {corner.X(), corner.Y(), corner.Z()})
      if (!std::isfinite(x) || std::abs(x) > kLargest) return std::nullopt;
  return low.Distance(high);
}

void run_mesher(const TopoDS_Shape& shape, double sag_mm, const MeshOptions& options,
                const Message_ProgressRange& range) {
  IMeshTools_Parameters parameters;
  parameters.Deflection = sag_mm;
  parameters.Angle = MeshOptions::kAngle;
  parameters.InParallel = options.threads > 1;
  BRepMesh_IncrementalMesh mesher;
  mesher.SetShape(shape);
  mesher.ChangeParameters() = parameters;
  mesher.Perform(range);
}

/// Makes triangles no farther than a distance from the surface of a shape, and returns how far they
/// may be, mm: some faces, as whole balls, come out twice as coarse as requested of the mesher.
double mesh_within(const TopoDS_Shape& shape, double wanted_mm, const MeshOptions& options,
                   const Handle(ReportProgress) & progress) {
  // A face that is at odds with itself never comes near its surface: it must not cost the piece.
  constexpr int kAttempts = 3;
  constexpr double kMaxFiner = 0.4;
  double wanted_sag_mm = wanted_mm;
  for (int attempt = 1;; ++attempt) {
    run_mesher(shape, wanted_sag_mm, options, progress->Start());
    if (progress->is_over_limit()) return wanted_mm;
    if (has_flat_faces_only(shape)) return 0;
    const double sag_mm = largest_sag_found(shape, wanted_mm);
    if (!(sag_mm > wanted_mm) || attempt == kAttempts || !progress->is_early()) return sag_mm;
    wanted_sag_mm *= std::max(wanted_mm / sag_mm, kMaxFiner);
    BRepTools::Clean(shape);
  }
}

MeshedPiece mesh_bounded(const Piece& piece, double diagonal, const MeshOptions& options,
                         const Handle(ReportProgress) & progress) {
  // A ball of the finest share of its diameter has less than a million triangles.
  constexpr double kFinestShare = 2e-6, kUsualShare = 5e-4, kFinest = 1e-3;
  MeshedPiece result;
  const double wanted_mm =
      options.sag_mm.value_or(std::clamp(diagonal * kUsualShare, kFinest, MeshOptions::kSag));
  const double sag_mm = std::max(wanted_mm, diagonal * kFinestShare);
  const double made_mm = mesh_within(piece.shape, sag_mm, options, progress);
  if (progress->is_over_limit()) {
    result.fault = "making its triangles takes too long";
    return result;
  }
  StitchedMesh stitched = stitched_mesh(piece.shape);
  // What is less than the grid of a scene shows is that of computing in doubles.
  constexpr double kNothing = 1e-4;
  stitched.mesh.sag_mm = stitched.moved_mm < kNothing ? made_mm : made_mm + stitched.moved_mm;
  if (stitched.mesh.sag_mm > wanted_mm) result.coarser_sag_mm = stitched.mesh.sag_mm;
  // The triangles are needed once: a model has many pieces.
  BRepTools::Clean(piece.shape);
  result.faces_without = stitched.faces_without;
  result.is_closed = stitched.is_closed;
  result.mesh = std::move(stitched.mesh);
  if (result.mesh.triangles.empty()) result.fault = "no triangles can be made of it";
  for (const geometry::Vec3d& vertex : result.mesh.vertices)
    if (!geometry::is_finite(vertex)) result.fault = "a corner of it is not finite";
  return result;
}

MeshedPiece mesh_in_bounds(const Piece& piece, const MeshOptions& options,
                           const Handle(ReportProgress) & progress) {
  const std::optional<double> diagonal = diagonal_of(piece.shape);
  if (diagonal) return mesh_bounded(piece, *diagonal, options, progress);
  MeshedPiece failed;
  failed.fault = "it has no place, or one beyond 1000 km";
  return failed;
}

}  // namespace

MeshedPiece mesh_piece(const Piece& piece, const MeshOptions& options,
                       const Handle(ReportProgress) & progress) {
  try {
    OCC_CATCH_SIGNALS
    return mesh_in_bounds(piece, options, progress);
  } catch (const Standard_Failure& failure) {
    MeshedPiece failed;
    failed.fault = failure_text(failure);
    return failed;
  }
}

}  // namespace strake::import_step
