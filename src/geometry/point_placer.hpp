// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geometry/boxed_tree.hpp"
#include "geometry/pair_view.hpp"

namespace strake::geometry {

enum class PointPlace : std::uint8_t { near_skin, inside, outside };

/// Along the largest faces of a part; nothing where the part is too large to be turned.
[[nodiscard]] std::optional<TurnedFrame> frame_along_faces(const TreedPart& part,
                                                           const parallel::Context& context);

/// Tells of many points, one after the other, where they lie in a part: within a band of its skin
/// (distances are floating point, relative error about 1e-12), else on which side of it (exactly).
///
/// Where a flat face is a fan of needles, the boxes of half of them hold any point of it, and those
/// of needles that lie askew any point of the body. For such a part the placer goes by the turned
/// frame, and by what it found last: points near the skin are looked for at the last triangles that
/// had one near, and round them; and a point that no triangle can part from one before lies on the
/// same side. Points that come in an order with near ones after each other then cost little; any
/// order gives the same places.
class PointPlacer {
 public:
  /// `band`: grid units. `frame`: null, or of this part; kept by reference.
  PointPlacer(const TreedPart& part, double band, const TurnedFrame* frame);

  /// `at`: relative to the part's origin.
  [[nodiscard]] PointPlace place(const Vec3l& at, PairWork& work);

 private:
  static constexpr std::size_t kRemembered = 8;

  struct Sided {
    Vec3d at;  ///< in the turned frame
    PointPlace side = PointPlace::outside;
  };

  [[nodiscard]] bool is_near(const Vec3d& p, std::uint32_t triangle) const;
  [[nodiscard]] bool is_near_known(const Vec3d& p, PairWork& work);
  template <class Visit>
  [[nodiscard]] bool candidates(const Vec3d& in_frame, PairWork& work, const Visit& visit) const;
  [[nodiscard]] bool near_skin(const Vec3d& p, const Vec3d& in_frame, PairWork& work);
  [[nodiscard]] std::uint32_t towards(const Vec3d& p, std::uint32_t triangle) const;
  [[nodiscard]] const Sided* same_side(const Vec3d& in_frame, PairWork& work) const;
  void remember(std::uint32_t triangle);

  TreedPart part_;
  PartView view_;
  double band_;
  const TurnedFrame* frame_;
  BoxedTree boxes_;
  /// The last, in rings.
  std::array<std::uint32_t, kRemembered> near_{};
  std::array<Sided, kRemembered> sided_{};
  std::size_t near_count_ = 0, sided_count_ = 0;
};

}  // namespace strake::geometry
