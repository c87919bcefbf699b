// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/styles/style_option.hpp"

#include <fmt/core.h>

#include <string_view>
#include <utility>

#include "cli/run/object_selection.hpp"
#include "core/text_encoding.hpp"

namespace strake::cli {

namespace {

Error fault_of_style(std::string message, std::string mend = {}) {
  if (mend.empty())
    mend =
        "write 'color=#c00000: PIPE*', with name=, pen=0.35mm and line=dashed as you like, parted "
        "by commas";
  return {ErrorCode::usage, std::move(message), "--style", std::move(mend)};
}

/// Takes a value that a function of drawings reads into a part of a style.
template <class T>
Status take_part(std::optional<T>& into, std::string_view value,
                 Result<T> (*parse)(std::string_view)) {
  const Result<T> parsed = parse(value);
  if (!parsed) return fault_of_style(parsed.error().message, parsed.error().mend);
  if (into) return fault_of_style(in_quotes(value) + " comes again");
  into = *parsed;
  return {};
}

Status add_part(std::string_view part, drawing::ObjectStyle& style) {
  const std::size_t equals = part.find('=');
  const std::string_view key = trimmed(part.substr(0, equals));
  if (equals == std::string_view::npos)
    return fault_of_style(in_quotes(part) + " is no part of a style");
  const std::string_view value = trimmed(part.substr(equals + 1));
  if (key == "color") return take_part(style.color, value, drawing::parse_color);
  if (key == "pen") return take_part(style.pen_mm, value, drawing::parse_pen_mm);
  if (key == "line") return take_part(style.line, value, drawing::parse_line_type);
  if (key != "name") return fault_of_style("a style has no " + in_quotes(key));
  if (!style.name.empty()) return fault_of_style(in_quotes(value) + " comes again");
  style.name = printable(value);
  return {};
}

Result<StyleRule> parse_style(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
    return fault_of_style(in_quotes(text) + " does not say whose lines it is for");
  drawing::ObjectStyle style;
  for (std::string_view rest = std::string_view(text).substr(0, colon);;) {
    const std::size_t comma = rest.find(',');
    if (const Status status = add_part(rest.substr(0, comma), style); !status)
      return status.error();
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  auto selections = parse_selections({std::string(trimmed(text.substr(colon + 1)))}, "--style");
  if (!selections) return selections.error();
  return StyleRule{std::move(style), std::move(selections->front())};
}

}  // namespace

Result<std::vector<StyleRule>> parse_styles(const std::vector<std::string>& texts) {
  if (texts.size() > drawing::kMostObjectStyles)
    return fault_of_style(fmt::format("{} styles are more than 1000", texts.size()),
                          "give those that are seen");
  std::vector<StyleRule> rules;
  for (const std::string& text : texts) {
    Result<StyleRule> rule = parse_style(text);
    if (!rule) return rule.error();
    rules.push_back(std::move(*rule));
  }
  return rules;
}

Result<std::shared_ptr<const drawing::ObjectStyles>> styles_of(
    Session& session, const model::Scene& scene, const std::vector<StyleRule>& rules) {
  if (rules.empty()) return std::shared_ptr<const drawing::ObjectStyles>();
  drawing::ObjectStyles styles(scene.model->objects.size());
  for (const StyleRule& rule : rules) {
    const auto picked = pick_any(session, scene, {rule.selection}, "--style");
    if (!picked) return picked.error();
    styles.add(rule.style, *picked);
  }
  return std::make_shared<const drawing::ObjectStyles>(std::move(styles));
}

}  // namespace strake::cli
