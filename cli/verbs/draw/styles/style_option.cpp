// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/styles/style_option.hpp"

#include <fmt/core.h>

#include <utility>

#include "cli/run/object_selection.hpp"

namespace strake::cli {

namespace {

Error in_style_option(Error error) {
  error.where = "--style";
  return error;
}

Result<StyleRule> read_style(const std::string& text) {
  auto parsed = drawing::parse_style(text);
  if (!parsed) return in_style_option(parsed.error());
  auto selections = parse_selections({parsed->selection}, "--style");
  if (!selections) return selections.error();
  return StyleRule{std::move(parsed->style), std::move(selections->front())};
}

}  // namespace

Result<std::vector<StyleRule>> parse_styles(const std::vector<std::string>& texts) {
  if (texts.size() > drawing::kMaxObjectStyles)
    return Error{ErrorCode::usage, fmt::format("{} styles are more than 1000", texts.size()),
                 "--style", "give those that are seen"};
  std::vector<StyleRule> rules;
  for (const std::string& text : texts) {
    Result<StyleRule> rule = read_style(text);
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
