// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "io/rvm/big_endian.hpp"
#include "io/rvm/diagnostic_log.hpp"

namespace strake::io::rvm {

/// Whether the file begins as the text variant does: a HEAD line, then a line of two integers.
[[nodiscard]] bool is_text_variant(std::string_view text);

/// The text variant as the same chunks in binary, and the line that each began on.
struct Transcoded {
  std::vector<std::byte> bytes;
  std::vector<LineMark> marks;
};

/// Rewrites a text file (.rev) as binary chunks, so that one reader handles both.
///
/// Lines that are no chunk where one must begin are skipped and counted; a chunk whose numbers
/// are not numbers is left out with a diagnostic that names its line.
[[nodiscard]] Transcoded transcode_text(std::string_view text, DiagnosticLog& log);

}  // namespace strake::io::rvm
