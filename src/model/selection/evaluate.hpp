// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/selection/query.hpp"
#include "strake/model/scene.hpp"

namespace strake::model::selection {

/// An object that several queries are asked about: what took work to find out is kept.
class Asked {
 public:
  Asked(const Scene& scene, ObjectId id) : scene_(scene), id_(id) {}

  /// Whether the query picks the object.
  [[nodiscard]] bool by(const Query& query);

 private:
  friend class Asker;
  /// The same, remembered: for sets, which many queries name.
  [[nodiscard]] bool by_set(const Query& query);
  /// The path of its groups and its own name. `slashed` has a '/' of the level's besides the one
  /// that a name begins with, where there are such; empty else.
  struct Path {
    std::string joined, slashed;
  };
  [[nodiscard]] const Path& whole_path();

  const Scene& scene_;
  ObjectId id_;
  std::optional<Path> path_;
  std::vector<std::pair<const Query*, bool>> known_;
};

}  // namespace strake::model::selection
