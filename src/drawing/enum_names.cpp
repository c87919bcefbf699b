// SPDX-License-Identifier: Apache-2.0
#include "strake/drawing/drawing.hpp"

namespace strake::drawing {

LineState line_state(hlr::State state) {
  switch (state) {
    case hlr::State::visible:
      return LineState::visible;
    case hlr::State::hidden_by_self:
      return LineState::hidden_by_self;
    case hlr::State::hidden_by_other:
      return LineState::hidden_by_other;
    case hlr::State::projecting:
      return LineState::projecting;
    case hlr::State::clipped:
      return LineState::clipped;
  }
  return LineState::clipped;
}

std::string_view state_name(LineState state) {
  switch (state) {
    case LineState::visible:
      return "visible";
    case LineState::hidden_by_self:
      return "hidden_by_self";
    case LineState::hidden_by_other:
      return "hidden_by_other";
    case LineState::projecting:
      return "projecting";
    case LineState::clipped:
      return "clipped";
    case LineState::duplicate:
      return "duplicate";
  }
  return "";
}

std::string_view kind_name(hlr::EdgeKind kind) {
  switch (kind) {
    case hlr::EdgeKind::sharp:
      return "sharp";
    case hlr::EdgeKind::contour:
      return "contour";
    case hlr::EdgeKind::boundary:
      return "boundary";
    case hlr::EdgeKind::non_manifold:
      return "non_manifold";
    case hlr::EdgeKind::polyline:
      return "polyline";
    case hlr::EdgeKind::intersection:
      return "intersection";
    case hlr::EdgeKind::section:
      return "section";
    case hlr::EdgeKind::hatch:
      return "hatch";
    case hlr::EdgeKind::smooth:
      return "smooth";
    case hlr::EdgeKind::single_line:
      return "single_line";
  }
  return "";
}

std::string_view stage_name(hlr::Stage stage) {
  switch (stage) {
    case hlr::Stage::none:
      return "none";
    case hlr::Stage::local:
      return "local";
    case hlr::Stage::global:
      return "global";
  }
  return "";
}

std::string_view smooth_name(hlr::Smooth smooth) {
  switch (smooth) {
    case hlr::Smooth::off:
      return "off";
    case hlr::Smooth::tangent:
      return "tangent";
    case hlr::Smooth::all:
      return "on";
  }
  return "";
}

std::string_view intersections_name(hlr::Intersections intersections) {
  switch (intersections) {
    case hlr::Intersections::off:
      return "off";
    case hlr::Intersections::objects:
      return "objects";
    case hlr::Intersections::primitives:
      return "primitives";
    case hlr::Intersections::parts:
      return "parts";
  }
  return "";
}

std::string_view own_polylines_name(hlr::OwnPolylines polylines) {
  return polylines == hlr::OwnPolylines::hidden ? "hidden" : "visible";
}

std::string_view fate_name(hlr::Fate fate) {
  switch (fate) {
    case hlr::Fate::unselected:
      return "unselected";
    case hlr::Fate::drawn:
      return "drawn";
    case hlr::Fate::coincident:
      return "coincident";
    case hlr::Fate::hidden:
      return "hidden";
    case hlr::Fate::clipped:
      return "clipped";
    case hlr::Fate::degenerate:
      return "degenerate";
    case hlr::Fate::failed:
      return "failed";
    case hlr::Fate::left_out:
      return "left_out";
  }
  return "";
}

}  // namespace strake::drawing
