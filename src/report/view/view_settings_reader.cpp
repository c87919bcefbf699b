// SPDX-License-Identifier: Apache-2.0
#include "report/view/view_settings_reader.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "report/document/document_reader.hpp"
#include "report/json/json_reader.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::report {

namespace {

using geometry::Vec3l;
using Kind = JsonReader::Kind;

constexpr int kMaxSettingDepth = 4;
constexpr std::size_t kMaxViewSections = 16;

std::int64_t micrometres(double mm) {
  return static_cast<std::int64_t>(std::llround(mm * geometry::kGridPerMm));
}

/// One value of a section of a document.
class ViewSetting {
 public:
  ViewSetting(const std::map<std::string, std::string>& settings, std::string name)
      : name_(std::move(name)) {
    const auto found = settings.find(name_);
    if (found != settings.end()) text_ = found->second;
  }

  [[nodiscard]] bool is_there() const { return !text_.empty() && text_ != "null"; }

  /// Calls take(json, fields) where the value is there.
  template <class Take>
  auto read(Take&& take) const {
    std::istringstream in(text_);
    JsonReader json(in, kMaxSettingDepth);
    return take(json, DocumentFields(json));
  }
  [[nodiscard]] std::string text() const {
    must_be_there();
    return read(
        [this](JsonReader&, DocumentFields fields) { return fields.text("the document", name_); });
  }
  [[nodiscard]] double number() const {
    must_be_there();
    return read([this](JsonReader&, DocumentFields fields) {
      return fields.number("the document", name_);
    });
  }
  [[nodiscard]] Vec3l direction() const {
    must_be_there();
    return read([this](JsonReader&, DocumentFields fields) { return whole_vector(fields, name_); });
  }
  [[nodiscard]] bool is_false() const { return text_ == "false"; }
  [[nodiscard]] bool is_list() const { return text_.starts_with('['); }
  [[nodiscard]] const std::string& name() const { return name_; }

  [[nodiscard]] std::function<std::string()> where() const {
    return [name = name_] { return name; };
  }

  [[nodiscard]] static Vec3l whole_vector(DocumentFields fields, std::string_view key) {
    constexpr double kMaxOfDirection = 1U << 20U;
    const auto v = fields.numbers<3>([] { return std::string("the view"); }, key, kMaxOfDirection);
    for (const double component : v)
      if (component != std::floor(component))
        throw wrong_type("the view", key, "direction in whole numbers");
    return {static_cast<std::int64_t>(v[0]), static_cast<std::int64_t>(v[1]),
            static_cast<std::int64_t>(v[2])};
  }
  [[nodiscard]] static Vec3l point(DocumentFields fields, std::string_view key) {
    const auto mm =
        fields.numbers<3>([] { return std::string("the view"); }, key, DocumentFields::kFarthestMm);
    return {micrometres(mm[0]), micrometres(mm[1]), micrometres(mm[2])};
  }

 private:
  void must_be_there() const {
    if (!is_there()) throw missing_key("the document", name_);
  }

  std::string name_, text_;
};

/// Takes a value by its name; `other` where the document, an older one, does not say.
template <class Enum, class Name>
Enum value_of(const ViewSetting& setting, Name&& name, Enum other) {
  if (!setting.is_there()) return other;
  const auto value = enum_by_name<Enum>(setting.text(), name);
  if (!value) throw wrong_type("the document", setting.name(), "value that this version knows");
  return *value;
}

std::vector<hlr::Section> read_sections(JsonReader& json, DocumentFields fields) {
  fields.must_be(Kind::array, "the view", "sections", "list");
  std::vector<hlr::Section> sections;
  json.items([&] {
    fields.must_be(Kind::object, "the view", "sections", "list of planes");
    hlr::Section section;
    json.members([&](std::string_view key) {
      if (key == "normal")
        section.normal = ViewSetting::whole_vector(fields, "normal");
      else if (key == "point_mm")
        section.point = ViewSetting::point(fields, "point_mm");
      else
        json.skip();
    });
    if (sections.size() == kMaxViewSections)
      throw DocumentFault{"the view", "has more than 16 sections"};
    sections.push_back(section);
  });
  return sections;
}

hlr::Perspective read_perspective(JsonReader& json, DocumentFields fields) {
  fields.must_be(Kind::object, "the view", "perspective", "object");
  hlr::Perspective perspective;
  json.members([&](std::string_view key) {
    const std::string name(key);
    if (name == "eye_mm")
      perspective.eye = ViewSetting::point(fields, name);
    else if (name == "target_mm")
      perspective.target = ViewSetting::point(fields, name);
    else if (name == "near_mm")
      perspective.near_mm = fields.number("the view", name);
    else if (name == "field_of_view_deg")
      perspective.field_of_view_deg = fields.number("the view", name);
    else
      json.skip();
  });
  return perspective;
}

void read_uncut(const ViewSetting& setting, drawing::NeutralDrawing& drawing) {
  drawing.uncut = setting.is_there();
  if (!setting.is_list()) return;
  setting.read([&](JsonReader& json, DocumentFields fields) {
    json.items([&] { drawing.uncut_selections.push_back(fields.text("settings", "uncut")); });
  });
}

void read_limits(const ViewSetting& setting, hlr::View& view) {
  if (!setting.is_there()) return;
  setting.read([&](JsonReader&, DocumentFields fields) {
    const auto mm = fields.numbers<6>(setting.where(), "limits_mm", DocumentFields::kFarthestMm);
    view.limits = geometry::Box3l{{micrometres(mm[0]), micrometres(mm[1]), micrometres(mm[2])},
                                  {micrometres(mm[3]), micrometres(mm[4]), micrometres(mm[5])}};
  });
}

}  // namespace

void read_view_settings(const std::map<std::string, std::string>& settings,
                        drawing::NeutralDrawing& drawing) {
  const auto of = [&](const char* name) { return ViewSetting(settings, name); };
  drawing.view_name = of("view.name").text();
  hlr::View& view = drawing.view;
  view.direction = of("view.direction").direction();
  view.up = of("view.up").direction();
  read_limits(of("view.limits_mm"), view);
  if (const ViewSetting sections = of("view.sections"); sections.is_there())
    view.sections = sections.read(read_sections);
  if (const ViewSetting perspective = of("view.perspective"); perspective.is_there())
    view.perspective = perspective.read(read_perspective);
  drawing.stage = value_of(of("settings.stage"), drawing::stage_name, hlr::Stage::global);
  drawing.hidden_lines = !of("settings.hidden_lines").is_false();
  drawing.sharp_angle_deg = of("settings.sharp_angle_deg").number();
  drawing.smooth = value_of(of("settings.smooth"), drawing::smooth_name, hlr::Smooth::off);
  drawing.intersections = value_of(of("settings.intersections"), drawing::intersections_name,
                                   hlr::Intersections::primitives);
  drawing.own_polylines = value_of(of("settings.own_polylines"), drawing::own_polylines_name,
                                   hlr::OwnPolylines::visible);
  drawing.flush_seams = !of("settings.flush_seams").is_there();
  read_uncut(of("settings.uncut"), drawing);
  if (const ViewSetting diameter = of("settings.single_line_mm"); diameter.is_there())
    drawing.single_line_mm = diameter.number();
  drawing.contact_distance_mm = of("settings.contact_distance_mm").number();
  if (const ViewSetting sag = of("settings.sag_mm"); sag.is_there()) drawing.sag_mm = sag.number();
  if (const ViewSetting weld = of("settings.weld_mm"); weld.is_there())
    drawing.weld_mm = weld.number();
}

}  // namespace strake::report
