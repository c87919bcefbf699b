// SPDX-License-Identifier: Apache-2.0
// The objects of a model and their attributes, as lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "strake/model/model.hpp"

namespace strake::cli {

/// Returns the first `limit` objects with the properties that selections test
/// (model::SelectableProperties), a block of lines each, and how many there are besides.
[[nodiscard]] std::string object_list_text(const model::Model& model, std::uint64_t limit);
/// Returns the same list as an array. An attribute is [name, value]: a name may occur several
/// times.
[[nodiscard]] nlohmann::ordered_json object_list_json(const model::Model& model,
                                                      std::uint64_t limit);

/// Returns the attributes that the objects of one file state or inherit, a line each: how many do,
/// how many different values there are, and the first of these.
[[nodiscard]] std::string attribute_list_text(const model::Model& model, std::size_t file);
/// Returns the same list as an array.
[[nodiscard]] nlohmann::ordered_json attribute_list_json(const model::Model& model,
                                                         std::size_t file);

}  // namespace strake::cli
