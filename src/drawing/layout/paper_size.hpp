// SPDX-License-Identifier: Apache-2.0
// The sizes of paper that drawings and sheets have.
#pragma once

#include <array>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"

namespace strake::drawing {

/// A size of the A series (ISO 216), in landscape.
struct NamedPaper {
  std::string_view name;
  PaperSize size;
};
inline constexpr std::array<NamedPaper, 5> kNamedPapers{{{"A4", {297, 210}},
                                                         {"A3", {420, 297}},
                                                         {"A2", {594, 420}},
                                                         {"A1", {841, 594}},
                                                         {"A0", {1189, 841}}}};

/// What any sheet measures, along each side.
inline constexpr double kMinPaperMm = 100, kLargestPaperMm = 20000;

/// Parses "A3" (landscape), "A3 portrait", "A3,portrait" or width x height as "900x420" in
/// millimetres or "900mm x 42cm". Errors say what would have been right.
[[nodiscard]] Result<PaperSize> parse_paper(std::string_view text);

}  // namespace strake::drawing
