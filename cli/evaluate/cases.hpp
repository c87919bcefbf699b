// SPDX-License-Identifier: Apache-2.0
// The inputs of an evaluation: thirteen views and four ships, all generated.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "strake/generate/ship.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::cli {

/// A box in parts of a model's own, from 0 to 1 along each axis.
struct PartOfModel {
  geometry::Vec3d lo{0, 0, 0}, hi{1, 1, 1};
};

/// Which generated ship a view is of.
enum class ViewedShip : std::uint8_t { whole, crowd };

struct ViewCase {
  std::string_view name, title;
  geometry::Vec3l direction;
  std::optional<PartOfModel> limits = std::nullopt;
  /// What lies on the side of this normal is cut away, from the point at these parts of the model.
  std::optional<geometry::Vec3l> section_normal = std::nullopt;
  geometry::Vec3d section_at{0.5, 0.5, 0.5};
  /// In perspective: eye and target in parts of the model's size.
  std::optional<PartOfModel> eye_and_target = std::nullopt;
  ViewedShip ship = ViewedShip::whole;
};

struct ShipCase {
  std::string_view name, title;
  generate::ShipKind kind = generate::ShipKind::usual;
};

[[nodiscard]] std::span<const ViewCase> view_cases();
[[nodiscard]] std::span<const ShipCase> ship_cases();

/// Return the ships of an evaluation at a scale (1: as the thesis has them).
[[nodiscard]] generate::ShipOptions viewed_ship(ViewedShip ship, double scale);
[[nodiscard]] generate::ShipOptions clashing_ship(const ShipCase& ship, double scale);

/// Returns the view of a model that fills a box, in grid units.
[[nodiscard]] hlr::View view_of(const ViewCase& view, const geometry::Box3l& model);

}  // namespace strake::cli
