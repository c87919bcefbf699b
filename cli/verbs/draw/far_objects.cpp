// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/far_objects.hpp"

#include <fmt/core.h>

#include <string>

#include "drawing/layout/far_objects.hpp"
#include "drawing/layout/view_plane.hpp"

namespace strake::cli {

namespace {

/// "1:50 on 420 x 297 mm"
std::string sheet_text(const drawing::PlaneBox& box, const drawing::LayoutOptions& layout) {
  const drawing::Sheet sheet = drawing::choose_sheet(box, layout);
  return fmt::format("{} on {} x {} mm", sheet.scale_text, sheet.width_mm, sheet.height_mm);
}

}  // namespace

Status resolve_far_objects(Session& session, const model::Scene& scene, const hlr::View& view,
                        bool leave_out, std::vector<bool>& drawn, drawing::LayoutOptions& layout) {
  const Result<drawing::FarObjects> far =
      drawing::find_far_objects(scene, drawn, view, session.context());
  if (!far) return far.error();
  if (far->objects.empty()) return {};
  const std::string text = drawing::far_objects_text(*far, *scene.model);
  const bool one = far->objects.size() == 1;
  if (!leave_out) {
    session.console().note(fmt::format(
        "warning far-object: {}: the view is about {} for {}, without {} {} (--limits auto leaves "
        "{} out)",
        text, sheet_text(far->whole, layout), one ? "it" : "them", one ? "it" : "them",
        sheet_text(far->rest, layout), one ? "it" : "them"));
    return {};
  }
  drawing::leave_out(*far, *scene.model, drawn);
  layout.far_left_out = far->objects;
  session.stats().count("far objects left out", far->objects.size());
  session.console().note(fmt::format("note far-object-left-out: {} and {} left out (--limits auto)",
                                     text, one ? "is" : "are"));
  return {};
}

}  // namespace strake::cli
