// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "strake/model/model.hpp"

namespace strake::io::rvm {

/// Returns the colour that a material index stands for in AVEVA's default palette; nothing for
/// indices that it leaves open (65 to 205 and above 255).
[[nodiscard]] std::optional<model::Color> default_color(std::uint32_t index);

/// The default palette with a file's own entries (COLR chunks) over it.
class Palette {
 public:
  void redefine(std::uint32_t index, model::Color color) { own_[index] = color; }
  [[nodiscard]] std::optional<model::Color> find(std::uint32_t index) const {
    const auto own = own_.find(index);
    return own != own_.end() ? std::optional(own->second) : default_color(index);
  }

 private:
  std::map<std::uint32_t, model::Color> own_;
};

}  // namespace strake::io::rvm
