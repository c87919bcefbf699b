// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/view_settings.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace strake::cli {

namespace {

using Json = nlohmann::ordered_json;

/// An option and where its value lies.
template <class Value>
struct ViewOption {
  std::string_view name;
  Value& (*of)(DrawOptions& options);
};

using Text = ViewOption<std::string>;
using List = ViewOption<std::vector<std::string>>;

/// Those that decide which lines there are.
constexpr std::array kTextsOfLines{
    Text{"view", [](DrawOptions& o) -> std::string& { return o.view; }},
    Text{"direction", [](DrawOptions& o) -> std::string& { return o.direction; }},
    Text{"eye", [](DrawOptions& o) -> std::string& { return o.perspective.eye; }},
    Text{"target", [](DrawOptions& o) -> std::string& { return o.perspective.target; }},
    Text{"near", [](DrawOptions& o) -> std::string& { return o.perspective.near; }},
    Text{"field-of-view",
         [](DrawOptions& o) -> std::string& { return o.perspective.field_of_view; }},
    Text{"up", [](DrawOptions& o) -> std::string& { return o.up; }},
    Text{"limits", [](DrawOptions& o) -> std::string& { return o.limits; }},
    Text{"stage", [](DrawOptions& o) -> std::string& { return o.stage; }},
    Text{"intersections", [](DrawOptions& o) -> std::string& { return o.intersections; }},
    Text{"own-polylines", [](DrawOptions& o) -> std::string& { return o.own_polylines; }},
    Text{"smooth", [](DrawOptions& o) -> std::string& { return o.smooth; }},
    Text{"single-line", [](DrawOptions& o) -> std::string& { return o.single_line; }},
    Text{"flush-seams", [](DrawOptions& o) -> std::string& { return o.flush_seams; }},
    Text{"sharp-angle", [](DrawOptions& o) -> std::string& { return o.sharp_angle; }},
    Text{"contact-distance", [](DrawOptions& o) -> std::string& { return o.contact_distance; }},
    Text{"sag", [](DrawOptions& o) -> std::string& { return o.scene.sag; }},
    Text{"weld", [](DrawOptions& o) -> std::string& { return o.scene.weld; }},
};

constexpr std::array kTextsOfSheet{
    Text{"hidden", [](DrawOptions& o) -> std::string& { return o.hidden; }},
    Text{"hidden-layers", [](DrawOptions& o) -> std::string& { return o.hidden_layers; }},
    Text{"centre-lines", [](DrawOptions& o) -> std::string& { return o.centre_lines; }},
    Text{"break-lines", [](DrawOptions& o) -> std::string& { return o.break_lines; }},
    Text{"thin", [](DrawOptions& o) -> std::string& { return o.thin; }},
    Text{"scale", [](DrawOptions& o) -> std::string& { return o.scale; }},
    Text{"paper", [](DrawOptions& o) -> std::string& { return o.paper; }},
    Text{"title", [](DrawOptions& o) -> std::string& { return o.title; }},
};

constexpr std::array kListsOfSheet{
    List{"style", [](DrawOptions& o) -> std::vector<std::string>& { return o.styles; }},
};

/// Those that say how lines are found; the lines are the same.
constexpr std::array kTextsOfWork{
    Text{"solver", [](DrawOptions& o) -> std::string& { return o.solver; }},
    Text{"global", [](DrawOptions& o) -> std::string& { return o.global; }},
    Text{"culling", [](DrawOptions& o) -> std::string& { return o.culling; }},
    Text{"bucketing", [](DrawOptions& o) -> std::string& { return o.bucketing; }},
};

constexpr std::array kLists{
    List{"select", [](DrawOptions& o) -> std::vector<std::string>& { return o.select; }},
    List{"section", [](DrawOptions& o) -> std::vector<std::string>& { return o.sections; }},
    List{"uncut", [](DrawOptions& o) -> std::vector<std::string>& { return o.uncut; }},
    List{"hatch", [](DrawOptions& o) -> std::vector<std::string>& { return o.hatches; }},
};

/// Those that say themselves which lines there are.
constexpr std::array kListsOfWork{
    List{"sheet", [](DrawOptions& o) -> std::vector<std::string>& { return o.sheets; }},
};

using Flag = ViewOption<bool>;
constexpr std::array kFlags{
    Flag{"visible-only", [](DrawOptions& o) -> bool& { return o.visible_only; }},
    Flag{"obstructions", [](DrawOptions& o) -> bool& { return o.scene.obstructions; }},
    Flag{"insulation", [](DrawOptions& o) -> bool& { return o.scene.insulation; }},
};

/// Takes a value into the option of that name among some; false where none has it, or the value is
/// of another kind.
template <class Settings>
bool take(const Settings& settings, const std::string& name, const Json& value,
          DrawOptions& options) {
  for (const auto& setting : settings) {
    if (setting.name != name) continue;
    auto& into = setting.of(options);
    using Value = std::remove_reference_t<decltype(into)>;
    if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
      if (!value.is_array()) return false;
      for (const Json& item : value) {
        const auto* const text = item.template get_ptr<const Json::string_t*>();
        if (text == nullptr) return false;
        into.push_back(*text);
      }
    } else {
      const auto* const there = value.template get_ptr<const Value*>();
      if (there == nullptr) return false;
      into = *there;
    }
    return true;
  }
  return false;
}

}  // namespace

std::string settings_text(const DrawOptions& given) {
  DrawOptions options = given;
  Json settings = Json::object();
  const auto put = [&](const auto& some) {
    for (const auto& setting : some) {
      const auto& value = setting.of(options);
      if (value != std::remove_cvref_t<decltype(value)>{})
        settings[std::string(setting.name)] = value;
    }
  };
  put(kTextsOfLines);
  put(kLists);
  put(kFlags);
  put(kTextsOfSheet);
  put(kListsOfSheet);
  return settings.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<DrawOptions> parse_settings(std::string_view text, const std::string& where) {
  const Json settings = Json::parse(text, nullptr, false);
  if (!settings.is_object())
    return Error{ErrorCode::input, "its options are no JSON object", where, "save the view again"};
  DrawOptions options;
  for (const auto& [name, value] : settings.items())
    if (!take(kTextsOfLines, name, value, options) && !take(kLists, name, value, options) &&
        !take(kFlags, name, value, options) && !take(kTextsOfSheet, name, value, options) &&
        !take(kListsOfSheet, name, value, options))
      return Error{ErrorCode::input,
                   "its option '" + name + "' is none that this version knows, or has no value",
                   where, "save the view again"};
  return options;
}

std::string first_option_of_lines(const DrawOptions& given) {
  DrawOptions options = given;
  std::string first;
  const auto find_in = [&](const auto& some) {
    for (const auto& setting : some) {
      const auto& value = setting.of(options);
      if (first.empty() && value != std::remove_cvref_t<decltype(value)>{})
        first = "--" + std::string(setting.name);
    }
  };
  find_in(kTextsOfLines);
  find_in(kLists);
  find_in(kFlags);
  find_in(kTextsOfWork);
  find_in(kListsOfWork);
  return first;
}

void put_on_sheet_of(const DrawOptions& given, DrawOptions& view) {
  DrawOptions options = given;  // NOLINT(misc-const-correctness): texts are moved out of it
  for (const Text& setting : kTextsOfSheet)
    if (std::string& text = setting.of(options); !text.empty()) setting.of(view) = std::move(text);
  for (const List& setting : kListsOfSheet)
    if (auto& list = setting.of(options); !list.empty()) setting.of(view) = std::move(list);
}

}  // namespace strake::cli
