// SPDX-License-Identifier: Apache-2.0
#include "publish/pictured_workbook.hpp"

#include <array>
#include <cstdint>
#include <string>

#include "pictures/clash_picture.hpp"
#include "pictures/viewpoint.hpp"
#include "workbook/workbook_writers.hpp"

namespace strake::publish {
namespace {

constexpr std::uint32_t kWidthPx = 640, kHeightPx = 480;

Result<std::string> picture_of(const pictures::Scenery& scenery, const clash::ResultRef& result,
                               const parallel::Context& context) {
  const pictures::Subject subject = pictures::subject_of(result);
  const Result<pictures::ClashViewpoint> viewpoint =
      pictures::choose_viewpoint(scenery, subject, {}, context);
  if (!viewpoint) return viewpoint.error();
  // Names, class and depth stand in the cells beside it.
  const Result<pictures::ClashPicture> picture =
      pictures::draw_clash(scenery, subject, *viewpoint, {.caption = false}, context);
  if (!picture) return picture.error();
  return pictures::png_of(*picture, kWidthPx, kHeightPx);
}

Status write_pictured_workbook(const report::ClashContents& contents, report::Sink sink,
                               const parallel::Context& context) {
  if (contents.scene == nullptr) return workbook::write_clash_workbook(contents, sink, context);
  const Result<pictures::Scenery> scenery = pictures::Scenery::of(contents, context);
  if (!scenery) return scenery.error();
  report::ClashContents pictured = contents;
  pictured.picture_of = [&scenery](const clash::ResultRef& result,
                                   const parallel::Context& of_run) {
    return picture_of(*scenery, result, of_run);
  };
  return workbook::write_clash_workbook(pictured, sink, context);
}

constexpr std::array kWorkbookWriters{
    report::ClashWriter{workbook::kClashWorkbook, write_pictured_workbook, true},
};

}  // namespace

std::span<const report::ClashWriter> workbook_writers() { return kWorkbookWriters; }

}  // namespace strake::publish
