// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/studies/edited_ships.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace strake::cli {

namespace {

constexpr geometry::Vec3d kMoveMm{250, 100, 0};

void move_object(model::Model& model, std::size_t object) {
  const model::Object& one = model.objects[object];
  for (std::uint32_t b = one.first_body; b < one.first_body + one.body_count; ++b)
    model.bodies[b].placement.translation = model.bodies[b].placement.translation + kMoveMm;
}

/// Adds another of an object, beside it.
void add_another(model::Model& model, std::size_t object) {
  model::Object one = model.objects[object];
  const std::uint32_t first = one.first_body;
  one.id += " again";
  one.first_body = static_cast<std::uint32_t>(model.bodies.size());
  one.place = static_cast<std::uint32_t>(model.objects.size());
  for (std::uint32_t b = first; b < first + one.body_count; ++b)
    model.bodies.push_back(model::Body(model.bodies[b]));
  model.objects.push_back(std::move(one));
  move_object(model, model.objects.size() - 1);
}

model::Model edited(model::Model model, ShipEdit edit) {
  const std::size_t objects = model.objects.size();
  // All over the ship, as its objects lie in order from one end to the other.
  const auto spread = [&](std::size_t count, auto&& each) {
    for (std::size_t i = 0; i < count; ++i) each(model, (2 * i + 1) * objects / (2 * count));
  };
  switch (edit) {
    case ShipEdit::one_moved:
      spread(1, move_object);
      break;
    case ShipEdit::some_moved:
      spread(std::max<std::size_t>(1, objects / 1000), move_object);
      break;
    case ShipEdit::some_added:
      spread(std::max<std::size_t>(1, objects / 100), add_another);
      break;
  }
  return model;
}

}  // namespace

Result<EditedShips> edit_ship(const StudyInput& input, const generate::ShipOptions& options) {
  Result<PlacedModel> before = place_ship(options, {}, input.stop);
  if (!before) return before.error();
  EditedShips ships{.before = std::move(*before), .after = {}};
  for (std::size_t i = 0; i < kShipEdits.size(); ++i) {
    Result<PlacedModel> after =
        place_model(edited(*ships.before.model, kShipEdits[i].edit), {}, input.stop);
    if (!after) return after.error();
    ships.after[i] = std::move(*after);
  }
  return ships;
}

}  // namespace strake::cli
