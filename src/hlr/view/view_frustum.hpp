// SPDX-License-Identifier: Apache-2.0
// Checks of a view in perspective; view_frustum.cpp also defines window() of hlr.hpp.
#pragma once

#include <string>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// Returns the error of a view that cannot be drawn.
[[nodiscard]] Error view_error(std::string message, std::string mend);

/// Checks that eye, target, near plane and field of view make sense together. Errors: usage.
[[nodiscard]] Status check_perspective(const View& view);

}  // namespace strake::hlr
