// SPDX-License-Identifier: Apache-2.0
#include "sheets/compose_labels.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "sheets/labels/balloons.hpp"
#include "sheets/labels/tags.hpp"
#include "sheets/labels/write_labels.hpp"

namespace strake::sheets {

namespace {

constexpr const char* kRoomMend = " (smaller letters, fewer tags or a larger sheet make room)";

/// Reports labels that a sheet lacks.
class LabelDiagnostics {
 public:
  LabelDiagnostics(const SheetSpec& what, std::span<const std::vector<bool>> picked, Sheet& sheet)
      : what_(what), picked_(picked), sheet_(sheet) {}

  /// Reports the tags of all tables, whose lists come table by table.
  void report(const std::vector<TagList>& lists) {
    auto list = lists.begin();
    for (std::size_t t = 0; t < what_.tags.size(); ++t) {
      const TagSpec& tag = what_.tags[t];
      const auto picked = static_cast<std::size_t>(std::ranges::count(picked_[t], true));
      bool is_visible = false;
      for (; list != lists.end() && list->spec == &tag; ++list) {
        report(*list);
        is_visible = is_visible || list->count.unseen < picked;
      }
      if (!is_visible && picked > 0)
        warn("tag-not-seen",
             "none of the objects of '" + tag.select->selection.text() + "' is seen in a view",
             tag.where);
    }
  }

  void report(const BalloonList& list) {
    report_rows(list, list.unseen, "balloon-not-seen",
                "no view shows an object of it (name views that do, or leave views out)",
                "no view shows objects of them (name views that do, or leave views out)");
    report_rows(
        list, list.crowded, "balloon-no-room",
        "there is no room for it (a smaller size, another side or a larger sheet make room)",
        "there is no room for them (a smaller size, another side or a larger sheet make "
        "room)");
  }

 private:
  void warn(std::string_view code, std::string message, std::string where) {
    sheet_.diagnostics.add(Severity::warning, code, std::move(message), std::move(where));
  }

  void report(const TagList& list) {
    const TagCount& count = list.count;
    const std::string where =
        list.spec->where + ", the view '" + sheet_.views[list.view].name + "'";
    const auto report = [&](std::size_t number, const char* code, const std::string& one,
                            const std::string& many) {
      if (number == 1) warn(code, "1 object " + one, where);
      if (number > 1) warn(code, std::to_string(number) + " objects " + many, where);
    };
    const std::string some = " some of what '" + list.spec->text + "' names";
    report(count.blank, "tag-attribute-missing", "has nothing to be tagged with",
           "have nothing to be tagged with");
    report(count.partly, "tag-attribute-partly-missing", "lacks" + some, "lack" + some);
    const std::string& text = count.first_too_short;
    note_of(count.too_short, "tag-not-along",
            "has its tag '" + text + "' at a leader: no straight part of it has room for the text",
            "have their tags, as '" + text +
                "', at leaders: no straight part of them has room for the text",
            where);
    report(count.crowded, "tag-no-room",
           "is without its tag '" + count.first_crowded + "': there is no room for it" + kRoomMend,
           "are without their tags, as '" + count.first_crowded + "': there is no room for them" +
               kRoomMend);
  }

  /// Tells of what is as good as what was requested.
  void note_of(std::size_t number, const char* code, const std::string& one,
               const std::string& many, const std::string& where) {
    if (number == 0) return;
    sheet_.diagnostics.add(
        Severity::note, code,
        number == 1 ? "1 object " + one : std::to_string(number) + " objects " + many, where);
  }

  /// Tells of rows of a list that have no balloon, and why: of one, or of several.
  void report_rows(const BalloonList& list, const std::vector<std::string>& rows, const char* code,
                   const std::string& one, const std::string& many) {
    if (rows.empty()) return;
    constexpr std::size_t kMaxNamed = 10;
    std::string numbers;
    for (std::size_t r = 0; r < std::min(rows.size(), kMaxNamed); ++r)
      numbers += (r == 0 ? "" : ", ") + rows[r];
    if (rows.size() > kMaxNamed) numbers += " and others";
    warn(code,
         rows.size() == 1
             ? "POS " + numbers + " has no balloon: " + one
             : std::to_string(rows.size()) + " rows have no balloons, POS " + numbers + ": " + many,
         list.spec->where);
  }

  const SheetSpec& what_;
  std::span<const std::vector<bool>> picked_;
  Sheet& sheet_;
};

}  // namespace

Status compose_labels(const SheetSpec& what, const model::Model& model,
                      std::span<const std::vector<bool>> picked, const Notes& notes,
                      const SheetArea& room, Sheet& sheet, const parallel::Context& context) {
  SheetLabels labels;
  for (std::size_t t = 0; t < what.tags.size(); ++t)
    for (std::size_t v = 0; v < sheet.views.size(); ++v)
      if (const std::vector<std::string>& views = what.tags[t].views;
          views.empty() || std::ranges::find(views, sheet.views[v].name) != views.end())
        labels.tags.push_back(tags_of(what.tags[t], picked[t], model, sheet, v));
  for (std::size_t l = 0; l < what.parts_lists.size(); ++l)
    if (what.parts_lists[l].balloons)
      labels.balloons.push_back(
          balloons_of(what.parts_lists[l], notes.listed[l], model.objects.size(), sheet));
  if (const Status status = write_labels(labels, model, room, sheet, context.stop); !status)
    return status;
  LabelDiagnostics diagnostics(what, picked, sheet);
  diagnostics.report(labels.tags);
  for (const BalloonList& list : labels.balloons) diagnostics.report(list);
  return {};
}

}  // namespace strake::sheets
