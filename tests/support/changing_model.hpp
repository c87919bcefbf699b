// SPDX-License-Identifier: Apache-2.0
// A model that is edited at random, step by step, with the identities of its objects.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/model.hpp"
#include "support/draw.hpp"
#include "support/meshes.hpp"

namespace strake::test {

/// One body of an object: a shape, moved.
struct ChangingBody {
  model::Shape shape;
  geometry::Placement placement;
  std::uint8_t alpha = 255;
  std::uint8_t red = 170;
  float precision_um = 0;
};

struct ChangingObject {
  std::uint64_t identity = 0;
  std::string name;
  std::vector<ChangingBody> bodies;
  bool drawn = true;
  bool incomplete = false;
};

/// Objects along a corridor on a lattice of millimetres, many of which touch, cross or repeat each
/// other; most are small, and some as long as the corridor.
class ChangingModel {
 public:
  static constexpr std::int32_t kLength = 160, kHeight = 8;

  ChangingModel(std::uint64_t seed, std::size_t objects) : draw_(seed) {
    while (objects_.size() < objects) insert(objects_.size());
  }

  [[nodiscard]] std::vector<ChangingObject>& objects() { return objects_; }
  [[nodiscard]] const std::vector<ChangingObject>& objects() const { return objects_; }

  /// Changes some objects, often one, now and then none.
  void edit() {
    const std::uint64_t edits = draw_.one_in(8) ? 0 : draw_.one_in(4) ? 1 + draw_.below(4) : 1;
    for (std::uint64_t i = 0; i < edits; ++i) edit_one();
  }

  [[nodiscard]] model::Model build() const {
    model::Model model;
    model.files.push_back({.label = "changing", .format = "hand", .unit = "mm", .up_axis = "z"});
    for (const ChangingObject& one : objects_) {
      model::Object object;
      object.id = std::to_string(one.identity);
      object.name = one.name;
      object.incomplete = one.incomplete;
      object.first_body = static_cast<std::uint32_t>(model.bodies.size());
      object.body_count = static_cast<std::uint32_t>(one.bodies.size());
      model.objects.push_back(std::move(object));
      for (const ChangingBody& body : one.bodies) {
        model::Body placed;
        placed.shape = model::ShapeId{static_cast<std::uint32_t>(model.shapes.size())};
        placed.placement = body.placement;
        placed.color.alpha = body.alpha;
        placed.color.red = body.red;
        placed.precision_um = body.precision_um;
        model.shapes.push_back(body.shape);
        model.bodies.push_back(placed);
      }
    }
    return model;
  }

  [[nodiscard]] std::vector<bool> drawn() const {
    std::vector<bool> drawn;
    for (const ChangingObject& one : objects_) drawn.push_back(one.drawn);
    return drawn;
  }

 private:
  void edit_one() {
    if (objects_.empty()) return insert(0);
    const std::size_t at = draw_.below(objects_.size());
    ChangingObject& one = objects_[at];
    switch (draw_.below(11)) {
      case 0:
        return insert(draw_.below(objects_.size() + 1));
      case 1:
        objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(at));
        return;
      case 2:
        one.bodies = bodies();
        return;
      case 3:
        one.drawn = !one.drawn;
        return;
      case 4:
        if (!one.bodies.empty()) one.bodies.front().alpha ^= 128U;
        return;
      case 5:
        std::swap(one, objects_[draw_.below(objects_.size())]);
        return;
      case 10:
        if (!one.bodies.empty()) one.bodies.front().red ^= 64U;
        return;
      case 6:
        one.name += "'";
        one.incomplete = draw_.one_in(2);
        return;
      default:
        for (ChangingBody& body : one.bodies)
          body.placement.translation = body.placement.translation + step();
    }
  }

  void insert(std::size_t at) {
    ChangingObject one{.identity = ++last_, .name = {}, .bodies = {}};
    one.name = "object " + std::to_string(last_);
    if (!draw_.one_in(30)) one.bodies = bodies();
    if (!objects_.empty() && draw_.one_in(4)) {
      one.bodies = objects_[draw_.below(objects_.size())].bodies;
      for (ChangingBody& body : one.bodies)
        body.placement.translation = body.placement.translation + step();
    }
    one.drawn = !draw_.one_in(10);
    one.incomplete = draw_.one_in(20);
    objects_.insert(objects_.begin() + static_cast<std::ptrdiff_t>(at), std::move(one));
  }

  geometry::Vec3d step() {
    return {draw_.one_in(3) ? 1.0 * draw_.whole(-20, 20) : 1.0 * draw_.whole(-2, 3),
            1.0 * draw_.whole(-1, 2), 1.0 * draw_.whole(-1, 2)};
  }

  std::vector<ChangingBody> bodies() {
    std::vector<ChangingBody> all;
    const geometry::Vec3d at{1.0 * draw_.whole(0, kLength), 1.0 * draw_.whole(0, kHeight),
                             1.0 * draw_.whole(0, kHeight)};
    for (std::uint64_t count = 1 + (draw_.one_in(3) ? draw_.below(3) : 0); count > 0; --count) {
      ChangingBody body{.shape = shape(), .placement = {}};
      body.placement.translation =
          at + geometry::Vec3d{1.0 * draw_.whole(0, 3), 1.0 * draw_.whole(0, 2), 0};
      if (draw_.one_in(12)) body.placement.linear = draw_.rotation();
      body.alpha = draw_.one_in(8) ? 100 : 255;
      all.push_back(std::move(body));
    }
    return all;
  }

  model::Shape shape() {
    const auto size = [&] { return 1.0 * draw_.whole(1, 5); };
    switch (draw_.below(9)) {
      case 0:
        return geometry::Primitive(geometry::CylinderPrimitive{size(), 2 * size()});
      case 1:
        return geometry::Primitive(geometry::SpherePrimitive{2 * size()});
      case 2:
        return geometry::Primitive(geometry::CircularTorusPrimitive{4 + size(), size(), 1.5});
      case 3:
        return geometry::Primitive(geometry::BoxPrimitive{size(), size(), size()});
      case 4:
        return geometry::Polylines{.points = {{0, 0, 0}, {size(), 0, size()}, {size(), size(), 0}},
                                   .first = {0, 3}};
      case 5:  // a deck, which others pass through far from its edges, or a beam along it
        if (draw_.one_in(2)) {
          const double beside = draw_.one_in(2) ? 8 : 0;
          return box_mesh({-1.0 * draw_.whole(10, kLength), -beside, 0},
                          {1.0 * draw_.whole(10, kLength), beside + size(), 0.5 * size()});
        }
        [[fallthrough]];
      default:
        return box_mesh({0, 0, 0}, {size(), size(), size()});
    }
  }

  Draw draw_;
  std::uint64_t last_ = 0;
  std::vector<ChangingObject> objects_;
};

}  // namespace strake::test
