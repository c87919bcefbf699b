// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "sheets/spec/sheet_spec.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/model/single_lines.hpp"
#include "strake/parallel/context.hpp"

namespace strake::sheets {

/// What views see: the scene, or one in which its pipes are single lines.
class PipeScenes {
 public:
  explicit PipeScenes(const model::Scene& scene) : scene_(scene) {}

  /// Returns the scene of a view, which holds until the next is requested. Views of one diameter
  /// that follow each other share it. Errors: cancelled.
  [[nodiscard]] Result<const model::Scene*> of(const ViewSpec& view,
                                               const parallel::Context& context) {
    if (!view.single_line) return &scene_;
    const double diameter_mm = view.single_line->largest_diameter_mm;
    if (lines_ && diameter_mm_ == diameter_mm) return &lines_->scene;
    auto lines = model::pipes_as_lines(scene_, *view.single_line, context);
    if (!lines) return lines.error();
    lines_ = std::move(*lines);
    diameter_mm_ = diameter_mm;
    return &lines_->scene;
  }

 private:
  const model::Scene& scene_;
  std::optional<model::SingleLines> lines_;
  double diameter_mm_ = 0;
};

}  // namespace strake::sheets
