// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/pairs/pair_result.hpp"
#include "strake/parallel/precomputed.hpp"

namespace strake::clash {

/// The acceleration structures of parts (frame, tree, support planes), made once for all pairs that
/// need them. The team makes them between stages; within a stage they are only read.
class AccelerationCache {
 public:
  /// `list` and `model` must outlive this.
  AccelerationCache(const ScenePartList& list, const model::Model& model)
      : list_(list), model_(model) {}

  /// Each function makes the structures that are wanted, by unique part, and not there yet. Errors:
  /// cancelled.
  [[nodiscard]] Status ensure_frames(const std::vector<bool>& wanted,
                                     const parallel::Context& context);
  [[nodiscard]] Status ensure_trees(const std::vector<bool>& wanted,
                                    const parallel::Context& context);
  [[nodiscard]] Status ensure_planes(const std::vector<bool>& wanted,
                                     const parallel::Context& context);

  /// Return the part with nothing, with its frame, with its tree too, and with its planes too. What
  /// was not made is null, or an empty tree.
  [[nodiscard]] PairOperand bare(const ScenePart& part) const;
  [[nodiscard]] PairOperand framed(const ScenePart& part) const;
  [[nodiscard]] PairOperand treed(const ScenePart& part) const;
  [[nodiscard]] PairOperand planed(const ScenePart& part) const;

 private:
  template <class T, class Make>
  Status add(parallel::Precomputed<T>& kind, const std::vector<bool>& wanted, std::string_view name,
             const parallel::Context& context, Make&& make);

  const ScenePartList& list_;
  const model::Model& model_;
  parallel::Precomputed<geometry::OrientedBox> frames_;  ///< by unique part, as the others are
  parallel::Precomputed<geometry::TriangleBvh> trees_;
  parallel::Precomputed<geometry::FaceKdop> planes_;
};

}  // namespace strake::clash
