// SPDX-License-Identifier: Apache-2.0
// Against FCL (doubles, triangles under trees of boxes and swept spheres): overlap and distance of
// seeded pairs. FCL asks whether surfaces share a point, Strake whether bodies do; each
// disagreement must be one of those that follow from that, or the rounding of doubles.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "strake/geometry/grid.hpp"
#include "support/solid_pairs.hpp"

namespace strake::clash {
namespace {

using test::SolidPair;
using test::StrakeAnswer;

struct PeerAnswer {
  bool overlap = false;
  double distance_mm = 0;
};

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Model> model_of(const testing::IndexedMesh& mesh) {
  std::vector<fcl::Vector3d> points;
  for (const auto& v : mesh.vertices) {
    const geometry::Vec3d p = geometry::to_mm(v.as<std::int64_t>());
    points.emplace_back(p.x, p.y, p.z);
  }
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  auto model = std::make_shared<Model>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(points.size()));
  model->addSubModel(points, triangles);
  model->endModel();
  return model;
}

PeerAnswer run_fcl(const SolidPair& pair) {
  const fcl::CollisionObjectd a(model_of(pair.a)), b(model_of(pair.b));
  fcl::CollisionResultd collision;
  fcl::DistanceResultd distance;
  PeerAnswer answer;
  answer.overlap = fcl::collide(&a, &b, fcl::CollisionRequestd(1, false), collision) > 0;
  answer.distance_mm = fcl::distance(&a, &b, fcl::DistanceRequestd(false), distance);
  return answer;
}

enum class Verdict : std::uint8_t {
  agreed,
  touch_called_overlap,  ///< surfaces share points, interiors do not: CONTACT at d = 0
  solid_inside_missed,   ///< one wholly inside the other, skins apart
  lost_in_rounding,      ///< a touch, a gap or a depth that doubles cannot tell from its opposite
  peer_contradicts_itself,  ///< "apart" at a distance of exactly 0: triangles that FCL's distance
                            ///< cannot show to be disjoint count as meeting
  unexplained,
};

/// What doubles may lose of coordinates this large: a few hundred units in their last place.
double rounding_mm(const SolidPair& pair) { return 1e-13 * pair.size_mm(); }

/// FCL measures to the skin also from within.
bool same_distance(const SolidPair& pair, const StrakeAnswer& strake, const PeerAnswer& peer) {
  const double expected = strake.cls == Class::hit ? strake.surface_distance_mm() : strake.d_mm;
  return std::fabs(peer.distance_mm - expected) <= 1e-9 * pair.size_mm();
}

Verdict compare_answers(const SolidPair& pair, const StrakeAnswer& strake, const PeerAnswer& peer) {
  const bool hit = strake.cls == Class::hit;
  // What bounds the claim that rounding is to blame: how far the truth is from its opposite.
  const bool near_tie = strake.d_lower_mm >= -rounding_mm(pair) && strake.d_mm <= rounding_mm(pair);
  if (!peer.overlap && !same_distance(pair, strake, peer))
    return peer.distance_mm == 0 ? Verdict::peer_contradicts_itself : Verdict::unexplained;
  if (peer.overlap == hit) return Verdict::agreed;
  if (peer.overlap) {
    if (strake.surfaces_meet) return Verdict::touch_called_overlap;
    return near_tie ? Verdict::lost_in_rounding : Verdict::unexplained;
  }
  // Also where the inner one touches the skin from within, and that touch is lost.
  const bool inside = strake.nested() || strake.relation == Relation::abut_inside;
  if (inside && (!strake.surfaces_meet || peer.distance_mm <= rounding_mm(pair)))
    return Verdict::solid_inside_missed;
  return near_tie ? Verdict::lost_in_rounding : Verdict::unexplained;
}

std::uint64_t pair_count() {
  const char* count = std::getenv("STRAKE_PEER_PAIRS");
  return count != nullptr ? std::strtoull(count, nullptr, 10) : 2000;
}

TEST(ClashAgainstFcl, EveryDisagreementHasItsReason) {
  const std::uint64_t pairs = pair_count();
  std::map<Verdict, std::uint64_t> verdicts;
  std::map<Class, std::uint64_t> classes;
  std::uint64_t compared = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= pairs; ++seed) {
    const SolidPair pair = test::draw_solid_pair(seed);
    const auto strake = test::strake_answer(pair);
    if (!strake) continue;
    const PeerAnswer peer = run_fcl(pair);
    const Verdict verdict = compare_answers(pair, *strake, peer);
    ++compared;
    ++verdicts[verdict];
    ++classes[strake->cls];
    if (!peer.overlap) ++apart;
    EXPECT_NE(verdict, Verdict::unexplained)
        << pair.recipe << ": " << name(strake->cls) << ' ' << name(strake->relation) << " d "
        << strake->d_mm << " [" << strake->d_lower_mm << ", " << strake->d_upper_mm << "] surfaces "
        << (strake->surfaces_meet ? "meet, " : "apart, ") << strake->surface_distance_mm()
        << "; FCL " << (peer.overlap ? "overlap " : "apart ") << peer.distance_mm;
  }
  // The comparison is worth something: most pairs count, and everything occurs.
  EXPECT_GT(compared, pairs * 6 / 10);
  for (const Class cls : {Class::clearance_violation, Class::contact, Class::hit})
    EXPECT_GT(classes[cls], compared / 10) << name(cls);
  EXPECT_GT(apart, compared / 4);
  EXPECT_GT(verdicts[Verdict::agreed], compared / 2);
  EXPECT_LT(verdicts[Verdict::peer_contradicts_itself], 1 + compared / 10'000);
  EXPECT_GT(verdicts[Verdict::touch_called_overlap], 0U);
  EXPECT_GT(verdicts[Verdict::solid_inside_missed], 0U);
  for (const auto& [verdict, count] : verdicts)
    RecordProperty("verdict_" + std::to_string(static_cast<int>(verdict)), std::to_string(count));
}

}  // namespace
}  // namespace strake::clash
