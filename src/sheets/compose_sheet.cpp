// SPDX-License-Identifier: Apache-2.0
// Composing a sheet from its description.
#include "sheets/compose_sheet.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "drawing/layout/expected_extent.hpp"
#include "drawing/layout/view_plane.hpp"
#include "sheets/annotation/dimensions.hpp"
#include "sheets/annotation/match_lines.hpp"
#include "sheets/annotation/title_block.hpp"
#include "sheets/annotation/view_marks.hpp"
#include "sheets/arrangement/far_objects_of_views.hpp"
#include "sheets/arrangement/grid_lines.hpp"
#include "sheets/arrangement/levels.hpp"
#include "sheets/arrangement/view_arrangement.hpp"
#include "sheets/arrangement/view_margins.hpp"
#include "sheets/compose_labels.hpp"
#include "sheets/output/line_styles.hpp"
#include "sheets/pipe_scenes.hpp"
#include "sheets/place_notes.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "strake/drawing/hatching.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/model/selection.hpp"

namespace strake::sheets {

namespace {

using drawing::LineState;
using drawing::rounded_paper;
using Picks = std::vector<std::vector<bool>>;

/// Returns whether marks, from these on, reach beyond the paper.
bool leaves_paper(const Marks& marks, std::size_t first_path, std::size_t first_text,
                  const PaperBox& paper) {
  const auto off = [&](const PaperPoint& p) { return !paper.holds({p.x, p.y, p.x, p.y}); };
  for (std::size_t i = first_path; i < marks.paths.size(); ++i)
    if (std::ranges::any_of(marks.paths[i].points, off)) return true;
  for (std::size_t i = first_text; i < marks.texts.size(); ++i)
    if (!paper.holds(box_of(marks.texts[i]))) return true;
  return false;
}

class Composer {
 public:
  Composer(const SheetSpec& what, const model::Scene& scene, const ComposeOptions& options,
           const parallel::Context& context)
      : what_(what),
        scene_(scene),
        options_(options),
        context_(context),
        room_(sheet_area_of(what)),
        pipe_scenes_(scene) {}

  Result<Sheet> run() {
    sheet_.name = what_.name;
    sheet_.width_mm = what_.width_mm;
    sheet_.height_mm = what_.height_mm;
    check_uncut();
    for (const auto step : {&Composer::pick, &Composer::draw, &Composer::place, &Composer::ink})
      if (const Status status = (this->*step)(); !status) return status.error();
    check_places();
    const std::optional<double> scale = main_scale(what_, places_);
    for (std::size_t v = 0; v < what_.views.size(); ++v) caption(v, scale);
    grid();
    check_section_marks();
    view_marks();
    dimensions();
    match_lines();
    fill_frame(what_, scale, sheet_);
    draw_notes(notes_, what_, scale, sheet_);
    if (leaves_paper(sheet_.notes, 0, 0, paper()))
      warn("note-off-the-sheet", "a list, the scale bar or north reaches beyond the paper",
           what_.file);
    if (const Status status = labels(); !status) return status.error();
    for (PlacedView& view : sheet_.views) view.drawing.lines = {};
    return std::move(sheet_);
  }

 private:
  void warn(std::string code, std::string message, std::string where) {
    sheet_.diagnostics.add(
        {Severity::warning, std::move(code), std::move(message), std::move(where)});
  }

  /// Warns of what is to be left whole in views that no plane cuts.
  void check_uncut() {
    // By the place of the selection, which several views may share.
    std::map<std::string, bool> cut;
    for (const ViewSpec& view : what_.views)
      for (const settings::Chooser& chooser : view.uncut)
        cut[chooser.where] = cut[chooser.where] || !view.view.sections.empty();
    for (const auto& [where, some] : cut)
      if (!some)
        warn("uncut-without-sections",
             "no section cuts what is to be left whole; write sections = [\"z=4500mm\"], or leave "
             "uncut out",
             where);
  }

  /// Evaluates all selections on all objects, once.
  Status pick() {
    std::vector<model::Selection> selections;
    std::vector<const settings::Chooser*> choosers;
    const auto add_chooser = [&](const settings::Chooser& chooser) {
      selections.push_back(chooser.selection);
      choosers.push_back(&chooser);
    };
    for (const ViewSpec& view : what_.views) {
      for (const settings::Chooser& chooser : view.select) add_chooser(chooser);
      for (const HatchSpec& hatch : view.hatches)
        for (const settings::Chooser& chooser : hatch.select) add_chooser(chooser);
      for (const settings::Chooser& chooser : view.uncut) add_chooser(chooser);
    }
    for (const ObjectStyleSpec& style : what_.object_styles) add_chooser(*style.select);
    for (const TagSpec& tag : what_.tags) add_chooser(*tag.select);
    for (const PartsListSpec& list : what_.parts_lists) add_chooser(*list.select);
    Result<Picks> picked = model::pick(selections, scene_, context_);
    if (!picked) return picked.error();
    picks_ = std::move(*picked);
    std::vector<std::string> reported;
    for (std::size_t s = 0; s < picks_.size(); ++s) {
      const bool some = std::find(picks_[s].begin(), picks_[s].end(), true) != picks_[s].end();
      if (some || std::find(reported.begin(), reported.end(), choosers[s]->where) != reported.end())
        continue;
      reported.push_back(choosers[s]->where);
      warn("selection-matches-nothing", model::picks_nothing(choosers[s]->selection, *scene_.model),
           choosers[s]->where);
    }
    notes_ = plan_notes(what_, *scene_.model, std::span(picks_).last(what_.parts_lists.size()),
                        room_, sheet_.diagnostics);
    return {};
  }

  /// Returns the objects that the next selections pick, those of a list together; empty: all.
  [[nodiscard]] std::vector<bool> next_picks(std::size_t count) {
    std::vector<bool> any;
    if (count == 0) return any;
    any.resize(scene_.model->objects.size());
    for (const std::size_t end = used_ + count; used_ < end; ++used_)
      for (std::size_t o = 0; o < any.size(); ++o) any[o] = any[o] || picks_[used_][o];
    return any;
  }

  [[nodiscard]] std::vector<hlr::Hatch> hatches_of(const ViewSpec& view) {
    drawing::Hatching hatching(scene_.model->objects.size());
    for (const HatchSpec& spec : view.hatches)
      hatching.add(spec.hatch, next_picks(spec.select.size()));
    return std::move(hatching).by_object();
  }

  /// The objects and hatches that selections choose for a view, and what sections leave whole.
  struct ViewSelection {
    std::vector<bool> drawn;
    std::vector<hlr::Hatch> hatches;
    std::vector<bool> uncut;
  };

  Status draw() {
    std::vector<ViewSelection> chosen;
    for (const ViewSpec& view : what_.views) {
      chosen.push_back({next_picks(view.select.size()), {}, {}});
      chosen.back().hatches = hatches_of(view);
      chosen.back().uncut = next_picks(view.uncut.size());
    }
    if (const Status status = resolve_far(chosen); !status) return status;
    const Result<std::vector<double>> sags =
        options_.sag_for_paper ? sags_for_paper(chosen) : std::vector<double>{};
    if (!sags) return sags.error();
    for (std::size_t v = 0; v < what_.views.size(); ++v) {
      const ViewSpec& view = what_.views[v];
      hlr::Options options = view.options;
      options.solver = options_.solver;
      // Lines that the sheet does not show are not computed.
      options.hidden = view.hidden != HiddenLines::off;
      options.clipped = false;
      options.hatches = std::move(chosen[v].hatches);
      options.uncut = std::move(chosen[v].uncut);
      if (!sags->empty()) options.sag_mm = (*sags)[v];
      const Result<const model::Scene*> scene = pipe_scenes_.of(view, context_);
      if (!scene) return scene.error();
      Result<hlr::Drawing> lines =
          hlr::draw(**scene, chosen[v].drawn, view.view, options, context_);
      if (!lines) {
        Error error = lines.error();
        if (error.code != ErrorCode::cancelled)
          error.where = view.where + (error.where.empty() ? "" : ", " + error.where);
        return error;
      }
      sheet_.diagnostics.append(lines->diagnostics);
      drawings_.push_back(std::move(*lines));
    }
    return {};
  }

  Status resolve_far(std::vector<ViewSelection>& chosen) {
    std::vector<std::vector<bool>*> drawn;
    for (ViewSelection& of_view : chosen) drawn.push_back(&of_view.drawn);
    auto left_out = resolve_far_objects(what_, scene_, drawn, sheet_.diagnostics, context_);
    if (!left_out) return left_out.error();
    far_left_out_ = std::move(*left_out);
    return {};
  }

  /// Returns the sag of each view, from about the scale that it will have; empty where nothing
  /// would fit.
  [[nodiscard]] Result<std::vector<double>> sags_for_paper(
      const std::vector<ViewSelection>& chosen) const {
    std::vector<drawing::PlaneBox> extents;
    for (std::size_t v = 0; v < what_.views.size(); ++v) {
      const ViewSpec& spec = what_.views[v];
      const auto& eye = spec.view.perspective;
      const geometry::Vec3l origin = spec.anchor.value_or(eye ? eye->target : geometry::Vec3l{});
      const auto extent =
          drawing::expected_extent(scene_, chosen[v].drawn, spec.view, origin, context_);
      if (!extent) return extent.error();
      extents.push_back(*extent);
    }
    std::vector<double> sags = expected_scales(what_, extents, room_);
    for (std::size_t v = 0; v < sags.size(); ++v)
      sags[v] = drawing::unseen_sag_mm(extents[v], sags[v]);
    return sags;
  }

  Status place() {
    auto places = place_views(what_, drawings_, room_, context_);
    if (!places) return places.error();
    places_ = std::move(*places);
    for (std::size_t v = 0; v < what_.views.size(); ++v) {
      const PaperBox& lines = places_[v].lines;
      dimensioned_.push_back(with_margins(lines, dimension_margins(what_, what_.views[v])));
      labelled_.push_back(with_margins(lines, label_margins(what_, what_.views[v])));
    }
    if (const Status status = check_reach(); !status) return status;
    for (std::size_t v = 0; v < what_.views.size(); ++v) {
      const ViewSpec& spec = what_.views[v];
      drawing::LayoutOptions options;
      options.view_name = spec.name;
      options.title = spec.title;
      options.placement = placement(v);
      options.far_left_out = far_left_out_[v];
      for (const settings::Chooser& chooser : spec.uncut)
        options.uncut_selections.push_back(chooser.selection.text());
      if (spec.single_line) options.single_line_mm = spec.single_line->largest_diameter_mm;
      auto laid_out = drawing::lay_out(drawings_[v], *scene_.model, options, context_);
      if (!laid_out) return laid_out.error();
      drawings_[v] = {};
      sheet_.views.push_back({spec.name,
                              spec.title,
                              std::move(*laid_out),
                              {},
                              places_[v].lines,
                              {},
                              {},
                              {},
                              {},
                              {},
                              {}});
      frame_view(sheet_.views.back());
      check_lines(spec, sheet_.views.back().drawing);
    }
    return {};
  }

  static void frame_view(PlacedView& view) {
    if (!view.drawing.frame) return;
    const auto& [left, top, right, bottom] = *view.drawing.frame;
    view.frame.paths.push_back(
        {LineClass::frame_thin,
         {{left, top}, {right, top}, {right, bottom}, {left, bottom}, {left, top}},
         false});
  }

  /// Checks that no view lies far off the sheet, where coordinates would not be micrometres.
  [[nodiscard]] Status check_reach() const {
    constexpr double kFarthest = 1e9;
    const PaperBox reach{-kFarthest, -kFarthest, kFarthest, kFarthest};
    for (std::size_t v = 0; v < places_.size(); ++v)
      if (!reach.holds(places_[v].whole))
        return Error{ErrorCode::input,
                     "at " + drawing::scale_text(places_[v].scale) +
                         " its lines lie more than 1000 km of paper off the sheet",
                     what_.views[v].where, "mend its anchor, its limits or its scale"};
    return {};
  }

  [[nodiscard]] drawing::Placement placement(std::size_t v) const {
    const ViewPlace& place = places_[v];
    return {{what_.width_mm, what_.height_mm, place.scale, drawing::scale_text(place.scale)},
            place.anchor,
            place.at};
  }

  void check_lines(const ViewSpec& spec, const drawing::NeutralDrawing& lines) {
    const auto of = [&](LineState state) { return lines.count[static_cast<std::size_t>(state)]; };
    if (of(LineState::visible) > 0) return;
    const bool nothing = lines.account.objects() == 0;
    const bool hidden = lines.account.of(hlr::Fate::hidden) > 0;
    warn("view-empty",
         "the view '" + spec.name + "' shows nothing: " +
             (nothing                      ? "it has no objects"
              : hidden                     ? "all that lies within is hidden"
              : of(LineState::clipped) > 0 ? "nothing lies within what it shows"
                                           : "its objects have no lines to draw"),
         spec.where);
  }

  /// Chooses the ink of all views with one set of pens: those that the densest view can bear.
  Status ink() {
    std::optional<drawing::Pens> pens;
    for (const PlacedView& view : sheet_.views) {
      const Result<drawing::Pens> own = drawing::choose_pens(view.drawing, context_);
      if (!own) return own.error();
      if (!pens || own->edge < pens->edge) pens = *own;
    }
    sheet_.styles = styles_of(what_.styles, pens.value_or(drawing::Pens{}));
    const std::shared_ptr<const drawing::ObjectStyles> styles = object_styles();
    for (std::size_t v = 0; v < sheet_.views.size(); ++v) {
      const HiddenLines hidden = what_.views[v].hidden;
      auto chosen = drawing::choose_ink(sheet_.views[v].drawing,
                                        {.hidden = hidden != HiddenLines::off,
                                         .clean_up = hidden != HiddenLines::all,
                                         .split_hidden = what_.split_hidden,
                                         .pens = pens_of(sheet_.styles),
                                         .styles = styles},
                                        context_);
      if (!chosen) return chosen.error();
      sheet_.views[v].ink = std::move(*chosen);
      if (const Status status = conventions(v); !status) return status;
    }
    return {};
  }

  /// Returns the styles of the objects; null: they all look alike.
  [[nodiscard]] std::shared_ptr<const drawing::ObjectStyles> object_styles() {
    if (what_.object_styles.empty()) return nullptr;
    drawing::ObjectStyles styles(scene_.model->objects.size());
    for (const ObjectStyleSpec& spec : what_.object_styles) styles.add(spec.style, next_picks(1));
    return std::make_shared<const drawing::ObjectStyles>(std::move(styles));
  }

  Status conventions(std::size_t v) {
    PlacedView& view = sheet_.views[v];
    const ViewSpec& spec = what_.views[v];
    const Status status = drawing::apply_conventions(view.ink, view.drawing, *scene_.model,
                                                     spec.conventions, context_);
    if (status && view.ink.thinned && view.ink.thinned->lines > 0)
      sheet_.diagnostics.add(
          Severity::note, "lines-thinned",
          "the view '" + view.name + "' lacks " + std::to_string(view.ink.thinned->lines) +
              " lines of " + std::to_string(view.ink.thinned->objects) +
              " objects, wholly or in part, that lie too near to each other on paper",
          spec.where);
    return status;
  }

  [[nodiscard]] PaperBox paper() const { return {0, 0, what_.width_mm, what_.height_mm}; }

  void check_places() {
    for (std::size_t v = 0; v < places_.size(); ++v) {
      const ViewSpec& view = what_.views[v];
      const PaperBox& box = places_[v].whole;
      const std::string name =
          "the view '" + view.name + "' at " + drawing::scale_text(places_[v].scale);
      if (!paper().holds(box))
        warn("view-off-the-sheet", name + " reaches beyond the paper", view.where);
      else if (!room_.area.holds(box))
        warn("view-off-the-frame", name + " reaches beyond the frame", view.where);
      if (std::any_of(room_.keep_free.begin(), room_.keep_free.end(),
                      [&](const PaperBox& k) { return k.overlaps(box); }))
        warn("view-on-title-block", name + " covers the title block or a note", view.where);
      for (std::size_t w = 0; w < v; ++w)
        if (places_[w].whole.overlaps(box))
          warn("views-overlap", name + " overlaps '" + what_.views[w].name + "'", view.where);
    }
  }

  /// Writes the title below a view, underlined, and its scale where that is not the sheet's.
  void caption(std::size_t v, std::optional<double> sheet_scale) {
    PlacedView& view = sheet_.views[v];
    const PaperBox& box = places_[v].lines;
    const double x = rounded_paper((box.left + box.right) / 2);
    const Lettering letters = lettering_of(what_);
    double y = box.bottom + margins_of(what_, what_.views[v]).bottom_mm + letters.gap_mm;
    const auto write = [&](const std::string& text, double height) {
      y = rounded_paper(y + height);
      view.caption.texts.push_back({LineClass::title, {x, y}, height, Align::middle, text, false});
      y = rounded_paper(y + 1.5);
    };
    if (!view.title.empty()) {
      write(view.title, letters.title_mm);
      const double half = rounded_paper(text_width(view.title) * letters.title_mm / 2);
      view.caption.paths.push_back({LineClass::title, {{x - half, y}, {x + half, y}}, false});
      y += 1.5;
    }
    if (places_[v].scale != sheet_scale && !what_.views[v].view.perspective)
      write(drawing::scale_text(places_[v].scale), letters.scale_mm);
  }

  void grid() {
    std::vector<bool> somewhere(what_.grid.planes.size());
    for (std::size_t v = 0; v < sheet_.views.size(); ++v) {
      GridMarks marks =
          grid_marks(what_.grid, what_.views[v], placement(v), places_[v].lines, dimensioned_[v]);
      for (std::size_t p = 0; p < somewhere.size(); ++p)
        somewhere[p] = somewhere[p] || marks.drawn[p];
      if (marks.unlabelled > 0)
        sheet_.diagnostics.add(Severity::note, "grid-label-no-room",
                               "in the view '" + what_.views[v].name + "' " +
                                   std::to_string(marks.unlabelled) +
                                   " grid lines have no room for their labels",
                               what_.grid.where);
      sheet_.views[v].grid = std::move(marks.marks);
    }
    for (std::size_t p = 0; p < somewhere.size(); ++p)
      if (!somewhere[p])
        warn("grid-line-nowhere",
             "the grid line '" + what_.grid.planes[p].label + "' shows in no view",
             what_.grid.where);
  }

  /// Warns of views whose sections have one letter, so that nobody knows where each is cut.
  void check_section_marks() {
    std::map<std::string, const ViewSpec*> first;
    for (const ViewSpec& view : what_.views) {
      if (view.section_mark.empty()) continue;
      const auto [it, is_new] = first.emplace(view.section_mark, &view);
      if (!is_new && !std::ranges::equal(it->second->sections, view.sections, {},
                                         &SectionSpec::text, &SectionSpec::text))
        warn("section-mark-twice",
             "the section mark " + view.section_mark + " is that of the view '" + it->second->name +
                 "', too, which is cut elsewhere",
             view.where);
    }
  }

  /// Marks levels, and where and what other views show.
  void view_marks() {
    std::vector<bool> level(what_.levels.all.size()), cut(what_.views.size());
    const double letters = lettering_of(what_).scale_mm;
    for (std::size_t v = 0; v < sheet_.views.size(); ++v) {
      const ViewSpec& spec = what_.views[v];
      const drawing::Placement place = placement(v);
      const MarkedView in{spec, place, places_[v].lines, labelled_[v]};
      Marks& marks = sheet_.views[v].notes;
      const auto within =
          mark_levels(what_.levels, spec, place, places_[v].lines, dimensioned_[v].right, marks);
      for (std::size_t i = 0; i < level.size(); ++i) level[i] = level[i] || within[i];
      for (std::size_t w = 0; w < sheet_.views.size(); ++w) {
        const ViewSpec& other = what_.views[w];
        if (w != v && !other.section_mark.empty())
          cut[w] = mark_section(other, in, letters, sheet_.views[v].grid, marks) || cut[w];
      }
      for (std::size_t w = 0; w < sheet_.views.size(); ++w) {
        const ViewSpec& other = what_.views[w];
        if (std::ranges::find(spec.extents_of, other.name) == spec.extents_of.end()) continue;
        if (!mark_extent(extent_of(w), other.title.empty() ? other.name : other.title, in, letters,
                         sheet_.views[v].grid, marks))
          warn("extent-not-shown",
               "the view '" + spec.name + "' cannot show what '" + other.name +
                   "' shows: one of them is in perspective, or empty",
               spec.where);
      }
    }
    for (std::size_t i = 0; i < level.size(); ++i)
      if (!level[i])
        warn("level-nowhere",
             "the level '" + level_text(what_.levels.all[i]) + "' shows in no view",
             what_.levels.where);
    for (std::size_t v = 0; v < cut.size(); ++v)
      if (!cut[v] && !what_.views[v].section_mark.empty())
        warn("section-mark-nowhere",
             "no other view sees the section " + what_.views[v].section_mark + " edge-on",
             what_.views[v].where);
  }

  void dimensions() {
    for (const DimensionSpec& spec : what_.dimensions)
      for (std::size_t v = 0; v < sheet_.views.size(); ++v) {
        if (what_.views[v].name != spec.view) continue;
        const drawing::Placement place = placement(v);
        Marks& marks = sheet_.views[v].notes;
        const std::size_t paths = marks.paths.size(), texts = marks.texts.size();
        const Status drawn = draw_dimension(
            spec, scene_, {what_.views[v], place, places_[v].lines, labelled_[v]}, marks);
        if (!drawn) warn("dimension-not-drawn", drawn.error().message, spec.where);
        if (leaves_paper(marks, paths, texts, paper()))
          warn("note-off-the-sheet", "the dimension reaches beyond the paper", spec.where);
      }
  }

  void match_lines() {
    const double letters = lettering_of(what_).scale_mm;
    for (std::size_t v = 0; v < sheet_.views.size(); ++v) {
      const ViewSpec& spec = what_.views[v];
      if (!spec.match_lines) continue;
      const drawing::Placement place = placement(v);
      PlacedView& view = sheet_.views[v];
      bool any = false;
      for (const NeighbourView& neighbour : spec.neighbours) {
        std::vector<PaperBox> taken;
        for (const Marks* marks : {&view.grid, &view.notes, &view.match_lines})
          std::ranges::move(taken_boxes(*marks), std::back_inserter(taken));
        const std::size_t paths = view.match_lines.paths.size(),
                          texts = view.match_lines.texts.size();
        const auto line =
            draw_match_line(neighbour, what_.number, {spec, place, places_[v].lines, labelled_[v]},
                            letters, taken, view.match_lines);
        if (line) clear_below(*line, view);
        if (line && leaves_paper(view.match_lines, paths, texts, paper()))
          warn("note-off-the-sheet", "the match line or its text reaches beyond the paper",
               spec.where);
        any = any || line;
      }
      if (!any && spec.match_lines_own)
        warn("match-line-nowhere",
             "the view '" + spec.name + "' has no match line: " + why_no_match_line(spec),
             spec.where);
    }
  }

  static const char* why_no_match_line(const ViewSpec& spec) {
    if (spec.view.perspective) return "it is in perspective";
    if (!spec.view.limits)
      return "it has no limits (write limits = { min = [...], max = [...] } that end where those "
             "of "
             "another view begin)";
    return spec.neighbours.empty()
               ? "its limits end where those of no other view of the same direction begin"
               : "its lines end long before its limits";
  }

  /// Returns the box of what a view shows, mm of the model: its limits, or its visible lines.
  [[nodiscard]] geometry::Box3d extent_of(std::size_t v) const {
    geometry::Box3d box{{1, 1, 1}, {0, 0, 0}};
    const hlr::View& view = what_.views[v].view;
    if (view.perspective) return box;
    if (view.limits) return {geometry::to_mm(view.limits->lo), geometry::to_mm(view.limits->hi)};
    bool any = false;
    for (const drawing::Line& line : sheet_.views[v].ink.lines)
      for (const geometry::Vec3d& p : {line.a_mm, line.b_mm}) {
        if (!any) box = {p, p};
        any = true;
        box.include(p);
      }
    return box;
  }

  Status labels() {
    const auto picked = std::span(picks_).subspan(used_, what_.tags.size());
    return compose_labels(what_, *scene_.model, picked, notes_, room_, sheet_, context_);
  }

  const SheetSpec& what_;
  const model::Scene& scene_;
  const ComposeOptions& options_;
  const parallel::Context& context_;
  SheetArea room_;
  Picks picks_;
  std::size_t used_ = 0;                                    ///< how many of them have been used
  std::vector<std::vector<model::ObjectId>> far_left_out_;  ///< of each view
  PipeScenes pipe_scenes_;
  std::vector<hlr::Drawing> drawings_;
  std::vector<ViewPlace> places_;
  std::vector<PaperBox> dimensioned_;  ///< the lines of each view, with its dimensions
  std::vector<PaperBox> labelled_;     ///< and with the labels of its grid lines and levels
  Notes notes_;
  Sheet sheet_;
};

}  // namespace

Result<Sheet> compose(const SheetSpec& what, const model::Scene& scene,
                      const ComposeOptions& options, const parallel::Context& context) {
  return Composer(what, scene, options, context).run();
}

}  // namespace strake::sheets
