// SPDX-License-Identifier: Apache-2.0
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/config.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cstdint>
#include <memory>

#include "clocks.hpp"
#include "peers/peer.hpp"

namespace strake::bench {
namespace {

using geometry::IndexPair;
using Object = fcl::CollisionObjectd;

struct Question {
  double distance_mm = 0;  ///< 0: overlap
  std::vector<IndexPair> pairs;

  [[nodiscard]] bool yes(Object* a, Object* b) const {
    if (distance_mm > 0) {
      fcl::DistanceResultd result;
      return fcl::distance(a, b, fcl::DistanceRequestd(false), result) <= distance_mm;
    }
    fcl::CollisionResultd result;
    return fcl::collide(a, b, fcl::CollisionRequestd(1, false), result) > 0;
  }
  static bool test_pair(Object* a, Object* b, void* self) {
    auto& question = *static_cast<Question*>(self);
    const auto number = [](const Object* o) {
      return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(o->getUserData()));
    };
    if (question.yes(a, b))
      question.pairs.push_back({std::min(number(a), number(b)), std::max(number(a), number(b))});
    return false;
  }
};

std::unique_ptr<Object> object_of(const PeerObject& o, std::size_t number, double reach_mm) {
  std::vector<fcl::Vector3d> points;
  for (const auto& p : o.points) points.emplace_back(p.x, p.y, p.z);
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : o.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  const auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(points.size()));
  model->addSubModel(points, triangles);
  model->endModel();
  auto object = std::make_unique<Object>(model);
  object->setUserData(reinterpret_cast<void*>(number));
  object->computeAABB();
  // Half of the reach to either side: then the dynamic tree brings up all that are near.
  auto& box = const_cast<fcl::AABBd&>(object->getAABB());
  box.expand(fcl::Vector3d::Constant(reach_mm / 2));
  return object;
}

PeerAnswer test_pair(std::span<const PeerObject> objects, double distance_mm) {
  PeerAnswer answer;
  Lap lap;
  CpuLap cpu;
  std::vector<std::unique_ptr<Object>> own;
  std::vector<Object*> all;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].triangles.empty()) continue;
    own.push_back(object_of(objects[i], i, distance_mm));
    all.push_back(own.back().get());
  }
  fcl::DynamicAABBTreeCollisionManagerd manager;
  manager.registerObjects(all);
  manager.setup();
  answer.build_s = cpu();
  Question question{distance_mm, {}};
  manager.collide(&question, Question::test_pair);
  answer.pairs = std::move(question.pairs);
  std::sort(answer.pairs.begin(), answer.pairs.end());
  answer.query_s = cpu();
  answer.wall_s = lap();
  answer.version = "FCL " FCL_VERSION;
  return answer;
}

}  // namespace

PeerAnswer fcl_overlaps(std::span<const PeerObject> objects) { return test_pair(objects, 0); }
PeerAnswer fcl_within(std::span<const PeerObject> objects, double distance_mm) {
  return test_pair(objects, distance_mm);
}

}  // namespace strake::bench
