// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::drawing {

/// Parses "30deg,80mm", "30deg", "30", "80mm" or "off": an angle and the distance of the lines in
/// the model, each said once, and each with its unit where both are said. Errors: usage.
[[nodiscard]] Result<hlr::Hatch> parse_hatch(std::string_view text);

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
