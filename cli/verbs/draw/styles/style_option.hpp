// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/run/session.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/object_styles.hpp"
#include "strake/model/scene.hpp"
#include "strake/model/selection.hpp"

/// The option of `draw` for colours, pens and types of lines of some objects.
namespace strake::cli {

/// A style, and whose lines it is for.
struct StyleRule {
  drawing::ObjectStyle style;
  model::Selection selection;
};

/// Parses texts as drawing::parse_style() does. Errors name --style.
[[nodiscard]] Result<std::vector<StyleRule>> parse_styles(const std::vector<std::string>& texts);

/// Returns the styles of the objects of the scene; null without rules. Errors: a selection that
/// picks nothing.
[[nodiscard]] Result<std::shared_ptr<const drawing::ObjectStyles>> styles_of(
    Session& session, const model::Scene& scene, const std::vector<StyleRule>& rules);

}  // namespace strake::cli
