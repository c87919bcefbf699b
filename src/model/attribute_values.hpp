// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "strake/model/model.hpp"

namespace strake::model {

// What attributes say. Blanks and quotes round a value do not count, and "", "Nulref",
// "unset", "none" and "=0/0" say that there is none. All views are into what is asked.

/// A value without the blanks and quotes round it.
[[nodiscard]] std::string_view bare(std::string_view text);

/// Whether a bare value says that there is none.
[[nodiscard]] bool says_none(std::string_view value);

/// The values of the attributes of this name, bare, without those that say that there is none.
[[nodiscard]] std::vector<std::string_view> values_of(const Attributes& attributes,
                                                      std::string_view attribute);
/// The same of an object, inherited ones too.
[[nodiscard]] std::vector<std::string_view> values_of(const Model& model, const Object& object,
                                                      std::string_view attribute);

/// The same of attributes that hold lists: what stands between separators counts as a value of its
/// own, with quotes of its own, within which separators do not part. Quotes may also stand round a
/// whole list. An empty separator: each value is one.
[[nodiscard]] std::vector<std::string_view> listed_values_of(const Attributes& attributes,
                                                             std::string_view attribute,
                                                             std::string_view separator);

}  // namespace strake::model
