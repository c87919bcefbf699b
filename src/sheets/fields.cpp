// SPDX-License-Identifier: Apache-2.0
#include "sheets/fields.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "drawing/paper.hpp"
#include "sheets/frame.hpp"
#include "sheets/lettering.hpp"
#include "strake/drawing/write.hpp"

namespace strake::sheets {

namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What the fields of a sheet hold.
class Fields {
 public:
  Fields(const Description& what, double scale) : values_(what.fields) {
    const auto own = [&](std::string name, std::string value) {
      if (find(name) != nullptr) return;
      values_.emplace_back(std::move(name), std::move(value));
    };
    own("scale", drawing::scale_text(scale));
    own("size", what.size);
    const bool arranged = std::any_of(what.views.begin(), what.views.end(),
                                      [](const ViewWish& v) { return v.slot != Slot::none; });
    if (arranged)
      own("projection", what.projection == Projection::first_angle ? "first angle" : "third angle");
  }

  [[nodiscard]] const std::string* find(const std::string& name) const {
    for (const auto& [key, value] : values_)
      if (key == name) return &value;
    return nullptr;
  }
  [[nodiscard]] std::string text(const std::string& name) const {
    const std::string* const value = find(name);
    return value != nullptr ? on_one_line(*value) : std::string();
  }

  /// Names fields of the frame without a value, and values without a field.
  void compare(const std::vector<std::string>& places, const std::string& frame,
               const Description& what, Diagnostics& diagnostics) const {
    std::vector<std::string> empty, idle;
    for (const std::string& name : places)
      if (find(name) == nullptr) empty.push_back(name);
    for (const auto& field : what.fields)
      if (!contains(places, field.first)) idle.push_back(field.first);
    const std::string where = what.fields_where.empty() ? what.file : what.fields_where;
    if (!empty.empty())
      diagnostics.add(Severity::warning, "field-not-filled",
                      frame + " has fields that are not given: " + listed(empty), where);
    if (!idle.empty())
      diagnostics.add(
          Severity::warning, "field-not-in-template",
          frame + " has no place for " + listed(idle) + "; its fields are " + listed(places),
          where);
  }

 private:
  std::vector<std::pair<std::string, std::string>> values_;
};

}  // namespace

void fill_frame(const Description& what, double scale, Sheet& sheet) {
  const Fields fields(what, scale);
  const auto text = [&](const std::string& name) { return fields.text(name); };
  sheet.title = text("title");
  if (sheet.title.empty()) sheet.title = what.views.front().title;
  if (what.artwork) {
    fields.compare(what.artwork->fields(), "the template", what, sheet.diagnostics);
    const auto escaped = [&](const std::string& name) { return drawing::xml_escaped(text(name)); };
    sheet.artwork = Sheet::Template{what.artwork->view_box, filled(what.artwork->pieces, escaped)};
    return;
  }
  if (!what.frame) {
    fields.compare({}, "a sheet without frame", what, sheet.diagnostics);
    return;
  }
  fields.compare(title_block_fields(), "the title block", what, sheet.diagnostics);
  std::vector<std::string> narrow;
  sheet.frame = draw_frame(what, text, &narrow);
  if (!narrow.empty())
    sheet.diagnostics.add(Severity::warning, "field-too-long",
                          "texts are longer than their boxes: " + listed(narrow),
                          what.fields_where);
}

}  // namespace strake::sheets
