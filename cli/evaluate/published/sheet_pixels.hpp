// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"

namespace strake::cli {

/// A sheet as a picture: what of two documents that differ in their bytes anybody could see.
///
/// Its longer side has kLongerSide pixels, of 0.07 mm on A4. A pixel is that of the
/// strongest line through it: visible before hidden.
class SheetPixels {
 public:
  static constexpr std::size_t kLongerSide = 4096;

  SheetPixels() = default;
  SheetPixels(const drawing::NeutralDrawing& sheet, const drawing::Ink& ink);

  /// Returns the number of pixels that have ink here.
  [[nodiscard]] std::size_t inked() const;
  /// Returns how many pixels are not as in another picture; all where the sizes differ.
  [[nodiscard]] std::size_t different(const SheetPixels& other) const;
  /// Returns "3 of 5931008 pixels differ".
  [[nodiscard]] std::string difference_text(const SheetPixels& other) const;

 private:
  void draw(const drawing::Line& line, double pixels_per_mm);

  std::size_t width_ = 0, height_ = 0;
  std::vector<std::uint8_t> ink_;  ///< by rows; 0: none
};

}  // namespace strake::cli
