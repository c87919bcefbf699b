// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  /// The names of its groups and its own, joined by '/'.
  [[nodiscard]] const std::string& whole_path();

  const Scene& scene_;
  ObjectId id_;
  std::string path_;
  bool has_path_ = false;
  std::vector<std::pair<const Query*, bool>> known_;
};

}  // namespace strake::model::selection
