// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// The fault of a view that cannot be drawn.
[[nodiscard]] Error view_error(std::string message, std::string mend);

/// Whether eye, target, near plane and field of view make sense together. Errors: usage.
[[nodiscard]] Status check_perspective(const View& view);

}  // namespace strake::hlr
