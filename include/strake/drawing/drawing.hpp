// SPDX-License-Identifier: Apache-2.0
// Drawings without a format: lines and curves of a view on paper, and how a view gets there.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// The state of a piece on paper: hlr::State, and `duplicate`, which only the layout knows.
enum class LineState : std::uint8_t {
  visible,
  hidden_by_self,
  hidden_by_other,
  projecting,
  clipped,
  duplicate,  ///< covered by a piece that is drawn: visible first, then nearest, lowest id
};
inline constexpr std::size_t kLineStates = 6;

[[nodiscard]] LineState line_state(hlr::State state);

/// Names as files spell them: "hidden_by_self", "non_manifold", "global".
[[nodiscard]] std::string_view state_name(LineState state);
[[nodiscard]] std::string_view kind_name(hlr::EdgeKind kind);
[[nodiscard]] std::string_view stage_name(hlr::Stage stage);
[[nodiscard]] std::string_view fate_name(hlr::Fate fate);
[[nodiscard]] std::string_view smooth_name(hlr::Smooth smooth);
[[nodiscard]] std::string_view intersections_name(hlr::Intersections intersections);
[[nodiscard]] std::string_view own_polylines_name(hlr::OwnPolylines polylines);

/// A point on the sheet in millimetres: x to the right, y down, from the upper left corner.
struct PaperPoint {
  double x = 0, y = 0;
  friend bool operator==(const PaperPoint&, const PaperPoint&) = default;
};

/// The largest coordinate on paper that a point of a drawing may have.
inline constexpr double kFarthestPaperMm = 1e9;

/// A straight piece of an edge, in the model and on the sheet.
struct Line {
  model::ObjectId object{};
  std::uint32_t edge = 0;
  hlr::EdgeKind kind = hlr::EdgeKind::sharp;
  LineState state = LineState::visible;
  model::ObjectId other{};  ///< the second object of an intersection; otherwise equal to `object`
  geometry::Vec3d a_mm, b_mm;
  PaperPoint a_paper, b_paper;  ///< multiples of a micrometre of paper
};

/// A frame on the sheet, mm; y points down.
struct PaperFrame {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// An ellipse on the sheet: centre + u cos t + v sin t, with conjugate half-diameters.
struct PaperCurve {
  PaperPoint centre, u, v;
};

/// The curves that straight lines stand for.
struct PaperCurves {
  std::vector<PaperCurve> all;
  std::vector<hlr::CurvedEdge> edges;  ///< sorted by (object, edge); indices into `all`

  /// Returns the curve that a line is a chord of; null: the line is straight.
  [[nodiscard]] const PaperCurve* of(const Line& line) const;
  /// Returns the index of that curve into `all`; kNone: the line is straight.
  [[nodiscard]] std::uint32_t index_of(const Line& line) const;
  static constexpr std::uint32_t kNone = 0xffffffffU;
};

struct Sheet {
  double width_mm = 420, height_mm = 297;
  double scale = 1;        ///< model mm per paper mm
  std::string scale_text;  ///< "1:50", "2:1"
};

/// The place of a view on a sheet that is known already.
struct Placement {
  Sheet sheet;
  geometry::Vec3l anchor;  ///< a point of the model, grid units …
  PaperPoint at;  ///< … and where that point lies. Views that share the anchor are aligned.
};

/// A size of paper, millimetres.
struct PaperSize {
  double width_mm = 420, height_mm = 297;
};

struct LayoutOptions {
  std::string view_name = "view";
  std::string title = {};  ///< of the sheet; empty: the view's name, and its sections
  std::optional<double> scale = std::nullopt;  ///< model mm per paper mm; none: chosen to fit
  /// The paper, which the view must fit. None: A3 where the scale is chosen, otherwise the smallest
  /// of A3 to A0 that the view fits, or as large a sheet as it needs.
  std::optional<PaperSize> paper = std::nullopt;
  double margin_mm = 10;
  std::optional<Placement> placement = std::nullopt;  ///< instead of scale, paper and margin
  /// Find pieces that lie on each other within the contact distance (3 µm at least) in the plane of
  /// the view, and draw one of them.
  bool remove_duplicates = true;
  /// Objects that were left out of the selection because they lie far from all others; the drawing
  /// names them.
  std::vector<model::ObjectId> far_left_out = {};
  /// What the selections of hlr::Options::uncut are called; the drawing says so.
  std::vector<std::string> uncut_selections = {};
  /// Pipes up to this outer diameter, mm, were made single lines before the lines were found (0:
  /// none were); the drawing says so.
  double single_line_mm = 0;
};

/// A drawing without a format: SVG and JSON are both written from it.
///
/// Lines keep the order (object, edge, parameter), so the bytes do not depend on the number of
/// threads.
struct NeutralDrawing {
  std::string view_name, title;
  hlr::View view;
  hlr::Stage stage = hlr::Stage::global;
  bool hidden_lines = true;  ///< false: left out, see hlr::Options::hidden
  double sharp_angle_deg = 20;
  hlr::Smooth smooth = hlr::Smooth::off;
  hlr::Intersections intersections = hlr::Intersections::primitives;
  hlr::OwnPolylines own_polylines = hlr::OwnPolylines::visible;
  bool flush_seams = true;  ///< false: left out, see hlr::Options::flush_seams
  bool uncut = false;       ///< sections leave objects whole: see hlr::Options::uncut
  std::vector<std::string> uncut_selections;  ///< as LayoutOptions has them, in order and each once
  double single_line_mm = 0;                  ///< as LayoutOptions has it
  double contact_distance_mm = 0;
  double sag_mm = 0;    ///< the sag requested of curved primitives; 0: unknown
  double weld_mm = -1;  ///< seams were closed within it; negative: the precision of each body
  Sheet sheet;
  std::vector<Line> lines;
  PaperCurves curves;
  /// Round the lines of a view in perspective: where its field of view ends, or beside the lines
  /// that end before.
  std::optional<PaperFrame> frame;
  std::array<std::uint64_t, kLineStates> count{};  ///< number of lines by state
  hlr::Counters counters;
  hlr::Account account;
  std::vector<model::ObjectId> far_left_out;  ///< as LayoutOptions has them
  Hash128 hash;  ///< of the view and of every line in the model; not of the sheet or of settings
};

/// Returns how far curved primitives may be from their true surfaces so that nobody sees it on
/// paper (hlr::Options::sag_mm), model mm: 0.05 mm at the scale of the drawing, in perspective in
/// the plane of the target; no less than the grid's 1 µm, nor than 0.05 mm on an A0 sheet that
/// holds the whole view. Where the scale is yet to be chosen, it is estimated from the corners of
/// the objects: exactly, or nearly where limits or sections cut them. 0 for an empty view. `drawn`
/// as in hlr::draw(). Errors: usage for a selection of the wrong size; cancelled.
[[nodiscard]] Result<double> sag_for_paper(const model::Scene& scene,
                                           const std::vector<bool>& drawn, const hlr::View& view,
                                           const LayoutOptions& options,
                                           const parallel::Context& context);

/// Puts a finished hidden-line run on paper: chooses the axes from direction and up, the scale and
/// the sheet. Objects whose visible lines are all duplicates become Fate::coincident. The result is
/// deterministic: it uses + - * / and sqrt only.
/// Errors: usage, where the view does not fit its paper at the scale that was given.
[[nodiscard]] Result<NeutralDrawing> lay_out(const hlr::Drawing& drawing, const model::Model& model,
                                             const LayoutOptions& options,
                                             const parallel::Context& context);

/// Puts a drawing that is on paper on other paper, at another scale, under another title: of the
/// options those three count. Its lines stay the same, and so do their places where sheet and scale
/// do. Otherwise lines and curves lie where lay_out() puts them; only where duplicates cut a line
/// its place is that of the cut rounded to a micrometre of the model. Errors: usage, where the view
/// does not fit; input, where its places are not those of its view and scale; cancelled.
[[nodiscard]] Result<NeutralDrawing> lay_out_again(NeutralDrawing drawing,
                                                   const LayoutOptions& options,
                                                   const parallel::Context& context);

}  // namespace strake::drawing
