// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "strake/model/model.hpp"

namespace strake::cli {

/// Returns the attributes that the objects of one file state or inherit, a line each: how many do,
/// how many different values there are, and the first of these.
[[nodiscard]] std::string attribute_list_text(const model::Model& model, std::size_t file);
/// Returns the same list as an array.
[[nodiscard]] nlohmann::ordered_json attribute_list_json(const model::Model& model,
                                                         std::size_t file);

}  // namespace strake::cli
