// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "hlr/frame.hpp"
#include "hlr/job.hpp"
#include "hlr/shape_view.hpp"
#include "hlr/view_tree.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A body as the gathering sees it.
struct Placed {
  const ShapeView* view = nullptr;  ///< null: not drawn
  geometry::Vec3l offset;
  ViewPoint at;
  std::uint32_t object = 0;
  std::int64_t contact = 0;
  std::int64_t within = 0;  ///< the same among what is one part
  bool opaque = false;      ///< and, where there are limits, not wholly outside them
  bool cut = false;         ///< by the limits
};

/// A run of edges of one body, or of the lines that are drawn with its object: the item of work.
struct Item {
  std::uint32_t body = 0, first = 0, last = 0;
  std::uint32_t number = 0;  ///< of its first edge within the object
  bool lines = false;
};

/// What the gathering works on.
struct World {
  explicit World(const Job& asked) : job(asked), frame(asked.direction()) {}
  World(const World&) = delete;  // `placed` points into `views`
  World& operator=(const World&) = delete;
  World(World&&) = default;
  World& operator=(World&&) = delete;
  ~World() = default;

  const Job& job;
  Frame frame;
  std::vector<ShapeView> views;  ///< per seen shape; empty where not drawn
  std::vector<Placed> placed;    ///< per body
  ViewTree tree;                 ///< over the bodies that may hide
  std::vector<Item> items;
};

/// Sees the shapes, places the bodies and cuts the edges into work. The job must outlive the
/// result. Errors: cancelled.
[[nodiscard]] Result<World> make_world(const Job& job, const parallel::Context& context);

}  // namespace strake::hlr
