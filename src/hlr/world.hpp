// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hlr/coverage.hpp"
#include "hlr/frame.hpp"
#include "hlr/job.hpp"
#include "hlr/occlusion.hpp"
#include "hlr/placed.hpp"
#include "hlr/shape_view.hpp"
#include "hlr/view_tree.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/precomputed.hpp"

namespace strake::hlr {

/// A run of edges of one body, or of the lines that are drawn with its object: the item of work.
struct Item {
  std::uint32_t body = 0, first = 0, last = 0;
  std::uint32_t number = 0;  ///< of its first edge within the object
  bool lines = false;
};

/// Bodies up to which those of an object are looked through for each of its edges: more are found
/// faster by the tree.
inline constexpr std::uint32_t kFewBodies = 16;

/// What a shape's own faces hide of its edges: the same for all bodies that place it whole.
struct OwnHits {
  std::vector<std::uint32_t> first;  ///< per edge, and the end
  std::vector<Hit> hits;

  [[nodiscard]] std::span<const Hit> of(std::uint32_t edge) const {
    return std::span(hits).subspan(first[edge], first[edge + 1] - first[edge]);
  }
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
  std::optional<Picture> picture;  ///< in perspective
  parallel::Precomputed<ShapeView>
      views;                      ///< by seen shape or, in perspective, body; of what is drawn
  std::vector<OwnHits> own_hits;  ///< per seen shape; empty where no two bodies share it
  std::vector<Placed> placed;     ///< per body
  /// Over the bodies that may hide. Of equal ones at one place a few are enough, of objects of up
  /// to kFewBodies: what one hides the others hide.
  ViewTree tree;
  Coverage coverage;  ///< by them; of nothing where there is no culling
  std::vector<Item> items;

  /// The number of a body's view.
  [[nodiscard]] std::uint32_t view_of(std::uint32_t body) const {
    return picture ? body : job.seen.of[body];
  }
};

/// Sees the shapes, places the bodies and cuts the edges into work. The job must outlive the
/// result. Errors: cancelled.
[[nodiscard]] Result<World> make_world(const Job& job, const parallel::Context& context);

/// The edges of one body of each shape whose bodies share what it hides of itself.
[[nodiscard]] std::vector<Item> own_items(const World& world);

}  // namespace strake::hlr
