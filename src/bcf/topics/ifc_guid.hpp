// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "strake/model/model.hpp"

namespace strake::bcf {

/// Whether a text is a GlobalId: 128 bits in 22 digits, of which the first has two.
[[nodiscard]] bool is_ifc_guid(std::string_view text);

/// Returns the GlobalId of an element of IFC, 22 characters; empty for anything else.
[[nodiscard]] std::string ifc_guid(const model::Model& model, const model::Object& object);

}  // namespace strake::bcf
