// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0043 says why the bracket counts what the grid and the source leave open.

#include <cstdint>
#include <span>
#include <vector>

#include "clash/broad_phase/broad_phase.hpp"

namespace strake::clash {

/// How far the snap moved bodies from what their sources state.
class SourceErrors {
 public:
  /// Measures the vertices of each shape once, for the first of some bodies that have it. The
  /// model must outlive the result. Errors: cancelled.
  [[nodiscard]] static Result<SourceErrors> measure(const model::Model& model,
                                                    std::span<const std::uint32_t> bodies,
                                                    const parallel::Context& context);

  /// Returns how far the place and the vertices of one of these bodies were moved, grid units.
  [[nodiscard]] float moved_by_snap(const model::Body& body) const;

 private:
  explicit SourceErrors(const model::Model& model) : model_(&model) {}

  const model::Model* model_;
  std::vector<std::uint32_t> first_;  ///< by shape of the model: the body that it is measured for
  std::vector<float> moved_;
};

/// Sets for every part how far it may lie from what its source states: what the snap moved its
/// place and the vertices of a mesh (those of a primitive count in its sag), and the step of its
/// numbers where that is coarse. The values are few, so that equal pairs stay equal. Errors:
/// cancelled.
[[nodiscard]] Status set_source_errors(const model::Scene& scene, const Options& options,
                                       ScenePartList& list, const parallel::Context& context);

}  // namespace strake::clash
