// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>

namespace strake::parallel::test {

std::size_t relaxed_in_intel_syntax(const std::atomic<std::size_t>& word);

}  // namespace strake::parallel::test
