// SPDX-License-Identifier: Apache-2.0
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include "clocks.hpp"
#include "peers/peer.hpp"

namespace strake::bench {
namespace {

using geometry::IndexPair;
static_assert(sizeof(btScalar) == sizeof(double), "the build of Bullet in double precision");

/// An object of Bullet's own, which refers to the peer's points and triangles.
class Body {
 public:
  Body(const PeerObject& o, int number)
      : mesh_(static_cast<int>(o.triangles.size()),
              reinterpret_cast<int*>(const_cast<geometry::Triangle*>(o.triangles.data())),
              sizeof(geometry::Triangle), static_cast<int>(o.points.size()),
              const_cast<double*>(&o.points.front().x), sizeof(geometry::Vec3d)),
        shape_(&mesh_) {
    // Without one a pair counts where its surfaces meet, not where they are near.
    shape_.setMargin(0);
    shape_.updateBound();
    object_.setCollisionShape(&shape_);
    object_.setUserIndex(number);
  }
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;
  Body(Body&&) = delete;
  Body& operator=(Body&&) = delete;
  ~Body() = default;

  [[nodiscard]] btCollisionObject* object() { return &object_; }

 private:
  btTriangleIndexVertexArray mesh_;
  btGImpactMeshShape shape_;
  btCollisionObject object_;
};

/// The pairs whose triangles Bullet let touch.
std::vector<IndexPair> pairs_in(const btDispatcher& dispatcher) {
  std::vector<IndexPair> pairs;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold* const contacts =
        const_cast<btDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
    if (contacts->getNumContacts() == 0) continue;
    const auto a = static_cast<std::uint32_t>(contacts->getBody0()->getUserIndex());
    const auto b = static_cast<std::uint32_t>(contacts->getBody1()->getUserIndex());
    pairs.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

PeerAnswer bullet_overlaps(std::span<const PeerObject> objects) {
  PeerAnswer answer;
  Lap lap;
  CpuLap cpu;
  std::vector<std::unique_ptr<Body>> bodies;  // the world refers to them
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
  btDbvtBroadphase boxes;
  btCollisionWorld world(&dispatcher, &boxes, &configuration);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].triangles.empty()) continue;
    bodies.push_back(std::make_unique<Body>(objects[i], static_cast<int>(i)));
    world.addCollisionObject(bodies.back()->object());
  }
  answer.build_s = cpu();
  world.performDiscreteCollisionDetection();
  answer.pairs = pairs_in(dispatcher);
  answer.query_s = cpu();
  answer.wall_s = lap();
  answer.version = fmt::format("Bullet {}.{:02}", btGetVersion() / 100, btGetVersion() % 100);
  return answer;
}

}  // namespace strake::bench
