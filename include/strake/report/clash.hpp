// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "strake/clash/clash.hpp"
#include "strake/clash/group.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"

/// Writes clash reports as text: JSON for programs, CSV for spreadsheets, a table for a terminal.
///
///     AtomicFile file = ...;
///     const Status status = report::write_clash_json(
///         {findings, model}, [&](std::string_view s) { file.write(s); }, context);
///
/// Bytes depend on the findings and the model alone: not on the locale, the team or the run. The
/// team formats results while the calling thread hands them on; errors: cancelled, and then what
/// went to the sink is no document.
namespace strake::report {

/// Takes text piece by piece; pieces end anywhere.
using Sink = parallel::FunctionRef<void(std::string_view)>;

/// The rules file that findings were made with.
struct RulesSource {
  std::string file;          ///< its name, without folders
  Hash128 hash;              ///< the hash of its bytes
  std::string profile = {};  ///< the profile that it is, if it is one that the program brings along
};

/// What a report is written from.
struct ClashContents {
  const clash::Findings& findings;
  const model::Model& model;
  const clash::Grouping* grouping = nullptr;  ///< the grouping of these findings, if asked for
  const RulesSource* rules = nullptr;         ///< the rules, if there were any
  /// What reading and placing the model noticed (model::Model::diagnostics, then
  /// model::Scene::diagnostics). Without it the result does not say what is missing.
  const Diagnostics* loading = nullptr;
};

/// Writes the document of schemas/clash.schema.json, one result a line, streamed: memory does not
/// grow with the number of results. Lengths are rounded to a nanometre, brackets outward. Bytes of
/// a name that are not UTF-8 become U+FFFD.
[[nodiscard]] Status write_clash_json(const ClashContents& contents, Sink sink,
                                      const parallel::Context& context = {});

/// Writes one header line and one line per pair, comma-separated (RFC 4180), lines ended by CRLF.
[[nodiscard]] Status write_clash_csv(const ClashContents& contents, Sink sink,
                                     const parallel::Context& context = {});

/// Writes every pair of objects that went to the narrow phase as CSV of the same form: whether a
/// rule may allow it, its class (NO_HIT too) and what it cost. Only tests that were asked to log
/// pairs have such pairs.
[[nodiscard]] Status write_pair_log(const ClashContents& contents, Sink sink,
                                    const parallel::Context& context = {});

struct TableOptions {
  std::size_t width = 100;                    ///< columns of the terminal; names are clipped to fit
  std::size_t rows = 20;                      ///< pairs of each test, or groups, shown at most
  clash::SortBy sort = clash::SortBy::depth;  ///< the order of pairs; size is as depth
};

/// Returns the worst pairs of each test: by class, then as sorted, then in durable order. Every
/// class has its share of the rows, and is followed by how many more of it there are. With a
/// grouping the table has the groups in its order, and what each test counts.
[[nodiscard]] std::string clash_table(const ClashContents& contents, const TableOptions& options);

}  // namespace strake::report
