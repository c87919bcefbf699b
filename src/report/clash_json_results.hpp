// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "strake/clash/clash.hpp"
#include "strake/clash/group.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {

// The items of the clash document's lists; `test` is the number of the test they are of.

/// A result, with the number of its group if there are groups.
void append_result(std::string& out, const ClashContents& contents, std::size_t test,
                   const clash::Pair& pair, std::optional<std::uint32_t> group);

void append_group(std::string& out, const clash::Group& group);

void append_exempted_pair(std::string& out, const ClashContents& contents, std::size_t test,
                          const clash::ExemptedPair& pair);

void append_not_compared(std::string& out, const ClashContents& contents, std::size_t test,
                         const clash::NotCompared& what);

}  // namespace strake::report
