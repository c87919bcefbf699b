// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "clash/incremental/neighbours.hpp"
#include "clash/incremental/object_map.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/clash/policy.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::clash {

/// What a report is brought up to date by.
struct MergeInputs {
  const Policy& policy;
  const Options& options;
  const model::Model& model;
  const ObjectMap& map;
  const Neighbours& neighbours;
  std::span<const std::uint64_t> names;     ///< hashes_of_names() of the model
  bool same_names = false;                  ///< these are those of the earlier run
  const PartnerBlocks* partners = nullptr;  ///< as in EarlierRun
};

/// Whether the lists of a report of an earlier run, which kept what changes need, fit a map of so
/// many objects and the rules of a later one.
[[nodiscard]] bool fits(const Report& earlier, const Report& fresh, std::size_t objects);

/// Brings the report of an earlier run up to date by one about the pairs of changed objects, from
/// detect_among(). `changes` takes what that does to its pairs; null: nobody needs it. Errors:
/// cancelled.
[[nodiscard]] Result<Report> merge(Report earlier, Report fresh, const MergeInputs& inputs,
                                   const parallel::Context& context, PairChanges* changes);

}  // namespace strake::clash
