// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/run/session.hpp"
#include "strake/clash/clash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}  // namespace CLI

/// The file of decisions about clashes: read before a run, and written back after it.
namespace strake::cli {

/// As written.
struct DecisionInput {
  std::string file, deeper;
  std::vector<std::string> match_files;
  bool write = false;
};

void add_decision_options(CLI::App& command, DecisionInput& options);

/// The parsed form of a DecisionInput.
struct DecisionRequest {
  report::DecisionFile file;
  bool exists = false;  ///< the file was there
  double deeper_mm = 0;
};

/// Reads the file; nothing where none is given. Errors: as of read_decisions(), and for a file that
/// is not there unless it is to be written.
[[nodiscard]] Result<std::optional<DecisionRequest>> decision_request(const DecisionInput& input);

/// Finds the decisions about findings, and prints which files are taken as renamed. With
/// `counts_contacts`, contacts that have no row are taken out of the findings and only counted. The
/// request must outlive the result.
[[nodiscard]] Result<std::optional<report::DecidedResults>> decide(
    Session& session, const DecisionInput& input, const std::optional<DecisionRequest>& request,
    clash::Findings& findings, const model::Model& model, bool counts_contacts);

/// Writes the file of contents.decided back with the results that it lacks, if that is requested.
/// Errors: output, where somebody changed the file since it was read.
[[nodiscard]] Status write_decisions(Session& session, const DecisionInput& input,
                                     const DecisionRequest& request,
                                     const report::ClashContents& contents);

}  // namespace strake::cli
