// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "strake/clash/options.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"

/// Clearances to which the objects of a pair add what they state as an attribute, as the thickness
/// of their insulation.
namespace strake::rules {

// The codes of warnings about clearances that get less than they request.
inline constexpr std::string_view kNotALength = "clearance-not-a-length",
                                  kNoSuchAttribute = "clearance-attribute-missing";

/// A clearance as written: "25mm", "@INSU", "@INSU + 25mm", "25mm + @'Insulation thickness'".
struct WrittenClearance {
  double mm = 0;
  std::string attribute;  ///< what both objects of a pair add; empty: nothing
};

/// Parses a clearance. Errors: usage, with how to write one.
[[nodiscard]] Result<WrittenClearance> parse_clearance(std::string_view text);

/// Returns what each object adds: the longest of the lengths that it states as the attribute or
/// inherits, 0 where it states none. Values that are no length from 0 to a kilometre add nothing
/// and are one warning of code kNotALength, at the first object that has one; that no object has
/// the attribute is one of code kNoSuchAttribute at `where`.
[[nodiscard]] std::shared_ptr<const clash::ObjectClearances> object_clearances(
    const model::Model& model, const std::string& attribute, const std::string& where,
    Diagnostics& diagnostics);

}  // namespace strake::rules
