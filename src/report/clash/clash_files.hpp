// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "report/files/file_map.hpp"
#include "strake/report/clash_document.hpp"
#include "strake/report/file_match.hpp"

namespace strake::report {

/// Whether an element is in a run and its id there is only a position.
[[nodiscard]] bool is_positional(const ClashDocument& run, std::uint64_t element);

/// Returns a name without its numbers: "node 12" and "node 7" are one.
[[nodiscard]] std::string without_numbers(std::string_view name);

/// The map of the objects of two runs; all three must outlive it.
[[nodiscard]] FileMap map_of(const FileMatches& files, const ClashDocument& before,
                             const ClashDocument& after);

}  // namespace strake::report
