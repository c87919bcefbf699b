// SPDX-License-Identifier: Apache-2.0
// Patterns of dashes, fitted to the lengths of the lines that have them.
#pragma once

// Decision 0080 says why patterns are stretched, and why by one factor.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace strake::drawing {

/// A pattern may be pressed together to this share of its lengths, so that a short line has a gap.
inline constexpr double kMinStretch = 0.4;

/// How a stroke ends, as far as its dashes bear on it.
enum class DashEnds : std::uint8_t {
  open,
  centred,  ///< open, with a first dash in its middle, where an axis crosses another
  closed,
};

/// The dashes of centre lines in widths of their pen, ISO 128-2 type 04; a dot is as long as it is
/// wide, or else it is not seen in print.
inline constexpr std::array<double, 4> kCentreDashes{24, 3, 1, 3};

/// Returns the dashes of a pen, mm, by their lengths in widths of the pen: rounded to hundredths of
/// a millimetre, which are as fine as any pen, and no shorter than one.
[[nodiscard]] std::vector<double> pen_dashes(std::span<const double> widths, double pen_mm);

/// Returns by what factor a pattern (lengths of ink and gap by turns, mm) is stretched for one
/// stroke, so that the stroke begins and ends with the whole first dash, or, where it is closed,
/// has a whole number of periods. 0: the stroke is continuous, as it is too short for a gap, or the
/// pattern has none.
///
/// Factors are multiples of a power of two, coarse for short strokes, so that most strokes of a
/// drawing share few patterns; the last dash is longer or shorter by a tenth at most for that.
[[nodiscard]] double fitted_stretch(double length_mm, DashEnds ends,
                                    std::span<const double> dash_mm);

/// Returns the length of the shortest open stroke that gets a gap, mm.
[[nodiscard]] double shortest_dashed(std::span<const double> dash_mm);

}  // namespace strake::drawing
