// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <stop_token>
#include <string_view>
#include <utility>
#include <vector>

#include "generate/mesh_primitives.hpp"
#include "generate/object_kinds.hpp"
#include "strake/clash/clash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"

namespace strake::generate {

/// An object of the builder, in the order of building; kNothing where there is none.
using Handle = std::uint32_t;
inline constexpr Handle kNothing = 0xffffffffU;

/// A signed permutation and a shift in whole micrometres.
struct AxisFrame {
  std::array<std::int8_t, 9> m{1, 0, 0, 0, 1, 0, 0, 0, 1};
  geometry::Vec3l t;

  [[nodiscard]] geometry::Vec3l operator*(const geometry::Vec3l& v) const;
  [[nodiscard]] AxisFrame operator*(const AxisFrame& inner) const;
};

/// Turns local z to the named direction by an even permutation of the axes.
enum class FacingAxis : std::uint8_t { up, along, beside, down };
[[nodiscard]] AxisFrame facing(FacingAxis axis, const geometry::Vec3d& at_mm);
[[nodiscard]] AxisFrame at(const geometry::Vec3d& mm);
[[nodiscard]] geometry::Vec3l grid(const geometry::Vec3d& mm);

/// The cell of the ship to which an object belongs: bay, lane, level (0: double bottom).
struct ShipCell {
  std::uint16_t bay = 0, lane = 0, level = 0;
};

/// Why a pair is in the truth.
enum class PairReason : std::uint8_t {
  weld,
  rests,
  bolted,
  fitted,
  through_plate,
  overlap,
  thin_plates,
  wrong_run,
  buried,
  copy,
  gap_small,
  press,
  gap_clear,
  gap_corner,
  gap_slanted,
  gap_inside,
  count,
};
[[nodiscard]] std::span<const std::string_view> why_texts();

struct ShipObject {
  AxisFrame frame;
  std::uint32_t shape = 0;
  ObjectKind kind = ObjectKind::count;
  ShipCell cell;
  std::uint16_t number = 0;
  bool inside_out = false;
  bool stays = false;  ///< never left out to meet the asked number of objects
};

struct DeclaredPair {
  Handle a = 0, b = 0;
  clash::Class cls = clash::Class::contact;
  PairReason why = PairReason::weld;
  double d_mm = 0;
};

/// The recipe of a shape: a maker's number and its parameters in micrometres. Equal recipes are one
/// shape.
using Recipe = std::array<std::int64_t, 10>;

/// Collects objects, the shapes that they share, and the pairs that the construction knows of.
class ShipBuilder {
 public:
  /// Returns the shape of a recipe, made on first use.
  std::uint32_t shape(const Recipe& recipe, const std::function<MicrometreMesh()>& make);
  /// Returns the shape with reversed triangles.
  std::uint32_t reversed(std::uint32_t shape);
  /// Adds a shape of one object that takes long to make; it is empty until make_late_shapes().
  std::uint32_t late_shape(std::function<MicrometreMesh()> make);
  /// Makes the late shapes. Errors: cancelled.
  [[nodiscard]] Status make_late_shapes(const std::stop_token& stop);
  std::uint32_t lines(const Recipe& recipe, const std::function<geometry::Polylines()>& make);

  Handle add(ObjectKind kind, const ShipCell& cell, std::uint32_t shape, const AxisFrame& frame);
  void keep(Handle object) { objects_[object].stays = true; }
  /// Writes an object's triangles reversed.
  void turn_inside_out(Handle object);
  /// Records a pair; nothing happens where one of the two is kNothing.
  void declare(const DeclaredPair& pair);
  void weld(Handle a, Handle b) { declare({a, b, clash::Class::contact, PairReason::weld, 0}); }
  void rest(Handle a, Handle b) { declare({a, b, clash::Class::contact, PairReason::rests, 0}); }
  void bolt(Handle a, Handle b) { declare({a, b, clash::Class::contact, PairReason::bolted, 0}); }
  void fit(Handle a, Handle b) { declare({a, b, clash::Class::contact, PairReason::fitted, 0}); }

  [[nodiscard]] const std::vector<ShipObject>& objects() const { return objects_; }
  [[nodiscard]] const std::vector<DeclaredPair>& pairs() const { return pairs_; }
  [[nodiscard]] std::vector<model::Shape> take_shapes() { return std::move(shapes_); }
  [[nodiscard]] const std::vector<double>& volumes_mm3() const { return volumes_; }

 private:
  std::map<Recipe, std::uint32_t> known_;
  std::map<std::uint32_t, std::uint32_t> reversed_;
  std::vector<model::Shape> shapes_;
  std::vector<double> volumes_;
  std::vector<std::pair<std::uint32_t, std::function<MicrometreMesh()>>> late_;
  std::vector<ShipObject> objects_;
  std::vector<DeclaredPair> pairs_;
  std::map<std::array<std::uint32_t, 4>, std::uint16_t> next_number_;
};

/// Builds objects in a frame of its own within one cell; lengths are in millimetres.
struct Site {
  ShipBuilder* builder = nullptr;
  ShipCell cell;
  AxisFrame frame;

  [[nodiscard]] Site moved(const geometry::Vec3d& mm) const;
  [[nodiscard]] Site in(const AxisFrame& inner) const { return {builder, cell, frame * inner}; }

  Handle box(ObjectKind kind, const geometry::Vec3d& lo, const geometry::Vec3d& hi) const;
  /// Makes a box with a closed cavity whose walls are `wall` thick.
  Handle shell_box(ObjectKind kind, const geometry::Vec3d& lo, const geometry::Vec3d& hi,
                   double wall) const;
  /// Makes a body of revolution about `axis` through `from`; profile of (radius, height) in mm.
  Handle turned(ObjectKind kind, std::span<const geometry::Vec3d> profile, const AxisFrame& where,
                int sides = 24) const;
  /// Makes a round bar of radius r and length l from `from` along `axis`.
  Handle bar(ObjectKind kind, double r, double length, const AxisFrame& where,
             int sides = 24) const;
  /// Makes a ring of bore radius r, outer radius R.
  Handle collar(ObjectKind kind, double bore, double outer, double length,
                const AxisFrame& where) const;
  /// Extrudes a profile of (u, v) along `axis`.
  Handle extruded(ObjectKind kind, std::span<const geometry::Vec3d> profile, double length,
                  const AxisFrame& where) const;
  /// Makes a rectangular tube of outer size (u, v), wall thickness `wall`, along the frame's z.
  Handle tube(ObjectKind kind, const geometry::Vec3d& size, double wall,
              const AxisFrame& where) const;
  /// Makes a bent bar along a path.
  Handle swept(ObjectKind kind, std::span<const geometry::Vec3d> path, double r, double bend) const;
  Handle centre_line(std::span<const geometry::Vec3d> path) const;
};

}  // namespace strake::generate
