// SPDX-License-Identifier: Apache-2.0
// Scenes made by hand from indexed triangles in grid units, without readers or make_scene.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "strake/geometry/part.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/model/model.hpp"
#include "strake/model/scene.hpp"

namespace strake::test {

/// The geometry of one part as a test writes it; vertices must be distinct.
struct HandPart {
  std::vector<geometry::Vec3i> vertices;
  std::vector<geometry::Triangle> triangles;
  std::vector<std::uint32_t> faces;                  ///< per triangle; empty: each its own
  std::vector<std::vector<geometry::Vec3i>> chains;  ///< a wire instead of triangles
};

/// A Part with edges, kind and box, as make_scene would build it from welded triangles.
[[nodiscard]] geometry::Part make_part(const HandPart& hand);

/// An axis-parallel box; quads share a source face.
[[nodiscard]] HandPart hand_box(const geometry::Vec3i& lo, const geometry::Vec3i& hi);

struct HandBody {
  std::vector<HandPart> parts;
  geometry::Vec3l origin;
  std::uint8_t alpha = 255;
};

/// A model and the scene over it. Objects are named "0", "1", … in the order of adding.
class SceneBuilder {
 public:
  SceneBuilder();
  /// A body with a shape of its own.
  SceneBuilder& object(std::initializer_list<HandBody> bodies);
  SceneBuilder& object(const std::vector<HandBody>& bodies);
  /// One more object that places the shapes of an earlier one, moved by `offset`.
  SceneBuilder& instance(std::uint32_t of_object, const geometry::Vec3l& offset);

  /// Says of which primitive the first part of a shape is the tessellation.
  SceneBuilder& primitive(std::uint32_t shape, const geometry::Primitive& value);

  [[nodiscard]] const model::Scene& scene() const { return *scene_; }
  [[nodiscard]] model::Model& model() { return *model_; }

 private:
  void begin_object();
  void add_body(std::uint32_t shape, const geometry::Vec3l& origin, std::uint8_t alpha);

  std::unique_ptr<model::Model> model_;
  std::unique_ptr<model::Scene> scene_;
};

}  // namespace strake::test
