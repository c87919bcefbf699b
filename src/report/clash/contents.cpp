// SPDX-License-Identifier: Apache-2.0
#include "report/clash/contents.hpp"

namespace strake::report {

std::optional<std::string> stated_text(const model::Model& model, model::ObjectId id,
                                       std::string_view attribute) {
  const model::Attributes* const stated = model.stated(model.object(id), attribute).attributes;
  if (stated == nullptr) return std::nullopt;
  std::optional<std::string> text;
  for (const auto& [name, value] : *stated) {
    if (name != attribute) continue;
    if (text)
      *text += "; " + value;
    else
      text = value;
  }
  return text;
}

}  // namespace strake::report
