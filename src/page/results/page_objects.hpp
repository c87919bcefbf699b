// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "page/blocks/block.hpp"
#include "page/results/page_facts.hpp"
#include "strake/model/model.hpp"
#include "strake/report/clash.hpp"

namespace strake::page {

/// The objects that a page names, by numbers of its own.
struct PageObjects {
  std::vector<model::ObjectId> objects;  ///< ascending
  /// The number of each object of the model; kNotInPage: it has none.
  std::shared_ptr<const std::vector<std::uint32_t>> number_of;
};
inline constexpr std::uint32_t kNotInPage = 0xffffffffU;

/// Numbers the objects that are wanted, which has an entry for each object of the model.
[[nodiscard]] PageObjects page_objects(const std::vector<bool>& wanted);

/// Returns the block strake-objects. `clash` is null in a page without results, and then `names` is
/// empty. `columns` are the names of attributes.
[[nodiscard]] Block objects_block(const model::Model& model,
                                  const std::shared_ptr<const PageObjects>& objects,
                                  const report::ClashContents* clash, const PageNames& names);

}  // namespace strake::page
