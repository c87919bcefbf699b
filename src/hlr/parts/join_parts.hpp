// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// How many lines the objects of a part have, by object of the part.
struct PartCounts {
  std::vector<std::uint32_t> pieces, curved_edges, curves;
};

/// Counts the lines of a drawing of so many objects.
[[nodiscard]] PartCounts count_lines(const Drawing& drawing, std::size_t objects);

/// Puts the drawings of the parts of a view together: each object has its lines in one of them.
class PartJoin {
 public:
  explicit PartJoin(std::size_t objects) : first_(objects) {}

  /// Tells the lines of a part whose objects have these numbers in the whole; false where the
  /// counts are not those of so many objects.
  [[nodiscard]] bool expect(const PartCounts& counts, std::span<const std::uint32_t> objects);
  /// Makes room for what all parts have, before the first is added;
  /// `options` as those of all parts. Errors: memory.
  [[nodiscard]] Status make_room(const Options& options, const parallel::Context& context);
  /// Adds a part; false where it is not the one that was expected.
  [[nodiscard]] bool add(const Drawing& part, const PartCounts& counts,
                         std::span<const std::uint32_t> objects, const std::vector<bool>& to_solve);
  /// Returns the lines, counts and the account of the whole; `scene` is all of it, though it has no
  /// meshes, and `drawn` says for each of its objects whether it is drawn. Errors: cancelled.
  [[nodiscard]] Result<Drawing> finish(const model::Scene& scene, const std::vector<bool>& drawn,
                                       const parallel::Context& context) &&;

 private:
  /// Where the lines of an object begin.
  struct First {
    std::uint64_t piece = 0, edge = 0, curve = 0;
  };

  void add_counters(const Counters& counters);

  std::vector<First> first_;  ///< counts until there is room
  std::vector<bool> added_ = std::vector<bool>(first_.size());
  Drawing drawing_;
};

}  // namespace strake::hlr
