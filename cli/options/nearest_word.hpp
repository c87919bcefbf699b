// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace strake::cli {

/// Returns the word of a list that a misspelt one most likely means: the one that is made of it by
/// the fewest changes of a letter, letters that change places counting as one; nothing where that
/// would be a third of its letters or more.
[[nodiscard]] std::string nearest_word(std::string_view word,
                                       const std::vector<std::string>& known);

/// Returns "did you mean 'clash'?", or what else to say where no word is near.
[[nodiscard]] std::string did_you_mean(std::string_view word, const std::vector<std::string>& known,
                                       std::string otherwise);

}  // namespace strake::cli
