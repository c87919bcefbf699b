// SPDX-License-Identifier: Apache-2.0
#include "bcf/output/viewpoint_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "bcf/topics/ifc_guid.hpp"
#include "bcf/xml/xml_text.hpp"
#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "pictures/clash_picture.hpp"
#include "report/clash/contents.hpp"

namespace strake::bcf {
namespace {

constexpr double kMmPerMetre = 1000;
constexpr std::string_view kFieldOfView = "45";         ///< degrees, from below to above
constexpr double kTangentOfHalf = 0.41421356237309503;  ///< of that angle

/// The objects of the two sides, each once.
struct Sides {
  std::set<model::ObjectId> a, b;
  [[nodiscard]] std::size_t size() const { return a.size() + b.size(); }
};

/// An object of several results keeps its side, so that a beam with forty pipes through it has one
/// colour and the pipes the other, whichever of them is a.
Sides sides_of(const report::ClashContents& contents, const PlannedTopic& topic) {
  Sides sides;
  for (const clash::ResultRef& result : topic.results) {
    const clash::Pair& pair = pair_of(contents, result);
    if (sides.size() + 2 > kMaxComponents) break;
    const bool swapped = sides.b.contains(pair.a) || sides.a.contains(pair.b);
    const model::ObjectId first = swapped ? pair.b : pair.a, second = swapped ? pair.a : pair.b;
    if (!sides.b.contains(first)) sides.a.insert(first);
    if (!sides.a.contains(second)) sides.b.insert(second);
  }
  return sides;
}

/// Returns a colour as AARRGGBB.
std::string argb(const pictures::Colour& colour) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string text = "FF";
  for (const std::uint8_t part : {colour.red, colour.green, colour.blue}) {
    text += kHex[part >> 4U];
    text += kHex[part & 0x0FU];
  }
  return text;
}

class ViewpointWriter {
 public:
  ViewpointWriter(const report::ClashContents& contents, const std::string& guid)
      : contents_(contents), xml_("VisualizationInfo") {
    xml_.attribute("Guid", guid);
  }

  std::string write(const Sides& sides, const pictures::ClashViewpoint& viewpoint) {
    xml_.begin("Components");
    selection(sides);
    xml_.begin("Visibility").attribute("DefaultVisibility", "true").end();
    xml_.begin("Coloring");
    color(pictures::kColourOfA, sides.a);
    color(pictures::kColourOfB, sides.b);
    xml_.end().end();
    camera(viewpoint);
    if (!viewpoint.clipping_planes.empty()) {
      xml_.begin("ClippingPlanes");
      for (const pictures::ClippingPlane& plane : viewpoint.clipping_planes)
        xml_.begin("ClippingPlane")
            .vector("Location", plane.point_mm, kMmPerMetre)
            .vector("Direction", plane.normal, 1)
            .end();
      xml_.end();
    }
    return xml_.finish();
  }

 private:
  void selection(const Sides& sides) {
    xml_.begin("Selection");
    for (const std::set<model::ObjectId>* const side : {&sides.a, &sides.b})
      for (const model::ObjectId id : *side) component(id);
    xml_.end();
  }

  void color(const pictures::Colour& colour, const std::set<model::ObjectId>& ids) {
    if (ids.empty()) return;
    xml_.begin("Color").attribute("Color", argb(colour));
    if (contents_.bcf.version_3) xml_.begin("Components");
    for (const model::ObjectId id : ids) component(id);
    if (contents_.bcf.version_3) xml_.end();
    xml_.end();
  }

  void component(model::ObjectId id) {
    const model::Object& object = contents_.model.object(id);
    xml_.begin("Component");
    if (const std::string guid = ifc_guid(contents_.model, object); !guid.empty())
      xml_.attribute("IfcGuid", guid);
    else
      xml_.leaf_if("OriginatingSystem", contents_.model.files[object.file].format)
          .leaf_if("AuthoringToolId", object.id);
    xml_.end();
  }

  /// Version 2.1 requests 45 to 60 degrees. On the line of sight the eye may stand where the same
  /// height is seen by such an angle: nothing new comes before what was seen.
  void camera(const pictures::ClashViewpoint& viewpoint) {
    const double away_mm = viewpoint.half_height_mm / kTangentOfHalf;
    const geometry::Vec3d eye_mm = viewpoint.target_mm - viewpoint.direction * away_mm;
    xml_.begin("PerspectiveCamera").vector("CameraViewPoint", eye_mm, kMmPerMetre);
    xml_.vector("CameraDirection", viewpoint.direction, 1)
        .vector("CameraUpVector", viewpoint.up, 1);
    xml_.leaf("FieldOfView", kFieldOfView);
    if (contents_.bcf.version_3) xml_.leaf("AspectRatio", shortest(viewpoint.aspect));
    xml_.end();
  }

  const report::ClashContents& contents_;
  XmlWriter xml_;
};

}  // namespace

std::string viewpoint_file(const report::ClashContents& contents, const PlannedTopic& topic,
                           const std::string& guid, const pictures::ClashViewpoint& viewpoint) {
  return ViewpointWriter(contents, guid).write(sides_of(contents, topic), viewpoint);
}

}  // namespace strake::bcf
