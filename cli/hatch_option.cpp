// SPDX-License-Identifier: Apache-2.0
#include "cli/hatch_option.hpp"

#include <string_view>
#include <utility>

#include "cli/select.hpp"
#include "strake/core/units.hpp"
#include "strake/drawing/hatching.hpp"

namespace strake::cli {

namespace {

Error fault(const std::string& message) {
  return {ErrorCode::usage, message, "--hatch",
          "write 30deg,80mm to hatch all sections so, '30deg: PIPE*' for those of some objects, or "
          "off"};
}

/// An angle or a length.
Status add_number(std::string_view text, hlr::Hatch& hatch) {
  const auto quantity = parse_quantity(text);
  const std::string quoted = "'" + std::string(text) + "'";
  if (!quantity) return fault(quoted + " is neither an angle nor a length");
  if (!unit_mm(quantity->unit)) {
    const Result<double> angle = parse_angle_deg(text);
    if (!angle) return fault(quoted + " is neither an angle nor a length");
    if (!(*angle >= 0 && *angle <= 180)) return fault(quoted + " is not between 0deg and 180deg");
    hatch.angle_deg = *angle;
    return {};
  }
  const Result<double> length = parse_length_mm(text);
  if (!length) return fault(length.error().message);
  if (!(*length > 0)) return fault(quoted + " is no distance between lines");
  hatch.spacing_mm = *length;
  return {};
}

Result<hlr::Hatch> parse_pattern(std::string_view text) {
  hlr::Hatch hatch;
  if (text == "off") {
    hatch.spacing_mm = 0;
    return hatch;
  }
  for (;;) {
    const std::size_t comma = text.find(',');
    if (const Status status = add_number(text.substr(0, comma), hatch); !status)
      return status.error();
    if (comma == std::string_view::npos) return hatch;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace

Result<std::vector<HatchRule>> parse_hatches(const std::vector<std::string>& texts) {
  std::vector<HatchRule> rules;
  for (const std::string& text : texts) {
    const std::size_t colon = text.find(':');
    const Result<hlr::Hatch> hatch = parse_pattern(std::string_view(text).substr(0, colon));
    if (!hatch) return hatch.error();
    rules.push_back({*hatch, std::nullopt});
    if (colon == std::string::npos) continue;
    auto selections = parse_selections({text.substr(colon + 1)}, "--hatch");
    if (!selections) return selections.error();
    rules.back().selection = std::move(selections->front());
  }
  return rules;
}

Result<std::vector<hlr::Hatch>> hatches_of(Session& session, const model::Scene& scene,
                                           const std::vector<HatchRule>& rules) {
  if (rules.empty()) return std::vector<hlr::Hatch>{};
  drawing::Hatching hatching(scene.model->objects.size());
  for (const HatchRule& rule : rules) {
    std::vector<bool> picked;
    if (rule.selection) {
      auto some = pick_any(session, scene, {*rule.selection}, "--hatch");
      if (!some) return some.error();
      picked = std::move(*some);
    }
    hatching.add(rule.hatch, picked);
  }
  return std::move(hatching).by_object();
}

}  // namespace strake::cli
