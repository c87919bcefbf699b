// SPDX-License-Identifier: Apache-2.0
#include "strake/core/severity.hpp"

namespace strake {

std::string_view severity_name(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::skipped:
      break;
  }
  return "skipped";
}

}  // namespace strake
