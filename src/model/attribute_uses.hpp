// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/model/model.hpp"

namespace strake::model {

/// What objects state under one name, themselves or by the nearest group above that does.
struct AttributeUse {
  static constexpr std::size_t kMaxExamples = 3;

  std::string_view name;
  std::uint64_t objects = 0;               ///< that state it
  std::uint64_t values = 0;                ///< different ones among them
  std::vector<std::string_view> examples;  ///< the first different values, in the order of objects
};

/// Returns the attributes of the objects of files `from` <= number < `to`, by name. Views are into
/// the model.
[[nodiscard]] std::vector<AttributeUse> attribute_uses(const Model& model, std::size_t from,
                                                       std::size_t to);

/// Says that no object states an attribute, with the names that are spelt most like it, or that
/// most objects state.
[[nodiscard]] std::string no_object_states(std::string_view name,
                                           std::span<const AttributeUse> uses);

}  // namespace strake::model
