// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/object_styles.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// Widths of lines, millimetres of paper: a line group of ISO 128-2. What is seen of a part is of
/// one weight, its outlines and its edges alike (decision 0068).
struct Pens {
  double outline = 0.5;  ///< wide: visible contours
  double edge = 0.5;     ///< wide: visible edges, open edges and intersections
  double thin = 0.25;    ///< narrow: hidden lines, smooth edges, hatches, polylines
  double section = 0.7;  ///< outlines of cuts, a width above the wide one
};

struct InkOptions {
  bool hidden = false;  ///< draw hidden lines, dashed; otherwise leave them out
  /// Leave out the parts of a hidden line that run along a visible line, or along a hidden one of
  /// the same object, so close on paper that their ink touches: two dashed lines out of step look
  /// like a third, solid one. Equal objects get equal ink, whatever other objects hide.
  bool clean_up = true;
  /// Keep what an object hides itself and what others hide apart, as two layers with styles of
  /// their own.
  bool split_hidden = false;
  std::optional<Pens> pens = std::nullopt;  ///< none: chosen by the density of the drawing
  std::shared_ptr<const ObjectStyles> styles = nullptr;  ///< null: all objects look alike
};

/// A centre line on paper: straight from point to point.
struct CentreLine {
  model::ObjectId object{};  ///< whose axis it is; of several in line the first
  std::vector<PaperPoint> points;
  bool cross = false;  ///< an arm of a cross, which has a dash in its middle
};

/// A break line on paper: straight from point to point, with zigzags.
struct BreakLine {
  model::ObjectId object{};  ///< what it breaks; of several beside each other the first
  std::vector<PaperPoint> points;
};

/// What thin_lines() left out.
struct ThinnedLines {
  /// On paper, from the middle of a line to that of the next; of objects without a style.
  double spacing_mm = 0;
  std::uint64_t lines = 0, objects = 0;  ///< lines left out in part or wholly, and whose they are
};

/// The lines of a drawing that get ink on paper, and the pens.
struct Ink {
  Pens pens;
  std::vector<Line> lines;               ///< visible or hidden, in the order of the drawing
  std::uint64_t left_out = 0;            ///< hidden lines that were left out in part or wholly
  std::vector<CentreLine> centre_lines;  ///< those of find_centre_lines(), where they are wanted
  std::vector<BreakLine> break_lines;    ///< those of find_break_lines(), where they are wanted
  bool split_hidden = false;  ///< as InkOptions has it; the states of the lines tell which is which
  std::shared_ptr<const ObjectStyles> styles = nullptr;  ///< null: all objects look alike
  std::optional<ThinnedLines> thinned;                   ///< where thin_lines() was asked
  /// The lines in model space, of which true size thins none; empty: `lines`, as on paper.
  std::vector<Line> true_size_lines;

  [[nodiscard]] const std::vector<Line>& in_model_space() const {
    return true_size_lines.empty() ? lines : true_size_lines;
  }
};

/// Returns the pens for a drawing: the widest group that suits the sheet's size, or a narrower one
/// by the density where the lines are, as a dense drawing in wide lines is a black patch. Errors:
/// cancelled, out of memory.
[[nodiscard]] Result<Pens> choose_pens(const NeutralDrawing& drawing,
                                       const parallel::Context& context);

/// Chooses which lines are worth drawing, with the given pens or with those of choose_pens().
/// Visible lines are never left out.
[[nodiscard]] Result<Ink> choose_ink(const NeutralDrawing& drawing, const InkOptions& options,
                                     const parallel::Context& context);

}  // namespace strake::drawing
