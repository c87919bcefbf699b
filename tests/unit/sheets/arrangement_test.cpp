// SPDX-License-Identifier: Apache-2.0
// First and third angle: who stands where, in line with whom, at which scale.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sheets/arrangement/view_arrangement.hpp"

namespace strake::sheets {
namespace {

using geometry::Vec3l;

/// Views of a body of 4000 x 2000 x 1000 mm about its lower corner.
std::vector<UnplacedView> views_of(const std::vector<ViewSlot>& slots) {
  std::vector<UnplacedView> views;
  for (const ViewSlot slot : slots) {
    UnplacedView view;
    view.slot = slot;
    view.extent = {0, 4000, 0, 1000};
    if (slot == ViewSlot::top) view.extent = {0, 4000, 0, 2000};
    if (slot == ViewSlot::bottom) view.extent = {0, 4000, -2000, 0};
    if (slot == ViewSlot::left) view.extent = {-2000, 0, 0, 1000};
    if (slot == ViewSlot::right) view.extent = {0, 2000, 0, 1000};
    if (slot == ViewSlot::iso) view.extent = {-1000, 3333.333, -1500, 1234.567};
    view.bottom_mm = 12;
    views.push_back(view);
  }
  return views;
}

const SheetArea kA3{{24, 14, 406, 283}, {{230, 239, 410, 287}}};

Arranged arranged(const std::vector<UnplacedView>& views, Projection projection,
                  const SheetArea& room = kA3, double scale = 0) {
  const auto found = arrange(views, projection, room, 15, scale);
  EXPECT_TRUE(found) << found.error().text();
  return found ? *found : Arranged{};
}

TEST(Arrangement, DirectionsBesideAFrontView) {
  const hlr::View front{{0, -1, 0}, {0, 0, 1}, {}};
  const auto is = [&](ViewSlot slot, Vec3l direction, Vec3l up) {
    const hlr::View view = view_in_slot(slot, front);
    return view.direction == direction && view.up == up;
  };
  EXPECT_TRUE(is(ViewSlot::top, {0, 0, 1}, {0, 1, 0}));
  EXPECT_TRUE(is(ViewSlot::bottom, {0, 0, -1}, {0, -1, 0}));
  EXPECT_TRUE(is(ViewSlot::left, {-1, 0, 0}, {0, 0, 1}));
  EXPECT_TRUE(is(ViewSlot::right, {1, 0, 0}, {0, 0, 1}));
  EXPECT_TRUE(is(ViewSlot::back, {0, 1, 0}, {0, 0, 1}));
  EXPECT_TRUE(is(ViewSlot::iso, {1, -1, 1}, {0, 0, 1}));
  // Of a plan with x to the right, the view from below has x to the right as well.
  const hlr::View plan{{0, 0, 1}, {0, 1, 0}, {}};
  EXPECT_EQ(view_in_slot(ViewSlot::top, plan).direction, Vec3l(0, 1, 0));
  EXPECT_EQ(view_in_slot(ViewSlot::right, plan).direction, Vec3l(1, 0, 0));
}

TEST(Arrangement, FirstAngleStandsAcrossThirdAngleBeside) {
  const auto views =
      views_of({ViewSlot::front, ViewSlot::top, ViewSlot::bottom, ViewSlot::left, ViewSlot::right});
  for (const Projection projection : {Projection::first_angle, Projection::third_angle}) {
    const Arranged a = arranged(views, projection);
    EXPECT_TRUE(a.fits);
    std::vector<PaperBox> box;
    for (std::size_t v = 0; v < views.size(); ++v) box.push_back(views[v].at(a.at[v], a.scale));
    const bool first = projection == Projection::first_angle;
    EXPECT_EQ(box[1].top > box[0].bottom, first);  // top view below
    EXPECT_EQ(box[2].bottom < box[0].top, first);  // bottom view above
    EXPECT_EQ(box[3].left > box[0].right, first);  // left view at the right
    EXPECT_EQ(box[4].right < box[0].left, first);  // right view at the left
    // In line to the bit: one x for a column, one y for a row.
    EXPECT_EQ(a.at[1].x, a.at[0].x);
    EXPECT_EQ(a.at[2].x, a.at[0].x);
    EXPECT_EQ(a.at[3].y, a.at[0].y);
    EXPECT_EQ(a.at[4].y, a.at[0].y);
    for (std::size_t v = 0; v < box.size(); ++v) {
      EXPECT_TRUE(kA3.takes(box[v]));
      for (std::size_t w = 0; w < v; ++w) EXPECT_FALSE(box[v].overlaps(box[w]));
    }
  }
}

TEST(Arrangement, TheLargestUsualScaleThatFitsOrTheIntermediateOneAboveIt) {
  const auto views = views_of({ViewSlot::front, ViewSlot::top, ViewSlot::left, ViewSlot::iso});
  const Arranged a = arranged(views, Projection::first_angle);
  // At 1:50 all of it takes 80 + 87 + 15 of 382 mm across: the intermediate scale has room, too.
  EXPECT_EQ(a.scale, 25);
  for (const double larger : drawing::usual_scales()) {
    if (larger >= a.scale) break;
    EXPECT_FALSE(arranged(views, Projection::first_angle, kA3, larger).fits) << larger;
  }
  EXPECT_EQ(drawing::usual_scales().front(), 0.02);
  EXPECT_TRUE(std::is_sorted(drawing::usual_scales().begin(), drawing::usual_scales().end()));
  // A scale that is given is kept, whether it fits or not.
  const Arranged given = arranged(views, Projection::first_angle, kA3, 7);
  EXPECT_EQ(given.scale, 7);
  EXPECT_FALSE(given.fits);
  EXPECT_TRUE(arranged(views, Projection::first_angle, kA3, 123).fits);
}

TEST(Arrangement, ThePictorialViewTakesAFreePlace) {
  for (const Projection projection : {Projection::first_angle, Projection::third_angle})
    for (const auto& slots : std::vector<std::vector<ViewSlot>>{
             {ViewSlot::front, ViewSlot::iso},
             {ViewSlot::front, ViewSlot::top, ViewSlot::iso},
             {ViewSlot::front, ViewSlot::top, ViewSlot::bottom, ViewSlot::left, ViewSlot::right,
              ViewSlot::back, ViewSlot::iso}}) {
      const auto views = views_of(slots);
      const Arranged a = arranged(views, projection);
      for (std::size_t v = 0; v < views.size(); ++v)
        for (std::size_t w = 0; w < v; ++w)
          EXPECT_FALSE(views[v].at(a.at[v], a.scale).overlaps(views[w].at(a.at[w], a.scale)));
    }
}

/// Front, top and left view of a box about its lower corner, and an isometric one.
std::vector<UnplacedView> views_of_box(double length, double width, double height) {
  const double s2 = std::sqrt(2.0), s6 = std::sqrt(6.0);
  std::vector<UnplacedView> views(4);
  views[0] = {ViewSlot::front, {0, length, 0, height}};
  views[1] = {ViewSlot::top, {0, length, 0, width}};
  views[2] = {ViewSlot::left, {-width, 0, 0, height}};
  views[3] = {ViewSlot::iso, {0, (length + width) / s2, -length / s6, (width + 2 * height) / s6}};
  for (UnplacedView& view : views) view.bottom_mm = 11;
  return views;
}

void expect_apart(const std::vector<UnplacedView>& views, const Arranged& a, double gap_mm) {
  for (std::size_t v = 0; v < views.size(); ++v) {
    const PaperBox box = views[v].at(a.at[v], a.scale);
    EXPECT_TRUE(kA3.takes(box)) << v;
    const double gap = gap_mm - 0.002;  // rounding to the micrometre
    const PaperBox wide{box.left - gap, box.top - gap, box.right + gap, box.bottom + gap};
    for (std::size_t w = 0; w < v; ++w)
      EXPECT_FALSE(wide.overlaps(views[w].at(a.at[w], a.scale))) << v << " and " << w;
  }
}

TEST(Arrangement, ThePictorialViewLeavesItsCellWhereThatMakesAllLarger) {
  // At 1:10 the front view is 220 mm wide and the isometric one 187 mm: no column holds it beside
  // the front view, but below the long flat ones there is room for it.
  const auto views = views_of_box(2200, 440, 220);
  const Arranged a = arranged(views, Projection::first_angle);
  EXPECT_EQ(a.scale, 10);
  EXPECT_EQ(a.at[1].x, a.at[0].x);
  EXPECT_EQ(a.at[2].y, a.at[0].y);
  expect_apart(views, a, 15);
}

TEST(Arrangement, PaperThatIsLeftIsSpreadAsFarAsTheTitleBlockAllows) {
  // Spread evenly the lowest view would lie on the title block; all in a corner nothing would be
  // spread at all.
  const auto views = views_of_box(1500, 6000, 700);
  const Arranged a = arranged(views, Projection::first_angle, kA3, 30);
  EXPECT_TRUE(a.fits);
  expect_apart(views, a, 15);
  EXPECT_GT(views[0].at(a.at[0], a.scale).left, kA3.area.left + 1);
}

/// Returns the box of all views.
PaperBox box_of_all(const std::vector<UnplacedView>& views, const Arranged& a) {
  PaperBox all = views[0].at(a.at[0], a.scale);
  for (std::size_t v = 1; v < views.size(); ++v) {
    const PaperBox box = views[v].at(a.at[v], a.scale);
    all = {std::min(all.left, box.left), std::min(all.top, box.top), std::max(all.right, box.right),
           std::max(all.bottom, box.bottom)};
  }
  return all;
}

TEST(Arrangement, NoSideOfThePaperStaysEmptyForThePictorialView) {
  // A narrow, high body: front and top view take the height, and below the left view the isometric
  // one would stand beside the title block, with the front and the left view in the left half.
  const auto views = views_of_box(3300, 12000, 9000);
  const Arranged a = arranged(views, Projection::first_angle, kA3, 100);
  EXPECT_TRUE(a.fits);
  expect_apart(views, a, 15);
  EXPECT_EQ(a.at[1].x, a.at[0].x);
  EXPECT_EQ(a.at[2].y, a.at[0].y);
  const PaperBox all = box_of_all(views, a);
  EXPECT_LT(kA3.area.right - all.right, 0.4 * kA3.area.width());
}

TEST(Arrangement, AFreePlaceIsInTheMiddleOfTheMostRoom) {
  const SheetArea room{{0, 0, 400, 200}, {{300, 150, 400, 200}}};
  const std::vector<PaperBox> others{{0, 0, 100, 100}};
  const auto place = free_place(50, 20, others, room, 10);
  ASSERT_TRUE(place);
  // At the right of the other, from 110 to 400 across, and beside what is kept free.
  EXPECT_EQ(*place, (PaperBox{230, 90, 280, 110}));
  EXPECT_FALSE(free_place(291, 95, others, room, 10));
  EXPECT_TRUE(free_place(290, 95, others, room, 10));
  EXPECT_FALSE(free_place(500, 10, others, room, 10));
  EXPECT_EQ(*free_place(400, 200, {}, {{0, 0, 400, 200}, {}}, 10), (PaperBox{0, 0, 400, 200}));
}

TEST(Arrangement, NoRoomAtAnyScaleIsAnError) {
  auto views = views_of({ViewSlot::front, ViewSlot::top});
  for (UnplacedView& view : views) view.left_mm = 300;
  const auto found = arrange(views, Projection::first_angle, {{0, 0, 200, 200}, {}}, 10, 0);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::input);
}

TEST(Arrangement, ViewsWithoutLinesHavePlacesToo) {
  std::vector<UnplacedView> views(2);
  views[0].slot = ViewSlot::front;
  views[1].slot = ViewSlot::top;
  EXPECT_TRUE(arranged(views, Projection::first_angle).fits);
}

}  // namespace
}  // namespace strake::sheets
