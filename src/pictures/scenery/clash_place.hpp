// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "pictures/viewpoint.hpp"
#include "report/clash/contents.hpp"
#include "strake/core/result.hpp"

namespace strake::pictures {

/// What an object is in a picture.
enum class Role : std::uint8_t { other, a, b };

/// What the objects of a subject are: of a group about one element that element is `a`, all that it
/// meets `b`; otherwise a and b are those of the first result that names an object.
class Roles {
 public:
  /// The subject must have results of the contents.
  Roles(const report::ClashContents& contents, const Subject& subject);

  [[nodiscard]] Role of(model::ObjectId id) const;
  /// The object of the subject's first result that is `a`, or `b`.
  [[nodiscard]] model::ObjectId first(Role role) const { return role == Role::a ? a_ : b_; }
  [[nodiscard]] const std::vector<std::pair<model::ObjectId, Role>>& all() const { return roles_; }

 private:
  model::ObjectId a_{}, b_{};
  std::vector<std::pair<model::ObjectId, Role>> roles_;  ///< by object
};

/// Checks that a subject is of the contents. Errors: usage.
[[nodiscard]] Status check_subject(const report::ClashContents& contents, const Subject& subject);

/// Returns the distance round a clash that shows what it is about, mm: some thicknesses of the
/// thinner of the two bodies there, no less than what shows a bolt and no more than a room.
[[nodiscard]] double reach_of(const Scenery& scenery, const Roles& roles, const clash::Pair& pair);

}  // namespace strake::pictures
