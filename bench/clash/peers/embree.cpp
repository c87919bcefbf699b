// SPDX-License-Identifier: Apache-2.0
#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <type_traits>

#include "clocks.hpp"
#include "peers/peer.hpp"
#include "peers/triangles_meet.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/team.hpp"

namespace strake::bench {
namespace {

using geometry::Box3d;
using geometry::IndexPair;
using geometry::Vec3d;

/// Objects of up to this many triangles have no tree: building one costs more than it saves.
constexpr std::size_t kSmall = 1000;

struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;
struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
using DeviceHandle = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;

WorldTriangle triangle_of(const PeerObject& o, std::size_t t) {
  const auto& [a, b, c] = o.triangles[t];
  return {o.points[a], o.points[b], o.points[c]};
}

Box3d box_of(const WorldTriangle& t) {
  Box3d box = geometry::empty_box<double>();
  for (const Vec3d& p : t) box.include(p);
  return box;
}

/// Single precision, rounded outward.
void store(const Box3d& box, RTCBounds& bounds) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const auto down = [](double v) { return std::nextafter(static_cast<float>(v), -kFar); };
  const auto up = [](double v) { return std::nextafter(static_cast<float>(v), kFar); };
  bounds = {down(box.lo.x), down(box.lo.y), down(box.lo.z), 0,
            up(box.hi.x),   up(box.hi.y),   up(box.hi.z),   0};
}

SceneHandle tree_over(RTCDevice device, std::size_t count, const void* of,
                      RTCBoundsFunction bounds) {
  SceneHandle scene(rtcNewScene(device));
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(count));
  rtcSetGeometryUserData(geometry, const_cast<void*>(of));
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  return scene;
}

SceneHandle tree_of_objects(RTCDevice device, std::span<const PeerObject> objects) {
  return tree_over(device, objects.size(), objects.data(), [](const RTCBoundsFunctionArguments* a) {
    store(static_cast<const PeerObject*>(a->geometryUserPtr)[a->primID].box, *a->bounds_o);
  });
}

SceneHandle tree_of_triangles(RTCDevice device, const PeerObject& object) {
  return tree_over(device, object.triangles.size(), &object,
                   [](const RTCBoundsFunctionArguments* a) {
                     const auto& o = *static_cast<const PeerObject*>(a->geometryUserPtr);
                     store(box_of(triangle_of(o, a->primID)), *a->bounds_o);
                   });
}

struct Candidates {
  std::mutex guard;
  std::vector<IndexPair> pairs;

  static void take(void* self, RTCCollision* found, unsigned count) {
    auto& all = *static_cast<Candidates*>(self);
    const std::scoped_lock lock(all.guard);
    for (unsigned i = 0; i < count; ++i)
      if (found[i].primID0 < found[i].primID1)
        all.pairs.push_back({found[i].primID0, found[i].primID1});
  }
};

struct TrianglePairs {
  const PeerObject &a, &b;
  std::atomic<bool> meet = false;

  static void take(void* self, RTCCollision* found, unsigned count) {
    auto& pairs = *static_cast<TrianglePairs*>(self);
    for (unsigned i = 0; i < count && !pairs.meet; ++i)
      if (triangles_meet(triangle_of(pairs.a, found[i].primID0),
                         triangle_of(pairs.b, found[i].primID1)))
        pairs.meet = true;
  }
};

/// The triangles of an object that reach into a box.
std::vector<WorldTriangle> within(const PeerObject& o, const Box3d& box) {
  std::vector<WorldTriangle> all;
  for (std::size_t t = 0; t < o.triangles.size(); ++t) {
    const WorldTriangle w = triangle_of(o, t);
    if (box_of(w).meets(box)) all.push_back(w);
  }
  return all;
}

bool small_ones_meet(const PeerObject& a, const PeerObject& b) {
  const Box3d common = a.box.common(b.box);
  const auto in_a = within(a, common), in_b = within(b, common);
  for (const WorldTriangle& t : in_a)
    for (const WorldTriangle& u : in_b)
      if (triangles_meet(t, u)) return true;
  return false;
}

}  // namespace

PeerAnswer embree_overlaps(std::span<const PeerObject> objects, const parallel::Context& context) {
  PeerAnswer answer;
  Lap lap;
  CpuLap cpu;
  const unsigned threads = context.team != nullptr ? context.team->size() : 1;
  const DeviceHandle device(rtcNewDevice(("threads=" + std::to_string(threads)).c_str()));
  const SceneHandle boxes = tree_of_objects(device.get(), objects);
  std::vector<SceneHandle> own(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (objects[i].triangles.size() > kSmall) own[i] = tree_of_triangles(device.get(), objects[i]);
  answer.build_s = cpu();
  Candidates candidates;
  rtcCollide(boxes.get(), boxes.get(), Candidates::take, &candidates);
  std::sort(candidates.pairs.begin(), candidates.pairs.end());
  // A small partner of a large object gets its tree when it is needed.
  for (const IndexPair& p : candidates.pairs)
    for (const auto& [large, small] : {p, IndexPair{p.second, p.first}})
      if (own[large] && !own[small]) own[small] = tree_of_triangles(device.get(), objects[small]);
  answer.pairs =
      parallel::collect<IndexPair>(
          context, {.name = "pairs", .n = candidates.pairs.size(), .grain = 64},
          [&](std::size_t i, std::vector<IndexPair>& out) {
            const IndexPair p = candidates.pairs[i];
            const PeerObject &a = objects[p.first], &b = objects[p.second];
            bool meet = false;
            if (own[p.first] && own[p.second] &&
                a.triangles.size() + b.triangles.size() > 2 * kSmall) {
              TrianglePairs pairs{a, b};
              rtcCollide(own[p.first].get(), own[p.second].get(), TrianglePairs::take, &pairs);
              meet = pairs.meet;
            } else {
              meet = small_ones_meet(a, b);
            }
            if (meet) out.push_back(p);
          })
          .value();
  answer.query_s = cpu();
  answer.wall_s = lap();
  answer.version = "Embree " RTC_VERSION_STRING;
  return answer;
}

}  // namespace strake::bench
