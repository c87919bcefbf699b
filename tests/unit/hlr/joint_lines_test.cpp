// SPDX-License-Identifier: Apache-2.0
// Components of a plant, one object of several primitives: a line where one passes through another,
// none where they go on in each other.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "support/draw.hpp"

namespace strake {
namespace {

using geometry::CircularTorusPrimitive;
using geometry::CylinderPrimitive;
using geometry::Mat3d;
using geometry::SnoutPrimitive;
using geometry::Vec3d;
using geometry::Vec3l;
using hlr::EdgeKind;
using hlr::Intersections;

constexpr double kPi = std::numbers::pi;
constexpr std::uint64_t kRunsSeed = 5;

/// z to x, x to y, y to z.
const Mat3d kAlongX{{Vec3d{0, 0, 1}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}}};

/// One object.
class Component {
 public:
  explicit Component(const Mat3d& turn = {}) : turn_(turn) {
    model_.files.emplace_back();
    model_.objects.emplace_back();
    model_.objects[0].id = "component";
  }
  Component& add(const geometry::Primitive& primitive, const Mat3d& linear = {},
                 const Vec3d& at = {}) {
    model_.shapes.emplace_back(primitive);
    model::Body body;
    body.shape = model::ShapeId{static_cast<std::uint32_t>(model_.shapes.size() - 1)};
    body.placement = {product(linear), turn_ * at};
    model_.bodies.push_back(body);
    ++model_.objects[0].body_count;
    return *this;
  }
  /// `sag_mm` 0: that of the scene, 0.5.
  [[nodiscard]] std::vector<hlr::EdgePiece> intersections(
      const Vec3l& direction, Intersections which = Intersections::primitives,
      double sag_mm = 0) const {
    std::vector<hlr::EdgePiece> lines;
    const auto scene = model::make_scene(model_, {.sag_mm = 0.5}, {});
    EXPECT_TRUE(scene);
    if (!scene) return lines;
    const auto drawing = hlr::draw(*scene, {}, {.direction = direction, .limits = {}},
                                   {.intersections = which, .sag_mm = sag_mm}, {});
    EXPECT_TRUE(drawing);
    if (!drawing) return lines;
    EXPECT_EQ(drawing->sag_mm, sag_mm > 0 ? sag_mm : 0.5);
    for (const hlr::EdgePiece& p : drawing->pieces)
      if (p.kind == EdgeKind::intersection) lines.push_back(p);
    return lines;
  }

 private:
  [[nodiscard]] Mat3d product(const Mat3d& m) const {
    Mat3d result;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3d column =
          turn_ * Vec3d{m.row[0][static_cast<int>(c)], m.row[1][static_cast<int>(c)],
                        m.row[2][static_cast<int>(c)]};
      for (int r = 0; r < 3; ++r)
        result.row[static_cast<std::size_t>(r)][static_cast<int>(c)] = column[r];
    }
    return result;
  }

  Mat3d turn_;
  model::Model model_;
};

double length_mm(const std::vector<hlr::EdgePiece>& lines) {
  double sum = 0;
  for (const hlr::EdgePiece& p : lines) {
    const Vec3d v = (p.b - p.a).as<double>();
    sum += std::sqrt(dot(v, v)) / 1000;
  }
  return sum;
}

Component tee(double run, double branch, const Mat3d& turn) {
  Component component(turn);
  component.add(CylinderPrimitive{run, 6 * run}, kAlongX);
  component.add(CylinderPrimitive{branch, 3 * run}, {}, {0, 0, 1.5 * run});
  return component;
}

/// Where a branch meets a run.
double saddle_mm(double run, double branch) {
  constexpr int kSteps = 20000;
  double sum = 0;
  Vec3d last;
  for (int i = 0; i <= kSteps; ++i) {
    const double turn = 2 * kPi * i / kSteps;
    const double y = branch * std::sin(turn);
    const Vec3d p{branch * std::cos(turn), y, std::sqrt(std::max(0.0, run * run - y * y))};
    if (i > 0) sum += std::sqrt(dot(p - last, p - last));
    last = p;
  }
  return sum;
}

const std::vector<Vec3l> kDirections{{1, -1, 1}, {0, -1, 0}, {0, 0, 1}, {3, 5, -2}};

/// As it is, and turned.
std::vector<Mat3d> turns(int more) {
  test::Draw random(kRunsSeed);
  std::vector<Mat3d> result{Mat3d{}};
  for (int i = 0; i < more; ++i) result.push_back(random.rotation());
  return result;
}

TEST(JointLines, ATeeHasItsSaddle) {
  for (const Mat3d& turn : turns(3))
    for (const auto& [run, branch] :
         {std::pair{57.0, 40.0}, {57.0, 20.0}, {300.0, 250.0}, {57.0, 57.0}, {200.0, 200.0}})
      for (const Vec3l& direction : kDirections) {
        const Component component = tee(run, branch, turn);
        const double expected = saddle_mm(run, branch);
        EXPECT_NEAR(length_mm(component.intersections(direction)), expected, 0.06 * expected)
            << run << " " << branch << " from " << direction.x << "," << direction.y;
        EXPECT_TRUE(component.intersections(direction, Intersections::objects).empty());
      }
}

/// Made fine for the paper, its ends lie on both pipes to within the sag: a saddle without zigzag.
TEST(JointLines, ASaddleIsAsFineAsTheDrawingRequests) {
  for (const auto& [run, branch] : {std::pair{57.0, 36.0}, {57.0, 57.0}})
    for (const Vec3l& direction : kDirections)
      for (const double sag : {0.2, 0.05, 0.01}) {
        const auto lines =
            tee(run, branch, {}).intersections(direction, Intersections::primitives, sag);
        EXPECT_GT(lines.size(), 20U);
        for (const hlr::EdgePiece& piece : lines)
          for (const Vec3l& end : {piece.a, piece.b}) {
            const Vec3d p = end.as<double>() * 0.001;
            EXPECT_NEAR(std::hypot(p.y, p.z), run, sag + 0.002);
            EXPECT_NEAR(std::hypot(p.x, p.y), branch, sag + 0.002);
          }
      }
}

TEST(JointLines, PipesThatGoOnInEachOtherHaveNone) {
  for (const Mat3d& turn : turns(2))
    for (const double r : {20.0, 57.0, 300.0})
      for (const Vec3l& direction : kDirections) {
        Component line(turn);
        line.add(CylinderPrimitive{r, 10 * r}, kAlongX, {-5 * r, 0, 0});
        line.add(CylinderPrimitive{r, 10 * r}, kAlongX, {5 * r, 0, 0});
        line.add(SnoutPrimitive{r, r / 2, 2 * r}, kAlongX, {11 * r, 0, 0});
        line.add(CylinderPrimitive{r / 2, 4 * r}, kAlongX, {14 * r, 0, 0});
        EXPECT_EQ(line.intersections(direction).size(), 0U) << r << " from " << direction.x;
        Component bend(turn);
        bend.add(CylinderPrimitive{r, 4 * r}, {}, {3 * r, 0, 0});
        EXPECT_TRUE(bend.intersections(direction).empty());
        Component ring(turn);
        ring.add(CircularTorusPrimitive{3 * r, r, kPi});
        ring.add(CircularTorusPrimitive{3 * r, r, kPi},
                 {{Vec3d{-1, 0, 0}, Vec3d{0, -1, 0}, Vec3d{0, 0, 1}}});
        EXPECT_EQ(ring.intersections(direction).size(), 0U) << r << " from " << direction.x;
      }
}

TEST(JointLines, SpokesEndAtTheRim) {
  for (const Mat3d& turn : turns(2))
    for (const double rim : {100.0, 250.0}) {
      Component wheel(turn);
      wheel.add(CircularTorusPrimitive{rim, rim / 12, 2 * kPi});
      wheel.add(CylinderPrimitive{rim / 20, 2 * rim}, kAlongX);
      // Nearly a circle of the spoke's radius at both ends.
      const double once = 2 * kPi * rim / 20;
      const double length = length_mm(wheel.intersections({1, -1, 1}));
      EXPECT_GT(length, 1.9 * once);
      EXPECT_LT(length, 2.6 * once);
    }
}

}  // namespace
}  // namespace strake
