// SPDX-License-Identifier: Apache-2.0
#include "sheets/output/artwork/svg_style.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/text_encoding.hpp"
#include "sheets/output/artwork/svg_geometry.hpp"

namespace strake::sheets {

namespace {

constexpr std::string_view kSpace = " \t\r\n";

/// Calls f(part) for the parts between separators, without blanks at either end.
template <class F>
void for_each_part(std::string_view text, char separator, F&& f) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    if (const std::string_view part = trimmed(text.substr(0, end), kSpace); !part.empty()) f(part);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

struct NamedColor {
  std::string_view name;
  model::Color color;
};
constexpr std::array<NamedColor, 22> kColors{{
    {"black", {0, 0, 0, 255}},          {"white", {255, 255, 255, 255}},
    {"red", {255, 0, 0, 255}},          {"green", {0, 128, 0, 255}},
    {"blue", {0, 0, 255, 255}},         {"gray", {128, 128, 128, 255}},
    {"grey", {128, 128, 128, 255}},     {"silver", {192, 192, 192, 255}},
    {"maroon", {128, 0, 0, 255}},       {"purple", {128, 0, 128, 255}},
    {"fuchsia", {255, 0, 255, 255}},    {"magenta", {255, 0, 255, 255}},
    {"lime", {0, 255, 0, 255}},         {"olive", {128, 128, 0, 255}},
    {"yellow", {255, 255, 0, 255}},     {"navy", {0, 0, 128, 255}},
    {"teal", {0, 128, 128, 255}},       {"aqua", {0, 255, 255, 255}},
    {"cyan", {0, 255, 255, 255}},       {"orange", {255, 165, 0, 255}},
    {"darkgray", {169, 169, 169, 255}}, {"currentcolor", {0, 0, 0, 255}},
}};

std::optional<std::uint8_t> hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<std::uint8_t>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<std::uint8_t>(c - 'a' + 10);
  return std::nullopt;
}

std::optional<model::Color> hex_color(std::string_view digits) {
  if (digits.size() != 3 && digits.size() != 6) return std::nullopt;
  const std::size_t width = digits.size() / 3;
  std::array<std::uint8_t, 3> parts{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto first = hex_digit(digits[i * width]), last = hex_digit(digits[(i + 1) * width - 1]);
    if (!first || !last) return std::nullopt;
    parts.at(i) = static_cast<std::uint8_t>(*first * 16 + *last);
  }
  return model::Color{parts[0], parts[1], parts[2], 255};
}

std::optional<model::Color> paint_color(std::string_view value) {
  const std::string lower = lowered(value);
  const std::string_view text(lower);
  if (text.starts_with('#')) return hex_color(text.substr(1));
  if (text.starts_with("rgb(") && text.ends_with(')')) {
    const auto n = svg_numbers(text.substr(4, text.size() - 5));
    if (!n || n->size() != 3) return std::nullopt;
    const auto part = [](double v) {
      return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 255.0)));
    };
    return model::Color{part((*n)[0]), part((*n)[1]), part((*n)[2]), 255};
  }
  const auto found = std::ranges::find(kColors, text, &NamedColor::name);
  return found == kColors.end() ? std::nullopt : std::optional(found->color);
}

/// Returns the place of a word among some; nothing where it is none of them.
template <std::size_t N>
std::optional<int> place_among(const std::array<std::string_view, N>& words,
                               std::string_view word) {
  const auto found = std::ranges::find(words, word);
  if (found == words.end()) return std::nullopt;
  return static_cast<int>(found - words.begin());
}

class StyleReader {
 public:
  StyleReader(SvgStyle& style, ReportUnsupported report) : style_(style), report_(report) {}

  /// Takes what a property says; what is said of other things than painting is no affair of ours.
  void take(std::string_view property, std::string_view value) {
    value = trimmed(value, kSpace);
    if (value == "inherit") return;
    std::optional<bool> taken = take_paint(property, value);
    if (!taken) taken = take_line(property, value);
    if (!taken) taken = take_rest(property, value);
    if (!*taken) report_(std::string(property) + ": " + std::string(value.substr(0, 40)));
  }

 private:
  // Each returns whether the value is understood, and nothing where the property is not its own.
  std::optional<bool> take_paint(std::string_view property, std::string_view value) {
    const bool fill = property == "fill";
    if (!fill && property != "stroke") return std::nullopt;
    std::optional<model::Color>& paint = fill ? style_.fill : style_.stroke;
    if (value == "none" || value == "transparent") {
      paint.reset();
      return true;
    }
    if (fill && lowered(value).starts_with("url(")) {
      // An area with a gradient is left out, or has the colour for those who know none.
      const std::size_t end = value.find(')');
      paint = end == std::string_view::npos ? std::nullopt
                                            : paint_color(trimmed(value.substr(end + 1), kSpace));
      return false;
    }
    const auto color = paint_color(value);
    if (color) paint = *color;
    return color.has_value();
  }

  std::optional<bool> take_line(std::string_view property, std::string_view value) {
    constexpr std::array<std::string_view, 3> kCaps{"butt", "round", "square"};
    constexpr std::array<std::string_view, 3> kJoins{"miter", "round", "bevel"};
    if (property == "stroke-width") return length(value, style_.stroke_width);
    if (property == "stroke-miterlimit") return length(value, style_.miter_limit);
    if (property == "stroke-linecap") return place(place_among(kCaps, value), style_.cap);
    if (property == "stroke-linejoin") return place(place_among(kJoins, value), style_.join);
    if (property != "stroke-dasharray") return std::nullopt;
    style_.dashes.clear();
    if (value == "none") return true;
    bool good = true;
    std::string list(value);
    std::ranges::replace(list, ',', ' ');
    for_each_part(list, ' ', [&](std::string_view part) {
      const auto dash = svg_length(part);
      good = good && dash && *dash >= 0;
      if (good) style_.dashes.push_back(*dash);
    });
    double sum = 0;
    for (const double dash : style_.dashes) sum += dash;
    if (!good || sum <= 0) style_.dashes.clear();
    return good;
  }

  bool take_rest(std::string_view property, std::string_view value) {
    constexpr std::array<std::string_view, 3> kAnchors{"start", "middle", "end"};
    if (property == "font-size") return length(value, style_.font_size);
    if (property == "text-anchor") {
      const auto found = place_among(kAnchors, value);
      if (found) style_.anchor = static_cast<Align>(*found);
      return found.has_value();
    }
    if (property == "fill-rule") {
      style_.even_odd = value == "evenodd";
      return true;
    }
    if (property == "display" || property == "visibility") {
      if (value == "none" || value == "hidden" || value == "collapse") style_.shown = false;
      return true;
    }
    // What would be seen through, cut off or decorated.
    if (property == "clip-path" || property == "mask" || property == "filter" ||
        property.starts_with("marker"))
      return value == "none";
    if (property.ends_with("opacity")) {
      const auto numbers = svg_numbers(value);
      return numbers && numbers->size() == 1 && numbers->front() >= 1;
    }
    return true;
  }

  static bool length(std::string_view value, double& into) {
    const auto found = svg_length(value);
    if (!found || *found < 0) return false;
    into = *found;
    return true;
  }
  static bool place(std::optional<int> found, int& into) {
    if (found) into = *found;
    return found.has_value();
  }

  SvgStyle& style_;
  ReportUnsupported report_;
};

void take_declarations(StyleReader& reader, std::string_view declarations) {
  for_each_part(declarations, ';', [&](std::string_view declaration) {
    const std::size_t colon = declaration.find(':');
    if (colon == std::string_view::npos) return;
    std::string_view value = trimmed(declaration.substr(colon + 1), kSpace);
    if (const std::size_t mark = value.find('!'); mark != std::string_view::npos)
      value = trimmed(value.substr(0, mark), kSpace);
    reader.take(lowered(trimmed(declaration.substr(0, colon), kSpace)), value);
  });
}

}  // namespace

bool StyleSheet::Rule::picks(const SvgElement& element) const {
  if (!name.empty() && name != element.name) return false;
  if (!id.empty() && id != element.value("id")) return false;
  if (class_name.empty()) return true;
  bool found = false;
  for_each_part(element.value("class"), ' ',
                [&](std::string_view one) { found = found || one == class_name; });
  return found;
}

void StyleSheet::add(std::string_view css, ReportUnsupported report) {
  std::string text(css);
  for (std::size_t at = text.find("/*"); at != std::string::npos; at = text.find("/*", at)) {
    const std::size_t end = text.find("*/", at + 2);
    text.replace(at, end == std::string::npos ? end : end + 2 - at, " ");
  }
  for_each_part(text, '}', [&](std::string_view rule) {
    const std::size_t open = rule.find('{');
    if (open == std::string_view::npos) return;
    for_each_part(rule.substr(0, open), ',', [&](std::string_view selector) {
      add_rule(selector, rule.substr(open + 1), report);
    });
  });
  std::sort(rules_.begin(), rules_.end(), [](const Rule& a, const Rule& b) {
    return std::tie(a.weight, a.order) < std::tie(b.weight, b.order);
  });
}

void StyleSheet::add_rule(std::string_view selector, std::string_view declarations,
                          ReportUnsupported report) {
  Rule rule{{}, {}, {}, std::string(declarations), 0, rules_.size()};
  const std::size_t mark = std::min(selector.find_first_of(".#"), selector.size());
  rule.name = selector.substr(0, mark);
  if (rule.name == "*") rule.name.clear();
  if (mark < selector.size())
    (selector[mark] == '.' ? rule.class_name : rule.id) = selector.substr(mark + 1);
  const std::string rest = rule.name + rule.class_name + rule.id;
  if (rest.find_first_of(" >+~:[.#*@") != std::string::npos) {
    report("the style of " + in_quotes(selector.substr(0, 40)));
    return;
  }
  // Each element asks each rule.
  constexpr std::size_t kMaxRules = 1000;
  if (rules_.size() == kMaxRules) {
    report("the styles beyond the first 1000");
    return;
  }
  rule.weight = !rule.id.empty() ? 100U : !rule.class_name.empty() ? 10U : 0U;
  if (!rule.name.empty()) ++rule.weight;
  rules_.push_back(std::move(rule));
}

SvgStyle StyleSheet::style_of(const SvgElement& element, const SvgStyle& parent,
                              ReportUnsupported report) const {
  SvgStyle style = parent;
  StyleReader reader(style, report);
  for (const auto& [key, value] : element.attributes)
    if (key != "style") reader.take(key, value);
  for (const Rule& rule : rules_)
    if (rule.picks(element)) take_declarations(reader, rule.declarations);
  take_declarations(reader, element.value("style"));
  return style;
}

}  // namespace strake::sheets
