// SPDX-License-Identifier: Apache-2.0
#include "strake/core/result.hpp"

namespace strake {

std::string Error::text() const {
  std::string line = where.empty() ? message : where + ": " + message;
  if (!mend.empty()) line += " (" + mend + ")";
  return line;
}

}  // namespace strake
