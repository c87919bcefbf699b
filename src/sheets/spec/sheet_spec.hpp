// SPDX-License-Identifier: Apache-2.0
// A parsed sheet description: everything that a file says of a sheet and its views.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drawing/conventions.hpp"
#include "settings/named_sets.hpp"
#include "sheets/spec/template.hpp"
#include "strake/drawing/object_styles.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/single_lines.hpp"
#include "strake/sheets/sheet_file.hpp"

namespace strake::sheets {

enum class Projection : std::uint8_t { first_angle, third_angle };

/// The places of an arrangement; `none` is a view outside of it.
enum class ViewSlot : std::uint8_t { none, front, top, bottom, left, right, back, iso };

enum class HiddenLines : std::uint8_t { off, dashed, all };

/// How the sections of some objects are hatched.
struct HatchSpec {
  std::vector<settings::Chooser> select;  ///< empty: all
  hlr::Hatch hatch;
};

/// A section plane as written; with "=" the view decides which side is cut away.
struct SectionSpec {
  std::string text;
  settings::SourcePosition at;
};

/// Where a view ends at its limits, and which other goes on there.
struct NeighbourView {
  std::uint8_t axis = 0;         ///< that the plane is across
  bool upper = false;            ///< the view lies below the plane
  geometry::Box3l side;          ///< what both limits have in common, in the plane
  std::string title;             ///< of the other view, or its name
  std::ptrdiff_t sheets_on = 0;  ///< by how many the number of its sheet is larger
};

struct ViewSpec {
  std::string name, title;
  bool own_title = false;  ///< the file says the title
  std::string where;       ///< "deck.toml, line 7: [[view]] 'plan'"
  ViewSlot slot = ViewSlot::none;
  hlr::View view;  ///< its sections are those of `sections`, seen from where it looks
  hlr::Options options;
  std::vector<SectionSpec> sections;
  std::vector<settings::Chooser> select;  ///< empty: all objects
  std::vector<HatchSpec> hatches;         ///< the first that picks an object holds for it
  std::vector<settings::Chooser> uncut;   ///< what sections leave whole
  HiddenLines hidden = HiddenLines::off;
  drawing::Conventions conventions;                     ///< centre lines, break lines, thinning
  std::optional<model::SingleLineOptions> single_line;  ///< none: pipes have their outlines
  /// Objects that lie so far from all others that they decide the scale are left out.
  bool leaves_far_objects_out = false;
  std::optional<double> scale;
  std::optional<PaperPoint> position;  ///< position of the anchor, or without one of the middle
  std::optional<geometry::Vec3l> anchor;
  std::string section_mark;             ///< the letter of its section in other views; empty: none
  std::vector<std::string> extents_of;  ///< views whose extents are outlined in this one
  bool match_lines = false;             ///< it has match lines
  bool match_lines_own = false;         ///< the view says so itself, not what it shares with others
  std::vector<NeighbourView> neighbours = {};  ///< where it has match lines
};

struct TagSpec {
  /// With a leader, plainly on the object, or along it with a leader where it is too short.
  enum class Style : std::uint8_t { leader, plain, along };

  std::string where;
  std::optional<settings::Chooser> select;
  std::string text;
  std::vector<std::string> views;  ///< empty: all
  Style style = Style::leader;
  bool once = false;  ///< tag one of the objects with equal texts
  double height_mm = 2.5;
};

/// A plane across an axis of the model.
struct GridPlane {
  std::uint8_t axis = 0;
  std::string label;
  double at_mm = 0;
};

struct GridSpec {
  std::string where;
  std::vector<GridPlane> planes;
  std::vector<std::string> views;  ///< empty: all views that look along them
};

/// A height of the model that elevations mark.
struct LevelSpec {
  std::string label;
  double at_mm = 0;
};

struct LevelsSpec {
  std::string where;
  std::vector<LevelSpec> all;
  std::vector<std::string> views;  ///< empty: all elevations
};

struct ScaleBarSpec {
  std::string where;
  std::optional<PaperPoint> position;  ///< of its upper left corner
};

struct NorthSpec {
  std::string where;
  geometry::Vec3l direction{0, 1, 0};
  std::string view;                    ///< empty: the first that shows it
  std::optional<PaperPoint> position;  ///< of its middle
};

/// The balloons of a list: its numbers in circles, with leaders to objects of its rows.
struct BalloonSpec {
  /// Beside the lines of the view; `anywhere`: on the nearest free paper.
  enum class Side : std::uint8_t { anywhere, left, right, top, bottom };

  std::vector<std::string> views;  ///< in this order; empty: all, in their order
  double diameter_mm = 8;
  Side side = Side::anywhere;
};

/// A list of objects, those with equal texts on one line with their number.
struct PartsListSpec {
  std::string where, title;
  std::optional<settings::Chooser> select;
  std::vector<std::string> headings, columns;  ///< a column is a text with names, as tags have
  std::optional<PaperPoint> position;          ///< of its upper left corner
  std::optional<BalloonSpec> balloons = std::nullopt;
};

/// An end of a dimension: a point of the model, or a side of an object as a view shows it.
struct DimensionEnd {
  enum class Side : std::uint8_t { left, right, top, bottom, centre };

  std::string object;  ///< its id, or a name that no other object has; empty: `point`
  Side side = Side::centre;
  geometry::Vec3l point;  ///< grid units
};

struct DimensionSpec {
  enum class Along : std::uint8_t { horizontal, vertical, aligned };

  std::string where, view;
  DimensionEnd from, to;
  Along along = Along::horizontal;
  bool other_side = false;  ///< below or at the right, not above or at the left
  double offset_mm = 10;    ///< from the lines of the view, or of an aligned one from its points
  int decimals = -1;        ///< negative: as many as there are, three at most
};

struct RevisionSpec {
  std::string revision, date, text, by;
};

struct StyleSpec {
  std::optional<double> width_mm;
  std::optional<std::vector<double>> dash_mm;
  std::optional<model::Color> color;
};

/// How the lines of some objects are drawn.
struct ObjectStyleSpec {
  std::string where;
  std::optional<settings::Chooser> select;
  drawing::ObjectStyle style;
};

/// What a file says of one sheet.
struct SheetSpec {
  std::string file;
  std::string name;                ///< among the sheets of its file; empty: it is no [[sheet]]
  std::size_t number = 1, of = 1;  ///< which of how many it is
  double width_mm = 420, height_mm = 297;
  std::string size = "A3";
  bool frame = true;
  std::optional<Template> artwork;
  std::string template_name;        ///< as written in the file; empty: none
  std::optional<PaperBox> area;     ///< where views may lie; none: the frame's inside
  std::vector<PaperBox> keep_free;  ///< of views
  std::optional<double> scale;      ///< scale of views without their own
  Projection projection = Projection::first_angle;
  double gap_mm = 15;  ///< least gap between arranged views
  std::vector<std::pair<std::string, std::string>> fields;
  std::string fields_where;
  std::vector<ViewSpec> views;  ///< views of the arrangement come first
  std::vector<TagSpec> tags;
  GridSpec grid;
  LevelsSpec levels;
  std::optional<ScaleBarSpec> scale_bar;
  std::optional<NorthSpec> north;
  std::vector<PartsListSpec> parts_lists;
  std::vector<RevisionSpec> revisions;
  std::vector<DimensionSpec> dimensions;
  std::array<StyleSpec, kLineClasses> styles;
  std::vector<ObjectStyleSpec> object_styles;  ///< the first that picks an object holds for it
  bool split_hidden = false;  ///< what an object hides itself has a layer of its own
};

/// Returns the sheets of a file, one at least, in its order.
[[nodiscard]] Result<std::vector<SheetSpec>> parse_sheet_specs(std::string_view text,
                                                               std::string_view file,
                                                               ReadTemplate read_template);

}  // namespace strake::sheets
