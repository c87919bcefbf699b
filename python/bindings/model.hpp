// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::python {

/// A model with the scenes that were made of it last. Results refer to it and keep it alive.
class LoadedModel {
 public:
  explicit LoadedModel(model::Model model) : model_(std::move(model)) {}

  [[nodiscard]] const model::Model& model() const { return model_; }
  /// Returns the scene with these options: one of the last two, or a new one. Threads may ask at
  /// the same time.
  [[nodiscard]] Result<std::shared_ptr<const model::Scene>> scene(
      const model::SceneOptions& options, const parallel::Context& context);

 private:
  struct Kept {
    model::SceneOptions options;
    std::shared_ptr<const model::Scene> scene;
  };

  const model::Model model_;
  std::mutex mutex_;
  std::vector<Kept> kept_;  ///< the last one first
};

using ModelPointer = std::shared_ptr<LoadedModel>;

}  // namespace strake::python
