// SPDX-License-Identifier: Apache-2.0
#include "bcf/topics/ifc_guid.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/text_encoding.hpp"

namespace strake::bcf {

bool is_ifc_guid(std::string_view text) {
  constexpr std::string_view kDigits =
      "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
  constexpr std::size_t kLength = 22;
  return text.size() == kLength && text.find_first_not_of(kDigits) == std::string_view::npos &&
         text.front() >= '0' && text.front() <= '3';
}

std::string ifc_guid(const model::Model& model, const model::Object& object) {
  const auto stated = std::ranges::find(object.attributes, std::string_view("GlobalId"),
                                        &std::pair<std::string, std::string>::first);
  if (stated != object.attributes.end() && is_ifc_guid(stated->second)) return stated->second;
  if (!lowered(model.files[object.file].format).starts_with("ifc")) return {};
  const std::string id = object.id.substr(0, object.id.find('~'));
  return is_ifc_guid(id) ? id : std::string();
}

}  // namespace strake::bcf
