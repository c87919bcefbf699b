// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/file_match.hpp"
#include "strake/report/view_document.hpp"

/// Tells what changed from one drawing of a view to another.
///
///     const auto old_drawing = report::read_view_document("monday.json");
///     const auto new_drawing = report::read_view_document("tuesday.json");
///     const auto diff = report::compare(*old_drawing, *new_drawing, {}, context);
namespace strake::report {

/// What a line is: its object, kind and state.
struct DiffLineClass {
  std::uint32_t object = 0,
                other = 0;  ///< indices into ViewDiff::objects; other: for an intersection
  hlr::EdgeKind kind = hlr::EdgeKind::sharp;
  drawing::LineState state = drawing::LineState::visible;
  friend auto operator<=>(const DiffLineClass&, const DiffLineClass&) = default;
};

enum class LineChange : std::uint8_t { same, added, gone, changed };
inline constexpr std::size_t kLineChanges = 4;
[[nodiscard]] std::string_view change_name(LineChange change);  ///< "same", "new" …

/// A part of a piece, which is of the older document where it is gone, else of the newer.
struct DiffInterval {
  std::uint32_t piece = 0;
  float from = 0, to = 1;  ///< parameters, from 0 at a to 1 at b
  LineChange change = LineChange::same;
  DiffLineClass was;  ///< the class before, where it changed
};

struct LineCount {
  std::uint64_t lines = 0;
  double length_mm = 0;
};
using LineCounts = std::array<LineCount, kLineChanges>;

struct ViewSettingChange {
  std::string setting, before, after;  ///< empty: absent
};

/// The differences of two documents; it refers to both.
struct ViewDiff {
  const ViewDocument* before = nullptr;
  const ViewDocument* after = nullptr;
  double tolerance_mm = 0;
  FileMatches files;  ///< which file of one drawing was taken for which of the other
  /// The objects of both, each once, by file and id; where files were renamed, as the newer drawing
  /// has them.
  std::vector<const ViewObject*> objects;
  std::vector<std::uint32_t> of_before,
      of_after;  ///< by object of the document: its number in `objects`
  /// Numbers in `objects` of what a drawing left out because it lies far from all others.
  std::set<std::uint32_t> far_before, far_after;
  /// Settings that differ, by name: those of the documents, and "far_objects": how many objects
  /// each left out and which of them the other did not, as "2 (valve, pump)".
  std::vector<ViewSettingChange> settings;
  /// The intervals by piece and along it: first all of the older document that is gone, then all of
  /// the newer.
  std::vector<DiffInterval> intervals;
  LineCounts total;
  /// Of the lines that are gone, those of objects that the newer drawing left out as far from all
  /// others; of those that are new, those of objects that the older one left out.
  LineCount gone_left_out, new_left_out;
  std::map<std::pair<hlr::EdgeKind, drawing::LineState>, LineCounts> by_class;
  std::map<std::uint32_t, LineCounts> by_object;  ///< objects of which not all is the same

  [[nodiscard]] const ViewPiece& piece(const DiffInterval& s) const {
    return (s.change == LineChange::gone ? before : after)->pieces[s.piece];
  }
  [[nodiscard]] DiffLineClass line_class(const DiffInterval& s) const;
  /// Whether any line is new, gone or changed; with `visible_only`, one that is or was visible.
  [[nodiscard]] bool differs(bool visible_only) const;
};

struct ViewDiffOptions {
  /// Lines no farther apart than this lie on each other, and intervals no longer than this count as
  /// what is beside them. Two micrometres are what rounding to the grid makes of one line.
  double tolerance_mm = 0.002;
  /// Which file of one drawing is which of the other; by default their labels say so.
  FileMatches files{};
};

/// Tells which file of one drawing is which of the other, by the ids of what is drawn, and where
/// they do not decide by the places of lines. What `given_pairs` says, as OLD=NEW, comes first.
/// Errors: usage, as of match_files() of RunFiles and parse_file_pairs().
[[nodiscard]] Result<FileMatches> match_files(const ViewDocument& before, const ViewDocument& after,
                                              std::span<const std::string> given_pairs = {});

/// Compares drawings place by place in the model. Where lines of both drawings lie on each other,
/// classes that both have are the same however the lines are cut into pieces; of those that only
/// one has, as many as the other lacks are changed, those of one object and kind before others, and
/// the rest is new or gone. Lines of one drawing that lie on each other and are of one class count
/// as one.
///
/// Errors: usage for a tolerance that is none; input for drawings that look from different sides,
/// or have more lines at one place than can be compared; cancelled.
[[nodiscard]] Result<ViewDiff> compare(const ViewDocument& before, const ViewDocument& after,
                                       const ViewDiffOptions& options,
                                       const parallel::Context& context);

/// Writes the document of schemas/view-diff.schema.json.
void write_view_diff_json(const ViewDiff& diff, Sink sink);

/// Draws a picture on the sheet of the newer drawing: what is gone, new and changed over what is
/// the same, in colours, hidden lines dashed.
void write_view_diff_svg(const ViewDiff& diff, Sink sink);

/// Returns a table for a terminal: counts by class and by object, as many of these as `rows`.
[[nodiscard]] std::string view_diff_table(const ViewDiff& diff, const TableOptions& options);

}  // namespace strake::report
