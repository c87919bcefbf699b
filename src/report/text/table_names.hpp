// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strake::report {

// Names of objects are long, begin alike and differ at the end or in the middle. These functions
// make them shorter in such a way that no two of one table look alike that are not.

/// What a table writes for the path that all its names have in common.
inline constexpr std::string_view kLeadMark = "~";

/// Returns the groups that the paths of all names begin with, without the last '/': "/PS/WD1" of
/// "/PS/WD1/0010/M1" and "BOX 1 of STRUCTURE /PS/WD1/0015". A path is the rest of a name from the
/// first word that begins with '/', or a whole name with a '/' in it; names without one do not
/// count. Returns an empty text where that saves nothing, or where the mark stands in a name.
[[nodiscard]] std::string common_lead(std::span<const std::string_view> names);

/// Returns the name as it is shown: with the mark in place of the lead, and '?' for what is not
/// printable.
[[nodiscard]] std::string without_lead(std::string_view name, std::string_view lead);

/// Returns the texts, each that is wider than `columns` with its middle left out; where two that
/// differ would then look alike, both stay whole.
[[nodiscard]] std::vector<std::string> shorten_distinctly(const std::vector<std::string>& texts,
                                                          std::size_t columns);

}  // namespace strake::report
