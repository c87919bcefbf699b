// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "core/output_format.hpp"
#include "strake/core/result.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/clash_diff.hpp"
#include "strake/report/view_diff.hpp"

namespace strake::report {

/// One format that clash results are written in.
struct ClashWriter {
  OutputFormat format;
  /// Errors: cancelled, out of memory; usage where it needs what the contents lack.
  Status (*write)(const ClashContents& contents, Sink sink, const parallel::Context& context);
  bool attributes = false;  ///< whether it has what ClashContents::columns names
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

/// Returns the writers of all formats, in the order of help and errors.
[[nodiscard]] std::span<const ClashWriter> clash_writers();
/// Returns the writers of all formats, in the order of help and errors.
[[nodiscard]] std::span<const ClashDiffWriter> clash_diff_writers();
/// Returns the writers of all formats, in the order of help and errors.
[[nodiscard]] std::span<const ViewDiffWriter> view_diff_writers();

}  // namespace strake::report
