// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/selection/query.hpp"
#include "strake/model/scene.hpp"

namespace strake::model::selection {

/// Whether the object answers the query.
[[nodiscard]] bool answers(const Query& query, const Scene& scene, ObjectId object);

}  // namespace strake::model::selection
