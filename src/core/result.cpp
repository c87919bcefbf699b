// SPDX-License-Identifier: Apache-2.0
#include "strake/core/result.hpp"

#include <new>

namespace strake {

Error out_of_memory() noexcept {
  Error error{ErrorCode::memory, "out of memory", {}, {}};  // short enough to need none
  try {
    error.mend = "use a machine with more memory, or a part of the model";
  } catch (const std::bad_alloc&) {
  }
  return error;
}

std::string Error::text() const {
  std::string line = where.empty() ? message : where + ": " + message;
  if (!mend.empty()) line += " (" + mend + ")";
  return line;
}

}  // namespace strake
