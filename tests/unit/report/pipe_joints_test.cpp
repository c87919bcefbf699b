// SPDX-License-Identifier: Apache-2.0
#include "report/exchange/pipe_joints.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "strake/report/clash.hpp"
#include "support/clash_model.hpp"

namespace strake::report {
namespace {

using test::ClashModel;

geometry::Placement at(double x, double y, double z) { return {{}, {x, y, z}}; }

/// An upright pipe whose middle is at the place.
ClashModel& pipe(ClashModel& m, const std::string& id, double radius, double height,
                 const geometry::Placement& place) {
  return m.object(id).body(geometry::CylinderPrimitive{radius, height}, place);
}

std::vector<PipeJoint> joints_of(const ClashModel& m) {
  const clash::Findings findings{{m.detect()}, {}};
  const Result<std::vector<PipeJoint>> joints = pipe_joints({findings, m.model}, {});
  EXPECT_TRUE(joints);
  return joints ? *joints : std::vector<PipeJoint>();
}

TEST(PipeJoints, TwoEndsThatMeetHaveTheirDiameters) {
  ClashModel m;
  pipe(m, "a", 50, 1000, at(0, 0, 500));
  pipe(m, "b", 40, 600, at(0, 0, 1300.5));
  const std::vector<PipeJoint> joints = joints_of(m);
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_EQ(joints[0].kind, JointKind::end_to_end);
  EXPECT_EQ(joints[0].at_mm, (geometry::Vec3d{0, 0, 1000.25}));
  EXPECT_EQ(joints[0].a_diameter_mm, 100);
  EXPECT_EQ(joints[0].b_diameter_mm, 80);
}

TEST(PipeJoints, AScaledPipeHasTheDiameterOfItsPlace) {
  ClashModel m;
  pipe(m, "a", 50, 1000, at(0, 0, 500));
  geometry::Placement twice = at(0, 0, 1600);
  for (geometry::Vec3d& row : twice.linear.row) row = row * 2;
  pipe(m, "b", 40, 600, twice);
  const std::vector<PipeJoint> joints = joints_of(m);
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_EQ(joints[0].b_diameter_mm, 160);
}

TEST(PipeJoints, AnEndOnASideIsThatOfTheBranch) {
  ClashModel m;
  pipe(m, "main", 50, 2000, at(0, 0, 0));
  // Along x, from the side of the first one on.
  geometry::Placement lying = at(550, 0, 0);
  lying.linear.row = {geometry::Vec3d{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}};
  pipe(m, "zz", 10, 1000, lying);
  const std::vector<PipeJoint> joints = joints_of(m);
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_EQ(joints[0].kind, JointKind::end_on_side);
  EXPECT_EQ(joints[0].at_mm, (geometry::Vec3d{50, 0, 0}));
  EXPECT_FALSE(joints[0].a_diameter_mm);
  EXPECT_EQ(joints[0].b_diameter_mm, 20);
}

TEST(PipeJoints, PipesThatTouchElsewhereLieSideBySide) {
  ClashModel m;
  pipe(m, "a", 50, 1000, at(0, 0, 0));
  geometry::Placement across = at(100, 0, 0);
  across.linear.row = {geometry::Vec3d{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
  pipe(m, "b", 50, 1000, across);
  const std::vector<PipeJoint> joints = joints_of(m);
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_EQ(joints[0].kind, JointKind::side_by_side);
  EXPECT_FALSE(joints[0].a_diameter_mm);
}

TEST(PipeJoints, WhatHasNoRoundEndsIsNoPipe) {
  ClashModel m;
  pipe(m, "a", 50, 1000, at(0, 0, 500));
  m.box("floor", {-500, -500, -100}, {500, 500, 0});
  m.object("beam").body(geometry::BoxPrimitive{100, 100, 900}, at(0, 0, 1450));
  EXPECT_TRUE(joints_of(m).empty());
}

TEST(PipeJoints, TwoThatMeetAtBothEndsHaveTwoJoints) {
  ClashModel m;
  m.object("a").body(geometry::CylinderPrimitive{50, 200}, at(0, 0, 100));
  m.again(at(0, 0, 1100));
  pipe(m, "b", 50, 800, at(0, 0, 600));
  const std::vector<PipeJoint> joints = joints_of(m);
  ASSERT_EQ(joints.size(), 2U);
  EXPECT_EQ(joints[0].at_mm.z + joints[1].at_mm.z, 1200);
}

TEST(PipeJoints, AreRowsOfCsvWithNamesThatAreNoFormulas) {
  ClashModel m;
  pipe(m, "=a", 50, 1000, at(0, 0, 500));
  pipe(m, "b", 40, 600, at(0, 0, 1300));
  const clash::Findings findings{{m.detect()}, {}};
  std::string csv;
  ASSERT_TRUE(write_joints_csv({findings, m.model}, [&](std::string_view s) { csv += s; }));
  EXPECT_TRUE(csv.starts_with("test,key,kind,a_id,a_name,a_file,")) << csv;
  EXPECT_NE(csv.find(",end_to_end,'=a,'=a,t.obj,b,b,t.obj,0,0,1000,100,80,0,\r\n"), csv.npos)
      << csv;
}

}  // namespace
}  // namespace strake::report
