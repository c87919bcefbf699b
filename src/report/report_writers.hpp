// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "core/output_format.hpp"
#include "strake/core/result.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/clash_diff.hpp"
#include "strake/report/view_diff.hpp"

namespace strake::report {

/// One format that clash results are written in.
struct ClashWriter {
  OutputFormat format;
  /// Errors: cancelled.
  Status (*write)(const ClashContents& contents, Sink sink, const parallel::Context& context);
};

/// One format that comparisons of clash results are written in.
struct ClashDiffWriter {
  OutputFormat format;
  void (*write)(const ClashDiff& diff, Sink sink);
};

/// One format that comparisons of drawings are written in.
struct ViewDiffWriter {
  OutputFormat format;
  void (*write)(const ViewDiff& diff, Sink sink);
};

/// All of them, in the order of help and errors.
[[nodiscard]] std::span<const ClashWriter> clash_writers();
/// All of them, in the order of help and errors.
[[nodiscard]] std::span<const ClashDiffWriter> clash_diff_writers();
/// All of them, in the order of help and errors.
[[nodiscard]] std::span<const ViewDiffWriter> view_diff_writers();

/// The one that a file's name asks for. Errors: usage, for a suffix that none has.
[[nodiscard]] Result<ClashWriter> find_clash_writer(const std::string& file);
/// The one that a file's name asks for. Errors: usage, for a suffix that none has.
[[nodiscard]] Result<ClashDiffWriter> find_clash_diff_writer(const std::string& file);
/// The one that a file's name asks for. Errors: usage, for a suffix that none has.
[[nodiscard]] Result<ViewDiffWriter> find_view_diff_writer(const std::string& file);

}  // namespace strake::report
