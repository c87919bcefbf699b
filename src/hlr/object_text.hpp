// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "strake/model/model.hpp"

namespace strake::hlr {

/// An object as diagnostics name it: its file and its name, or its id where it has none.
[[nodiscard]] std::string object_text(const model::Model& model, model::ObjectId id);

}  // namespace strake::hlr
