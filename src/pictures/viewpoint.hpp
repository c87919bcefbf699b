// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "strake/clash/group.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"

/// From where a clash is seen.
namespace strake::pictures {

class SceneIndex;

/// The model that pictures are taken of, with what finds the surroundings of a point; made once for
/// many pictures. It refers to the contents, which must outlive it.
class Scenery {
 public:
  /// Errors: usage where the contents have no scene; cancelled, out of memory.
  [[nodiscard]] static Result<Scenery> of(const report::ClashContents& contents,
                                          const parallel::Context& context);

  [[nodiscard]] const report::ClashContents& contents() const { return *contents_; }
  [[nodiscard]] const model::Scene& scene() const { return *contents_->scene; }
  [[nodiscard]] const SceneIndex& index() const { return *index_; }

 private:
  const report::ClashContents* contents_ = nullptr;
  std::shared_ptr<const SceneIndex> index_;
};

/// What a picture is of: results that are about the same, the one that it is framed by first.
struct Subject {
  std::vector<clash::ResultRef> results;
};

/// Returns one result as a subject.
[[nodiscard]] Subject subject_of(const clash::ResultRef& result);
/// Returns the results of a group: its worst first, by class, then d, then order.
[[nodiscard]] Subject subject_of(const report::ClashContents& contents, const clash::Group& group);

/// What lies on the side that the normal points to is cut away.
struct ClippingPlane {
  geometry::Vec3d point_mm;
  geometry::Vec3d normal;  ///< of length one
};

/// Where a viewer stands, in model coordinates: millimetres, z up. The view is orthographic: what
/// is seen lies before the plane through the eye that is square to the direction. A viewer in
/// perspective sees about the same from the same eye, with `field_of_view_deg`.
struct ClashViewpoint {
  geometry::Vec3d eye_mm, target_mm;
  geometry::Vec3d direction;      ///< from the eye to the target, of length one
  geometry::Vec3d up;             ///< of length one, square to the direction
  double half_height_mm = 0;      ///< half of the height of what is shown
  double field_of_view_deg = 60;  ///< from below to above
  double aspect = 4.0 / 3;        ///< width by height
  geometry::Box3d box_mm;         ///< the neighbourhood: what lies outside is left out of pictures
  /// What must be cut away for the clash to be seen; empty: it is seen as it is.
  std::vector<ClippingPlane> clipping_planes;
  /// How well the two objects are seen near the clash, 0 to 1: the harmonic mean of their shares of
  /// the window, less where other things stand before the point of the clash.
  double visible_share = 0;
};

struct ViewpointOptions {
  double aspect = 4.0 / 3;  ///< width by height, 0.2 to 5
  double zoom = 1;          ///< 2: half as much round the clash is shown; 0.05 to 20
};

/// Chooses from where a clash is seen best: of 26 directions and those square to the faces that
/// meet, the one from which most of the two objects is visible near the clash. Where nothing shows
/// them, for one is inside the other or both are walled in, what lies before is cut away, and the
/// viewpoint says so. The same clash has the same viewpoint whatever else a run finds. Errors:
/// usage for options out of range; cancelled, out of memory.
[[nodiscard]] Result<ClashViewpoint> choose_viewpoint(const Scenery& scenery,
                                                      const Subject& subject,
                                                      const ViewpointOptions& options,
                                                      const parallel::Context& context);

}  // namespace strake::pictures
