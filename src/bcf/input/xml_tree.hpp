// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pugixml.hpp>
#include <string>

#include "strake/core/result.hpp"

namespace strake::bcf {

/// Reads XML of any encoding that says which it is. A document type is passed over: no entity is
/// declared or expanded, nothing else is opened. Errors: input, with `where` as the place.
[[nodiscard]] Status read_xml(pugi::xml_document& document, const std::string& text,
                              const std::string& where);

/// Returns the child of that name, whatever its prefix; an empty node where there is none.
[[nodiscard]] pugi::xml_node child(const pugi::xml_node& node, const char* name);

/// Whether a node is an element of that name, whatever its prefix.
[[nodiscard]] bool is_called(const pugi::xml_node& node, const char* name);

/// Returns all text of the child of that name, or of an attribute, as UTF-8.
[[nodiscard]] std::string child_text(const pugi::xml_node& node, const char* name);
[[nodiscard]] std::string attribute_text(const pugi::xml_node& node, const char* name);

}  // namespace strake::bcf
