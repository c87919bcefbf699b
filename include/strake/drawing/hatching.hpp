// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "strake/hlr/hlr.hpp"

namespace strake::drawing {

/// Rules of hatching in order; the first rule that picks an object holds for it.
class Hatching {
 public:
  explicit Hatching(std::size_t objects) : objects_(objects) {}

  /// Adds a rule. `picked` selects objects; empty: all.
  void add(const hlr::Hatch& hatch, const std::vector<bool>& picked);

  /// Returns the value for hlr::Options::hatches: empty where there are no rules.
  [[nodiscard]] std::vector<hlr::Hatch> by_object() && { return std::move(hatches_); }

 private:
  std::size_t objects_;
  std::vector<hlr::Hatch> hatches_;
  std::vector<bool> known_;
};

}  // namespace strake::drawing
