// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::generate {

/// What a generated ship is like. Each is a load of another kind for clash detection and drawings.
enum class ShipKind : std::uint8_t {
  usual,
  slender,   ///< half as many lanes and levels, three at most, and so longer
  dense,     ///< engine rooms on every level
  repeated,  ///< cabins on every level: few shapes, each at many places
  unlike,    ///< every eighth body with a mesh like no other, as programs without instances write
};
inline constexpr std::array<std::string_view, 5> kShipKinds{"usual", "slender", "dense", "repeated",
                                                            "unlike"};

struct ShipOptions {
  static constexpr std::uint64_t kMinObjects = 100;
  static constexpr std::uint64_t kMaxObjects = 5'000'000;

  std::uint64_t objects = 1000;  ///< the ship has exactly this many
  std::uint64_t seed = 1;
  /// Rotates the whole ship by one general rotation (composed into every placement), so that no
  /// face lies along an axis any more and coplanar contacts become ties within a few micrometres.
  bool turned = false;
  /// This many objects on the weather deck are single meshes with far more triangles than anything
  /// else, no two alike, like equipment that was imported from another program.
  std::uint64_t imported_detail = 0;
  static constexpr std::uint64_t kMinTriangles = 1000;
  static constexpr std::uint64_t kMaxTriangles = 20'000'000;
  std::uint64_t imported_triangles = 1'000'000;  ///< about this many triangles each
  ShipKind kind = ShipKind::usual;
};

/// A pair of objects that is not NO_HIT; a < b in the model's order.
struct TruthPair {
  model::ObjectId a{}, b{};
  clash::Class cls = clash::Class::no_hit;
  std::uint8_t why = 0;  ///< index into Truth::reasons
  double d_mm = 0;       ///< signed separation of the meshes as written; negative is depth
};

/// Every pair of the ship that is not NO_HIT at `clearance_mm` and default tolerances, known from
/// the construction. No pair lies within half a millimetre of a threshold.
struct Truth {
  static constexpr double kClearanceMm = 25;

  std::vector<TruthPair> pairs;             ///< by (a, b)
  std::vector<model::ObjectId> inside_out;  ///< solids whose triangles were written reversed
  std::vector<std::string_view> reasons;    ///< texts of TruthPair::why
};

struct Ship {
  ShipOptions options;
  model::Model model;  ///< finished: objects stand in the order of their ids
  Truth truth;
};

/// Generates a parametric ship section: plating, framing, bulkheads, piping, ducts, cable trays,
/// machinery, tanks, cabins, stores and deck gear, with seeded clashes and the truth about every
/// pair.
///
/// 1. The number of objects is exact; equal options give equal bytes on every machine.
/// 2. Object ids are unique, equal to names, and sort as strings.
/// 3. Shapes stand in whole micrometres within 8 m of their own origin, so that float32 metres
///    give every vertex back on its grid point; placements are signed permutations (times the
///    general rotation when turned) and whole micrometres.
/// 4. Pipes, tanks and machinery are solid bodies, as in most plant models; ducts, some tanks and
///    plates with openings are hollow. Meshes are closed; several disjoint or merely touching
///    shells may make one object.
///
/// Errors: usage outside [kMinObjects, kMaxObjects] and [kMinTriangles, kMaxTriangles], and where
/// the deck has no room for what is imported; cancelled when the context says stop.
[[nodiscard]] Result<Ship> generate_ship(const ShipOptions& options,
                                         const parallel::Context& context);

/// Writes the truth file (schemas/truth.schema.json): `pairs[]` with `a`, `b`, `class`, `d_mm`,
/// `why`.
void write_truth(const Ship& ship, std::ostream& out);

}  // namespace strake::generate
