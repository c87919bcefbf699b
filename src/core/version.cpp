// SPDX-License-Identifier: Apache-2.0
#include "strake/core/version.hpp"

namespace strake {

std::string_view version() { return STRAKE_VERSION; }

}  // namespace strake
