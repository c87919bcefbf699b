// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/clash/clash.hpp"

namespace strake::clash {

/// Returns the sets that are compared where nobody names any: of one file everything with itself,
/// of two files one with the other, of more each with the others. The sets are named as a selection
/// would pick them.
[[nodiscard]] Sets sets_by_file(const model::Model& model);

}  // namespace strake::clash
