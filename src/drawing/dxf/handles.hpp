// SPDX-License-Identifier: Apache-2.0
// The handles of what every file holds, and the names that entities refer to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "drawing/dxf/groups.hpp"

namespace strake::drawing::dxf {

inline constexpr Handle kViewportTable = 0x1, kLineTypeTable = 0x2, kLayerTable = 0x3,
                        kStyleTable = 0x4, kViewTable = 0x5, kUcsTable = 0x6, kAppTable = 0x7,
                        kDimensionTable = 0x8, kBlockTable = 0x9;
inline constexpr Handle kActiveViewport = 0x10, kByBlock = 0x11, kByLayer = 0x12,
                        kContinuous = 0x13, kLayerZero = 0x14, kStandardStyle = 0x15,
                        kDrawingStyle = 0x16, kAcadApp = 0x17, kStrakeApp = 0x18,
                        kDescriptionApp = 0x19, kStandardDimension = 0x1A;
inline constexpr Handle kModelSpace = 0x20, kModelBlock = 0x21, kModelBlockEnd = 0x22,
                        kModelLayout = 0x23, kPaperSpace = 0x24, kPaperBlock = 0x25,
                        kPaperBlockEnd = 0x26, kPaperLayout = 0x27;
inline constexpr Handle kRoot = 0x30, kGroups = 0x31, kLayouts = 0x32, kLineStyles = 0x33,
                        kLineStyle = 0x34, kPlotStyles = 0x35, kNormalPlotStyle = 0x36,
                        kWipeoutVariables = 0x37;
/// Where layers begin, types of lines, of which there are no more, and entities, the paper itself
/// first: they begin farther on where there are many layers.
inline constexpr Handle kFirstLayer = 0x100, kFirstLineType = 0x200, kFirstEntity = 0x1000;
[[nodiscard]] inline Handle first_line_type(std::size_t layers) {
  return std::max<Handle>(kFirstLineType, kFirstLayer + layers);
}
[[nodiscard]] inline Handle first_entity(std::size_t layers) {
  return std::max<Handle>(kFirstEntity, first_line_type(layers) + layers);
}

/// The style of all texts.
inline constexpr std::string_view kTextStyle = "STRAKE";
/// The application whose extended data says what object an entity is of.
inline constexpr std::string_view kApplication = "STRAKE";
/// The application whose extended data describes a layer.
inline constexpr std::string_view kDescriptionApplication = "AcAecLayerStandard";

}  // namespace strake::drawing::dxf
