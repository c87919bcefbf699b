// SPDX-License-Identifier: Apache-2.0
// Strokes as the path operators of PDF.
#pragma once

#include <string>

#include "drawing/strokes/strokes.hpp"

namespace strake::drawing {

/// The farthest that a curve of a path may be from the ellipse that it stands for, mm of paper,
/// before its points are rounded to micrometres.
inline constexpr double kPdfCurveErrorMm = 0.001;

/// Appends the operators of a path of straight lines: "0 0 m 1 0 l 1 1 l h ".
void append_pdf_chain(std::string& out, const Chain& chain);

/// Appends cubic curves for an arc of an ellipse, from the current point: from a parameter on, by
/// `turn`, to an end point.
void append_pdf_arc(std::string& out, const PaperCurve& curve, double from, double turn,
                    const PaperPoint& end);

/// Appends a path with cubic curves for each arc of the stroke.
void append_pdf_stroke(std::string& out, const Stroke& stroke);

/// Appends a circle as a closed path.
void append_pdf_circle(std::string& out, const PaperPoint& center, double radius_mm);

}  // namespace strake::drawing
