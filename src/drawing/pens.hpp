// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::drawing {

/// A dashed line in widths of its pen (ISO 128-20).
inline constexpr double kDash = 12, kDashGap = 3;

}  // namespace strake::drawing
