// SPDX-License-Identifier: Apache-2.0
#include "cli/output/diagnostics_json.hpp"

namespace strake::cli {

void add_diagnostics(nlohmann::ordered_json& counts, nlohmann::ordered_json& messages,
                     const Diagnostics& diagnostics) {
  for (const Diagnostics::Count& count : diagnostics.counts())
    counts.push_back({{"code", count.code},
                      {"severity", severity_name(count.severity)},
                      {"count", count.count}});
  for (const Diagnostic& d : diagnostics.kept())
    messages.push_back({{"code", d.code},
                        {"severity", severity_name(d.severity)},
                        {"where", d.where},
                        {"message", d.message}});
}

}  // namespace strake::cli
