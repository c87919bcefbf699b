// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace strake::geometry {

/// Trigonometry from + - * / and sqrt alone, so that every compiler and C library gives the same
/// bits. Accurate to a few units in the last place.

inline constexpr double kPi = 0x1.921fb54442d18p+1;

struct SinCos {
  double sin = 0, cos = 1;
};

/// Returns sine and cosine of an angle in radians; NaN beyond ±10^6 or for what is not finite.
[[nodiscard]] SinCos sin_cos(double angle);

/// Returns the angle of (x, y) from the x axis, in (-pi, pi]; 0 for the origin.
[[nodiscard]] double arc_tan2(double y, double x);

/// Returns the arc cosine; NaN outside [-1, 1].
[[nodiscard]] double arc_cos(double x);
[[nodiscard]] double arc_sin(double x);

/// Returns cosine and sine of 2·pi·k/n for k in [0, n). For n a multiple of 4 the values are
/// exactly symmetric in both axes and in the diagonals' exchange of sine and cosine, and the
/// quadrant points are exact.
[[nodiscard]] std::vector<SinCos> unit_circle(int n);

/// Returns the smallest number of chords of a circle of the given radius, a multiple of 4, at least
/// 8 and at most `limit`, that keeps each chord within `sag` of its arc.
[[nodiscard]] int circle_segments(double radius, double sag, int limit = 4096);

/// Returns the smallest number of equal chords (at least 1, at most `limit`) of an arc that does
/// the same.
[[nodiscard]] int arc_segments(double radius, double angle, double sag, int limit = 4096);

/// Returns the height of an arc of the given angle over its chord.
[[nodiscard]] double sagitta(double radius, double angle);

/// Whether an angle, radians, is a full circle: float32 sources write 2·pi a little short or long.
[[nodiscard]] inline bool is_full_turn(double angle) { return angle >= 2 * kPi * (1 - 1e-6); }

}  // namespace strake::geometry
