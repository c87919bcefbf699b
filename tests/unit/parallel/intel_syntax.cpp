// SPDX-License-Identifier: Apache-2.0
// Compiled with -masm=intel where the processor has two syntaxes: a user's flags must not turn a
// load into a store.
#include "intel_syntax.hpp"

#include "strake/parallel/detail/load_relaxed.hpp"

namespace strake::parallel::test {

std::size_t relaxed_in_intel_syntax(const std::atomic<std::size_t>& word) {
  return detail::load_relaxed(word);
}

}  // namespace strake::parallel::test
