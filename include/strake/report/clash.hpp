// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "strake/clash/clash.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/function_ref.hpp"

/// Clash reports as text: JSON for programs, CSV for spreadsheets, a table for a terminal.
///
///     AtomicFile file = ...;
///     report::write_clash_json({{*report}}, model, [&](std::string_view s) { file.write(s); });
///
/// Bytes depend on the findings and the model alone: not on the locale, the team or the run.
namespace strake::report {

/// Takes text piece by piece; pieces end anywhere.
using Sink = parallel::FunctionRef<void(std::string_view)>;

/// The document of schemas/clash.schema.json, one result a line, streamed: memory does not grow
/// with the number of results. Lengths are rounded to a nanometre, brackets outward. Bytes of a
/// name that are not UTF-8 become U+FFFD.
void write_clash_json(const clash::Findings& findings, const model::Model& model, Sink sink);

/// One header line and one line per pair, comma-separated (RFC 4180), lines ended by CRLF.
void write_clash_csv(const clash::Findings& findings, const model::Model& model, Sink sink);

struct TableOptions {
  std::size_t width = 100;  ///< columns of the terminal; names are clipped to fit
  std::size_t rows = 20;    ///< pairs shown at most of each test
};

/// Test by test, the worst pairs first: by class, then d, then durable order. Every class has its
/// share of the rows, and is followed by how many more of it there are.
[[nodiscard]] std::string clash_table(const clash::Findings& findings, const model::Model& model,
                                      const TableOptions& options);

}  // namespace strake::report
