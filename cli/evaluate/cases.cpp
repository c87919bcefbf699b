// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/cases.hpp"

#include <algorithm>
#include <cmath>

#include "strake/drawing/view.hpp"

namespace strake::cli {

namespace {

using geometry::Vec3d;
using geometry::Vec3l;

constexpr Vec3l kTop{0, 0, 1}, kFront{1, 0, 0}, kRight{0, -1, 0}, kIso{1, -1, 1};

constexpr std::array<ViewCase, 13> kViews{{
    {"plan-lower", "Plan of a lower deck", kTop, PartOfModel{{0, 0, 0.12}, {1, 1, 0.3}}},
    {"plan-upper", "Plan of an upper deck", kTop, PartOfModel{{0, 0, 0.55}, {1, 1, 0.75}}},
    {"elevation", "Elevation from starboard", kRight},
    {"front", "Elevation from ahead", kFront},
    {"section-long", "Longitudinal section amidships", kRight, std::nullopt, kRight},
    {"section-frame", "Section at a frame", kFront, std::nullopt, kFront, {0.41, 0.5, 0.5}},
    {"iso", "Whole ship, isometric", kIso},
    {"iso-below", "Whole ship from below astern", {-1, 1, -1}},
    {"perspective",
     "Whole ship, perspective",
     kIso,
     std::nullopt,
     std::nullopt,
     {},
     PartOfModel{{1.4, -1.5, 2.2}, {0.5, 0.5, 0.4}}},
    {"machinery", "Machinery space, dense", kIso, PartOfModel{{0.25, 0, 0}, {0.6, 1, 0.3}}},
    {"accommodation", "Accommodation block", kIso, PartOfModel{{0, 0, 0.65}, {0.35, 1, 1}}},
    {"detail", "Detail of a room", kIso, PartOfModel{{0.3, 0.3, 0.3}, {0.38, 0.45, 0.42}}},
    {"crowd",
     "Deck with imported, over-detailed equipment",
     kIso,
     std::nullopt,
     std::nullopt,
     {},
     std::nullopt,
     ViewedShip::crowd},
}};

constexpr std::array<ShipCase, 4> kShips{{
    {"slender", "Slender ship", generate::ShipKind::slender},
    {"dense", "Dense ship, engine rooms throughout", generate::ShipKind::dense},
    {"repeated", "Many instances of few shapes", generate::ShipKind::repeated},
    {"unlike", "Many meshes like no other", generate::ShipKind::unlike},
}};

/// Returns a number of objects at a scale, within what can be generated.
std::uint64_t scaled(double full, double scale, std::uint64_t least) {
  const double largest = static_cast<double>(generate::ShipOptions::kMaxObjects);
  return std::max(least, static_cast<std::uint64_t>(std::min(largest, full * scale)));
}

/// Returns the grid point at these parts of a box, which may lie outside of it.
Vec3l at(const geometry::Box3l& box, const Vec3d& parts) {
  const Vec3d lo = box.lo.as<double>(), size = (box.hi - box.lo).as<double>();
  return {std::llround(lo.x + parts.x * size.x), std::llround(lo.y + parts.y * size.y),
          std::llround(lo.z + parts.z * size.z)};
}

}  // namespace

std::span<const ViewCase> view_cases() { return kViews; }
std::span<const ShipCase> ship_cases() { return kShips; }

generate::ShipOptions viewed_ship(ViewedShip ship, double scale) {
  constexpr double kWhole = 100'000, kCrowd = 20'000, kCrowdTriangles = 200'000;
  // The deck of a smaller crowd has no room for what is imported.
  constexpr std::uint64_t kMin = 2000, kMinCrowd = 6000;
  generate::ShipOptions options;
  options.seed = 7;
  options.objects =
      ship == ViewedShip::whole ? scaled(kWhole, scale, kMin) : scaled(kCrowd, scale, kMinCrowd);
  if (ship == ViewedShip::whole) return options;
  options.imported_detail = 8;
  options.imported_triangles =
      std::clamp(static_cast<std::uint64_t>(kCrowdTriangles * scale), std::uint64_t{4000},
                 generate::ShipOptions::kMaxTriangles);
  return options;
}

generate::ShipOptions clashing_ship(const ShipCase& ship, double scale) {
  constexpr double kObjects = 1'050'000;
  constexpr std::uint64_t kMin = 2000;
  generate::ShipOptions options;
  options.seed = 11;
  options.kind = ship.kind;
  options.objects = scaled(kObjects, scale, kMin);
  return options;
}

hlr::View view_of(const ViewCase& view, const geometry::Box3l& model) {
  hlr::View result;
  result.direction = view.direction;
  if (view.limits) result.limits = {at(model, view.limits->lo), at(model, view.limits->hi)};
  if (view.section_normal)
    result.sections.push_back({*view.section_normal, at(model, view.section_at)});
  if (view.eye_and_target) {
    hlr::Perspective perspective;
    perspective.eye = at(model, view.eye_and_target->lo);
    perspective.target = at(model, view.eye_and_target->hi);
    // They are two points: neither is what set_perspective() refuses.
    (void)drawing::set_perspective(perspective, result);
  }
  result.up = drawing::default_up(result.direction);
  return result;
}

}  // namespace strake::cli
