// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

/// Distinguishes strings of a JSON text from what is outside of them, without parsing it.
namespace strake::io::gltf {

/// The state of a text between two of its bytes.
struct QuoteState {
  bool in_string = false;
  bool escaped = false;  ///< behind a backslash that the next byte belongs to

  void pass(char c) {
    in_string ^= c == '"' && !escaped;
    escaped = c == '\\' && !escaped;
  }
};

/// Returns the state at the beginning of each whole block of so many bytes: whether a block begins
/// within a string follows from the number of quotes before it.
[[nodiscard]] Result<std::vector<QuoteState>> quote_states(std::string_view text,
                                                           std::size_t block_bytes,
                                                           const parallel::Context& context);

}  // namespace strake::io::gltf
