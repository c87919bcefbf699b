// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/run/load.hpp"
#include "cli/run/session.hpp"
#include "strake/clash/clash.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/model/selection.hpp"

namespace strake::cli {

/// Which objects are compared with which, as written.
struct SetInput {
  std::vector<std::string> a, b;
  bool self = false;
};

void add_set_options(CLI::App& command, SetInput& options);

/// The parsed form of a SetInput.
struct SetRequest {
  std::vector<model::Selection> a, b;
  bool self = false;
};

[[nodiscard]] Result<SetRequest> set_request(const SetInput& input);

struct ChosenSets {
  clash::Sets sets;
  Diagnostics diagnostics;  ///< "selection-picks-nothing"
};

/// Compares what --a picks with what --b picks, or with everything where one of them is not given.
/// Without either: one file with itself, several with each other, or with --self all with all.
[[nodiscard]] Result<ChosenSets> choose_sets(Session& session, const LoadedModel& loaded,
                                             const SetRequest& request);

}  // namespace strake::cli
