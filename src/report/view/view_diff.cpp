// SPDX-License-Identifier: Apache-2.0
#include "strake/report/view_diff.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <string_view>

#include "report/files/file_map.hpp"
#include "report/view/drawn_ids.hpp"
#include "report/view/line_match.hpp"

namespace strake::report {
namespace {

constexpr double kMaxToleranceMm = 1e6;

/// Whether a setting of a view says what of it is drawn, not from where.
bool may_differ(std::string_view setting) {
  constexpr std::array<std::string_view, 4> kThese{"view.name", "view.up", "view.limits_mm",
                                                   "view.sections"};
  return !setting.starts_with("view.") || std::ranges::find(kThese, setting) != kThese.end();
}

std::vector<ViewSettingChange> setting_changes(const ViewDocument& before,
                                               const ViewDocument& after) {
  std::set<std::string> names;
  for (const ViewDocument* const document : {&before, &after})
    for (const auto& [name, value] : document->settings) names.insert(name);
  const auto value = [](const ViewDocument& document, const std::string& name) {
    const auto at = document.settings.find(name);
    return at == document.settings.end() ? std::string() : at->second;
  };
  std::vector<ViewSettingChange> changes;
  for (const std::string& name : names)
    if (value(before, name) != value(after, name))
      changes.push_back({name, value(before, name), value(after, name)});
  return changes;
}

/// Numbers the objects of both drawings, and those that they left out as far from all others; those
/// of the older one by what they are in the newer.
void number_objects(ViewDiff& diff) {
  DrawnIds drawn_before, drawn_after;
  if (!diff.files.by_label_alone()) {
    drawn_before.add(*diff.before);
    drawn_after.add(*diff.after);
  }
  const FileMap files(
      diff.files, [&](auto file, auto id) { return drawn_before.has(file, id); },
      [&](auto file, auto id) { return drawn_after.has(file, id); });
  std::map<std::pair<std::string, std::string_view>, std::uint32_t> known;
  const auto number = [&](const ViewObject& object, std::string file) {
    const auto next = static_cast<std::uint32_t>(known.size());
    const auto [at, is_new] = known.try_emplace({std::move(file), object.id}, next);
    if (is_new)
      diff.objects.push_back(&object);
    else if (!files.is_identity())
      diff.objects[at->second] = &object;
    return at->second;
  };
  const auto number_before = [&](const ViewObject& o) {
    return number(o, files.label_in_other(RunSide::before, o.file, o.id));
  };
  for (const ViewObject& o : diff.before->objects) diff.of_before.push_back(number_before(o));
  for (const ViewObject& o : diff.before->far_objects) diff.far_before.insert(number_before(o));
  for (const ViewObject& o : diff.after->objects) diff.of_after.push_back(number(o, o.file));
  for (const ViewObject& o : diff.after->far_objects) diff.far_after.insert(number(o, o.file));
}

/// "2 (valve, pump)": how many objects a drawing left out, and which of them the other did not.
std::string far_objects_text(const ViewDiff& diff, const std::set<std::uint32_t>& own,
                             const std::set<std::uint32_t>& other) {
  constexpr std::size_t kMaxNamed = 3;
  std::string names;
  std::size_t alone = 0;
  for (const std::uint32_t number : own) {
    if (other.contains(number) || ++alone > kMaxNamed) continue;
    const ViewObject& object = *diff.objects[number];
    names += (names.empty() ? "" : ", ") + (object.name.empty() ? object.id : object.name);
  }
  if (alone > kMaxNamed) names += ", …";
  return std::to_string(own.size()) + (names.empty() ? "" : " (" + names + ")");
}

/// Tells where the drawings left different objects out as far from all others, which no setting of
/// theirs says.
void report_far_objects(ViewDiff& diff) {
  if (diff.far_before == diff.far_after) return;
  diff.settings.insert(diff.settings.begin(),
                       {"far_objects", far_objects_text(diff, diff.far_before, diff.far_after),
                        far_objects_text(diff, diff.far_after, diff.far_before)});
}

DiffLineClass class_of(const ViewPiece& piece, const std::vector<std::uint32_t>& numbers) {
  return {numbers[piece.object], numbers[piece.other], piece.kind, piece.state};
}

std::vector<ClassedPiece> classed(const ViewDiff& diff) {
  std::vector<ClassedPiece> pieces;
  pieces.reserve(diff.before->pieces.size() + diff.after->pieces.size());
  for (const ViewPiece& piece : diff.before->pieces)
    pieces.push_back({&piece, class_of(piece, diff.of_before), false});
  for (const ViewPiece& piece : diff.after->pieces)
    pieces.push_back({&piece, class_of(piece, diff.of_after), true});
  return pieces;
}

double length_of(const ViewPiece& piece) {
  const geometry::Vec3d along = (piece.b - piece.a).as<double>() * 1e-3;
  return std::sqrt(dot(along, along));
}

void make_diff_intervals(ViewDiff& diff, std::span<const ClassedPiece> pieces,
                         std::span<const std::uint8_t> has_equal,
                         std::span<const PieceCoverage> covers) {
  const std::size_t first_after = diff.before->pieces.size();
  std::vector<DiffInterval> some;
  std::size_t next = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool after = pieces[i].after;
    const auto number = static_cast<std::uint32_t>(after ? i - first_after : i);
    if (has_equal[i] != 0) {
      if (after) diff.intervals.push_back({number, 0, 1, LineChange::same, {}});
      continue;
    }
    std::vector<CoveredInterval> own;
    for (; next < covers.size() && covers[next].of == i; ++next) own.push_back(covers[next].cover);
    some.clear();
    append_diff_intervals(some, number, length_of(*pieces[i].piece), pieces[i].cls, after, own,
                          diff.tolerance_mm);
    for (const DiffInterval& s : some)
      if (after || s.change == LineChange::gone) diff.intervals.push_back(s);
  }
}

void add(LineCount& count, double length) {
  ++count.lines;
  count.length_mm += length;
}

void count(ViewDiff& diff) {
  for (const DiffInterval& s : diff.intervals) {
    const auto change = static_cast<std::size_t>(s.change);
    const DiffLineClass cls = diff.line_class(s);
    const double length = length_of(diff.piece(s)) * static_cast<double>(s.to - s.from);
    add(diff.total.at(change), length);
    add(diff.by_class[{cls.kind, cls.state}].at(change), length);
    add(diff.by_object[cls.object].at(change), length);
    if (s.change == LineChange::gone && diff.far_after.contains(cls.object))
      add(diff.gone_left_out, length);
    if (s.change == LineChange::added && diff.far_before.contains(cls.object))
      add(diff.new_left_out, length);
  }
  std::erase_if(diff.by_object, [](const auto& of) {
    return std::all_of(of.second.begin() + 1, of.second.end(),
                       [](const LineCount& c) { return c.lines == 0; });
  });
}

}  // namespace

std::string_view change_name(LineChange change) {
  switch (change) {
    case LineChange::same:
      return "same";
    case LineChange::added:
      return "new";
    case LineChange::gone:
      return "gone";
    case LineChange::changed:
      return "changed";
  }
  return "";
}

DiffLineClass ViewDiff::line_class(const DiffInterval& s) const {
  return class_of(piece(s), s.change == LineChange::gone ? of_before : of_after);
}

bool ViewDiff::differs(bool visible_only) const {
  return std::ranges::any_of(intervals, [&](const DiffInterval& s) {
    if (s.change == LineChange::same) return false;
    return !visible_only || piece(s).state == drawing::LineState::visible ||
           (s.change == LineChange::changed && s.was.state == drawing::LineState::visible);
  });
}

Result<ViewDiff> compare(const ViewDocument& before, const ViewDocument& after,
                         const ViewDiffOptions& options, const parallel::Context& context) {
  if (!(options.tolerance_mm >= 0 && options.tolerance_mm <= kMaxToleranceMm))
    return Error{ErrorCode::usage, "the tolerance is not a length below a kilometre", "tolerance",
                 "2um is what rounding makes of one line"};
  ViewDiff diff;
  diff.before = &before;
  diff.after = &after;
  diff.tolerance_mm = options.tolerance_mm;
  diff.files = options.files;
  diff.settings = setting_changes(before, after);
  for (const ViewSettingChange& change : diff.settings)
    if (!may_differ(change.setting))
      return Error{ErrorCode::input,
                   "the drawings look from different sides: " + change.setting + " was " +
                       (change.before.empty() ? "absent" : change.before) + ", is " +
                       (change.after.empty() ? "absent" : change.after),
                   after.name, "compare drawings of one view"};
  number_objects(diff);
  report_far_objects(diff);
  const std::vector<ClassedPiece> pieces = classed(diff);
  if (pieces.size() >= 0xffffffffU)
    return Error{ErrorCode::input, "the drawings have too many lines to compare", after.name,
                 "compare drawings of parts of the model"};
  const std::vector<std::uint8_t> has_equal = find_equal_pieces(pieces);
  const auto covers = find_coverage(pieces, has_equal, options.tolerance_mm, context);
  if (!covers) return covers.error();
  make_diff_intervals(diff, pieces, has_equal, *covers);
  count(diff);
  return diff;
}

}  // namespace strake::report
