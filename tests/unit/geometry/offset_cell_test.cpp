// SPDX-License-Identifier: Apache-2.0
// What is reported a cell and of those that it is cut into holds for points of it.
#include "geometry/interior_depth/level_search/offset_cell.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "../../support/draw.hpp"
#include "../../support/nonconvex_bodies.hpp"

namespace strake::geometry {
namespace {

using testing::box_mesh;
using testing::IndexedMesh;
using testing::Subject;
using testing::turned;

class OffsetCellTest : public ::testing::Test {
 protected:
  OffsetCellTest() {
    IndexedMesh mesh = box_mesh({0, 0, 0}, {10'000, 10'000, 10'000});
    mesh.append(box_mesh({5'000, 5'000, 12'000}, {9'000, 20'000, 14'000}));
    subject_ = std::make_unique<Subject>(turned(mesh));
  }

  double in(double lo, double hi) { return draw_.between(lo, hi); }
  Vec3d point() { return {in(-12'000, 20'000), in(-12'000, 20'000), in(-12'000, 20'000)}; }

  Vec3d point_of(const OffsetCell& cell) {
    Vec3d sum;
    double all = 0;
    for (const Vec3d& p : cell.corners) {
      const double weight = in(0, 1);
      sum = sum + p * weight;
      all += weight;
    }
    return on_field_grid(sum * (1 / all));
  }

  /// Asks about a cell, then about its halves by what is known of it.
  void follow(CellCuller& scope, const DistanceField& field, const OffsetCell& cell,
              const CellCuller::CellStatus& from, int times) {
    constexpr double kSlack = 1;
    const CellHull hull(cell, kSlack);
    std::vector<Corners> crossing;
    const CellCuller::CellStatus about =
        scope.classify(hull, from, on_field_grid(middle_of(cell)), crossing, work_);
    EXPECT_EQ(crossing.empty(), about.side != CellCuller::CellSide::both);
    ++side_counts_[static_cast<std::size_t>(about.side)];
    for (int i = 0; i < 20 && about.side != CellCuller::CellSide::both; ++i)
      EXPECT_EQ(field.contains(point_of(cell), work_), about.side == CellCuller::CellSide::inside);
    if (times == 0) return;
    for (const OffsetCell& half : halves_of(cell))
      if (half.corners.size() >= 3) follow(scope, field, half, about, times - 1);
  }

  test::Draw draw_{5};
  std::unique_ptr<Subject> subject_;
  QueryContext work_;
  std::array<int, 3> side_counts_{};
};

TEST_F(OffsetCellTest, PointsOfCellsAreOnTheSideThatIsReported) {
  const PartWithBvh treed = subject_->treed();
  const DistanceField field(treed, {});
  DistanceField ready = field;
  ready.prepare();
  for (const DistanceField* of : {&field, &std::as_const(ready)}) {
    CellCuller scope(*of);
    for (int i = 0; i < 100; ++i)
      follow(scope, *of, flat_cell({point(), point(), point()}, {}), {}, 6);
  }
  for (const int times : side_counts_) EXPECT_GT(times, 1'000);
}

/// As cutting makes them: no plane is to be had from the first three.
TEST_F(OffsetCellTest, CornersInLineAtFirst) {
  const PartWithBvh treed = subject_->treed();
  const DistanceField field(treed, {});
  CellCuller scope(field);
  const auto beside = [&](const Vec3d& p) {
    return p + Vec3d{in(-4'000, 4'000), in(-4'000, 4'000), in(-4'000, 4'000)};
  };
  for (int i = 0; i < 5000; ++i) {
    const Vec3d p = point(), q = beside(p);
    const OffsetCell cell{.corners = {p, (p + q) * 0.5, q, beside(p)}, .about = {}};
    follow(scope, field, cell, {}, 0);
  }
  for (const int times : side_counts_) EXPECT_GT(times, 10);
}

}  // namespace
}  // namespace strake::geometry
