// SPDX-License-Identifier: Apache-2.0
// A ship as it was delivered, and the same with a few changes.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "cli/evaluate/placed_model.hpp"
#include "cli/evaluate/studies/studies.hpp"
#include "strake/core/result.hpp"
#include "strake/generate/ship.hpp"

namespace strake::cli {

/// What becomes of a ship between two drawings. What stays keeps its number.
enum class ShipEdit : std::uint8_t { one_moved, some_moved, some_added };

struct ShipEditCase {
  ShipEdit edit = ShipEdit::one_moved;
  std::string_view title;
};
inline constexpr std::array<ShipEditCase, 3> kShipEdits{
    {{ShipEdit::one_moved, "one object moved"},
     {ShipEdit::some_moved, "one in a thousand moved"},
     {ShipEdit::some_added, "1 % added"}}};

/// One ship in several states.
struct EditedShips {
  PlacedModel before;
  std::array<PlacedModel, kShipEdits.size()> after;  ///< by kShipEdits
};

/// Generates a ship, and changes it. Errors: those of place_ship().
[[nodiscard]] Result<EditedShips> edit_ship(const StudyInput& input,
                                            const generate::ShipOptions& options);

}  // namespace strake::cli
