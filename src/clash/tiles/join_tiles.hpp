// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0077 says who does what of a report.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "clash/detect.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/policy.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::clash {

/// One test over a whole model, as detect() takes it.
struct WholeTest {
  const model::Model& model;                         ///< its names; no geometry is looked at
  std::span<const model::IncompleteObject> lacking;  ///< Scene::lacking
  double weld_mm = -1;                               ///< Scene::weld_mm
  const Sets& sets;
  const Options& options;
  const Policy& policy;
};

/// Puts the reports of the cells of a space together.
///
/// It is the report of detect() bit for bit, but for Report::counters and where that test would
/// have looked at boxes along the parts' own faces: then it is an error.
class TileJoin {
 public:
  /// The test must outlive this.
  explicit TileJoin(const WholeTest& test);

  /// Makes room for so many results, as all cells have.
  void make_room(std::size_t pairs, std::size_t regions);

  /// Whether the report of a cell is of this test.
  [[nodiscard]] bool fits(const TileReport& tile) const;

  /// Adds what the report of a cell says besides its pairs and their regions. It fits, and its
  /// objects have these numbers in the model, ascending. Cells may come in any order.
  void add(TileReport tile, std::span<const std::uint32_t> objects);

  /// Appends a pair of a cell, whose objects have their numbers in the model, and those of its
  /// regions that are listed. Pairs come in the order of their objects.
  void append(Pair pair, std::span<const Region> regions);

  /// Returns the report of all. Errors: input where there are so many pairs of boxes for each part
  /// that boxes along its faces are needed; cancelled.
  [[nodiscard]] Result<Report> finish(const parallel::Context& context) &&;

 private:
  void add_counts(const Report& tile);
  void add_rules(const Report& tile);
  [[nodiscard]] Status check_boxes() const;

  const WholeTest& test_;
  Report all_;
  std::vector<NotCompared> not_compared_;  ///< pairs
  std::vector<std::uint8_t> unknown_sag_;
  Hash128 hash_sum_;
  std::uint64_t hashed_ = 0, box_pairs_ = 0, parts_ = 0;
};

}  // namespace strake::clash
