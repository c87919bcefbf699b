// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// Whether eye, target, near plane and field of view make sense together. Errors: usage.
[[nodiscard]] Status check_perspective(const View& view);

}  // namespace strake::hlr
