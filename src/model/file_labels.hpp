// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "strake/model/model.hpp"

namespace strake::model {

/// Makes the labels of the files unique and sorts the files by them; returns the new index of each
/// old one. It does not change the objects.
///
/// Files of one label gain the innermost folders that distinguish them, each as few as that takes;
/// those that lie in the same folders gain numbers, in the order of their content.
[[nodiscard]] std::vector<std::uint32_t> label_and_sort_files(Model& model);

}  // namespace strake::model
