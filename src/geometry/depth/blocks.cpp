// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>

#include "geometry/box.hpp"
#include "geometry/corners.hpp"

namespace strake::geometry {
namespace {

constexpr std::size_t kMostTriangles = 256;  ///< of a part that is cut
constexpr std::size_t kMostBlocks = 256;
/// Corners of a face that is square to the frame are this near to one plane, grid units: the snap
/// moves each by less than one.
constexpr double kSnapSpread = 4;
/// The cosine between its normal and the axis, at least.
constexpr double kFacing = 0.9;
/// The least share of a part's skin that is square to the frame, for cuts to be worth it.
constexpr double kMostlySquare = 0.8;
/// A piece thinner than this, grid units, is not cut off.
constexpr double kThinnest = 64;
/// Faces looked at in each direction for a roof.
constexpr std::size_t kRoofsTried = 3;

/// A triangle in the coordinates of the frame.
struct Face {
  Box3d box;
  Vec3d normal;
  double lo = 0, hi = 0;  ///< least and greatest normal·x of its corners
  double area = 0;        ///< twice
  int axis = -1;          ///< which it is square to, if any,
  bool faces_up = false;  ///< and whether outside is up that axis
};

/// How far a box reaches along a direction, at most or at least.
double reach_along(const Vec3d& n, const Box3d& box, bool most) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += n[k] * ((n[k] > 0) == most ? box.hi[k] : box.lo[k]);
  return sum;
}

using Faces = std::vector<const Face*>;

class PartInFrame {
 public:
  /// How far beyond a face, in slacks, it is clear of it.
  static constexpr double kClear = 4;

  PartInFrame(const DepthField& field, const Axes& axes, double slack)
      : field_(field), axes_(axes), slack_(slack) {
    const std::size_t n = field.part().triangles.size();
    faces_.reserve(n);
    for (std::uint32_t t = 0; t < n; ++t) faces_.push_back(face_of(t));
    for (const Face& f : faces_) {
      area_ += f.area;
      if (f.axis >= 0) {
        square_area_ += f.area;
        spread_ = std::max(spread_, f.box.hi[f.axis] - f.box.lo[f.axis]);
        square_[direction(f)].push_back(&f);
      }
    }
    for (std::size_t d = 0; d < 6; ++d)
      std::sort(square_[d].begin(), square_[d].end(), [d](const Face* x, const Face* y) {
        const int k = static_cast<int>(d / 2);
        return d % 2 == 1 ? x->box.hi[k] < y->box.hi[k] : x->box.lo[k] > y->box.lo[k];
      });
  }

  [[nodiscard]] double spread() const { return spread_; }
  [[nodiscard]] bool mostly_square() const { return square_area_ >= kMostlySquare * area_; }

  [[nodiscard]] Faces all() const {
    Faces all;
    for (const Face& f : faces_) all.push_back(&f);
    return all;
  }

  /// Whether a face may come near a box.
  [[nodiscard]] bool meets(const Face& f, const Box3d& box) const {
    if (!f.box.meets(box.inflated(2 * slack_))) return false;
    return f.axis >= 0 || (reach_along(f.normal, box, false) <= f.hi + 2 * slack_ &&
                           reach_along(f.normal, box, true) >= f.lo - 2 * slack_);
  }

  [[nodiscard]] bool contains(const Vec3d& p, PairWork& work) const {
    return field_.contains(on_field_grid(common(p)), work);
  }

  [[nodiscard]] Vec3d common(const Vec3d& p) const {
    return axes_[0] * p.x + axes_[1] * p.y + axes_[2] * p.z;
  }

  /// No skin in a box, whose middle is outside.
  [[nodiscard]] bool is_outside(const Box3d& box, PairWork& work) const {
    return std::none_of(faces_.begin(), faces_.end(),
                        [&](const Face& f) { return meets(f, box); }) &&
           !contains((box.lo + box.hi) * 0.5, work);
  }

  /// The depth of any point of a box that is in the part is no more than its height below the
  /// faces over which the whole box casts its shadow to the outside.
  [[nodiscard]] double bound(const Box3d& box, Vec3d& deepest, PairWork& work) const {
    double upper = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const auto low = roof(box, k, false, work), high = roof(box, k, true, work);
      double at = (box.lo[k] + box.hi[k]) / 2;
      if (low && high)
        at = std::clamp((*low + *high) / 2, box.lo[k], box.hi[k]);
      else if (low)
        at = box.hi[k];
      else if (high)
        at = box.lo[k];
      deepest[k] = at;
      if (low) upper = std::min(upper, at - *low);
      if (high) upper = std::min(upper, *high - at);
    }
    return upper;
  }

 private:
  static std::size_t direction(const Face& f) {
    return 2 * static_cast<std::size_t>(f.axis) + (f.faces_up ? 1 : 0);
  }

  [[nodiscard]] Face face_of(std::uint32_t t) const {
    Corners c = corners_of(field_.part(), t);
    for (Vec3d& p : c) {
      const Vec3d q = field_.common(p);
      p = {dot(axes_[0], q), dot(axes_[1], q), dot(axes_[2], q)};
    }
    Face face;
    face.box = box_of(c);
    const Vec3d n = normal_of(c);
    const double size = length(n);
    if (!(size > 0)) return face;
    face.area = size;
    face.normal = n * (1 / size);
    const std::array<double, 3> along{dot(face.normal, c[0]), dot(face.normal, c[1]),
                                      dot(face.normal, c[2])};
    face.lo = std::min({along[0], along[1], along[2]});
    face.hi = std::max({along[0], along[1], along[2]});
    for (int k = 0; k < 3; ++k)
      if (std::fabs(face.normal[k]) > kFacing && face.box.hi[k] - face.box.lo[k] <= kSnapSpread) {
        face.axis = k;
        face.faces_up = face.normal[k] > 0;
      }
    return face;
  }

  /// The coordinate just beyond the nearest face over which a box casts its whole shadow to the
  /// outside.
  [[nodiscard]] std::optional<double> roof(const Box3d& box, int k, bool up, PairWork& work) const {
    const double side = up ? box.hi[k] : box.lo[k];
    double last = std::numeric_limits<double>::quiet_NaN();
    std::size_t tried = 0;
    for (const Face* f : square_[2 * static_cast<std::size_t>(k) + (up ? 1 : 0)]) {
      const double at = up ? f->box.hi[k] + kClear * slack_ : f->box.lo[k] - kClear * slack_;
      if ((up ? at < side : at > side) || at == last) continue;
      last = at;
      Box3d shadow = box;
      shadow.lo[k] = shadow.hi[k] = at;
      if (is_outside(shadow, work)) return at;
      if (++tried == kRoofsTried) break;
    }
    return std::nullopt;
  }

  const DepthField& field_;
  const Axes& axes_;
  double slack_;
  double spread_ = 0, area_ = 0, square_area_ = 0;
  std::vector<Face> faces_;
  std::array<Faces, 6> square_;  ///< by direction, in the order in which they are met
};

Block whole(const Box3d& box) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {box, {kInfinity, kInfinity}, {}};
}

class Cutter {
 public:
  Cutter(const DepthField& a, const DepthField& b, const Axes& axes, double slack, PairWork& work)
      : parts_{PartInFrame(a, axes, slack), PartInFrame(b, axes, slack)},
        clear_(PartInFrame::kClear * slack),
        inset_(kStandOff + 2 * clear_ + std::max(parts_[0].spread(), parts_[1].spread())),
        work_(work) {}

  std::vector<Block> run(const Box3d& box) {
    if (!parts_[0].mostly_square() || !parts_[1].mostly_square()) return {whole(box)};
    cut(box, {parts_[0].all(), parts_[1].all()});
    return std::move(blocks_);
  }

 private:
  struct Cut {
    int axis = -1;
    double at = 0;
    double area = 0;  ///< of the face that the cut follows, as far as it is in the box
  };

  void cut(const Box3d& box, const std::array<Faces, 2>& before) {
    std::array<Faces, 2> near;
    for (std::size_t i = 0; i < 2; ++i) {
      for (const Face* f : before[i])
        if (parts_[i].meets(*f, box)) near[i].push_back(f);
      if (near[i].empty() && !parts_[i].contains((box.lo + box.hi) * 0.5, work_)) return;
    }
    const Cut best = best_cut(box, near);
    if (best.axis < 0 || blocks_.size() >= kMostBlocks) {
      keep(box, near);
      return;
    }
    Box3d below = box, above = box;
    below.hi[best.axis] = above.lo[best.axis] = best.at;
    cut(below, near);
    cut(above, near);
  }

  /// Just outside the largest face that is square to the frame.
  [[nodiscard]] Cut best_cut(const Box3d& box, const std::array<Faces, 2>& near) const {
    Cut best;
    for (const Faces& faces : near)
      for (const Face* f : faces) {
        if (f->axis < 0) continue;
        const int k = f->axis;
        const double at = f->faces_up ? f->box.hi[k] + clear_ : f->box.lo[k] - clear_;
        if (at < box.lo[k] + kThinnest || at > box.hi[k] - kThinnest) continue;
        double area = 1;
        for (int m = 0; m < 3; ++m)
          if (m != k) area *= std::min(f->box.hi[m], box.hi[m]) - std::max(f->box.lo[m], box.lo[m]);
        if (area > 0 && std::tuple(area, k, at) > std::tuple(best.area, best.axis, best.at))
          best = {k, at, area};
      }
    return best;
  }

  /// What is left of a block without a little at its sides.
  struct Core {
    Box3d box;
    double way = 0;  ///< any point of the block is within this of the core
  };

  /// `inset`: from the low and the high sides.
  [[nodiscard]] Core core_of(const Box3d& box, const std::array<Vec3d, 2>& inset) const {
    Core core{box, 0};
    double squared = 0;
    for (int k = 0; k < 3; ++k) {
      const double half = (box.hi[k] - box.lo[k]) / 2;
      const double lo = std::min(inset[0][k], half), hi = std::min(inset[1][k], half);
      core.box.lo[k] += lo;
      core.box.hi[k] -= hi;
      squared += std::max(lo, hi) * std::max(lo, hi);
    }
    core.way = std::sqrt(squared) + clear_;
    return core;
  }

  void keep(const Box3d& box, const std::array<Faces, 2>& near) {
    Block block{box, {}, {}};
    const Vec3d little{inset_, inset_, inset_};
    const Core core = core_of(box, {little, little});
    const Core free = core_of(box, beyond_faces(box, near));
    if (is_outside(core.box))
      add_rim(block, core);
    else if (is_outside(free.box))
      add_rim(block, free);
    else
      add(block, core.box, core.way);
    blocks_.push_back(block);
  }

  /// How far from its sides a box is clear of the faces that lie along them, too near to be cut
  /// along: those of a body that fits another.
  [[nodiscard]] std::array<Vec3d, 2> beyond_faces(const Box3d& box,
                                                  const std::array<Faces, 2>& near) const {
    const Vec3d little{inset_, inset_, inset_};
    std::array<Vec3d, 2> inset{little, little};
    for (const Faces& faces : near)
      for (const Face* f : faces) {
        if (f->axis < 0) continue;
        const int k = f->axis;
        const double lo = f->box.hi[k] + clear_ - box.lo[k];
        const double hi = box.hi[k] + clear_ - f->box.lo[k];
        if (lo < kThinnest) inset[0][k] = std::max(inset[0][k], lo);
        if (hi < kThinnest) inset[1][k] = std::max(inset[1][k], hi);
      }
    return inset;
  }

  /// Whether nothing in a box is in both parts.
  [[nodiscard]] bool is_outside(const Box3d& box) const {
    return parts_[0].is_outside(box, work_) || parts_[1].is_outside(box, work_);
  }

  /// Raises the bounds of a block to those of what lies within `way` of a box.
  void add(Block& block, const Box3d& core, double way) const {
    for (std::size_t i = 0; i < 2; ++i) {
      Vec3d deepest = (core.lo + core.hi) * 0.5;
      double upper = way;
      if (!parts_[i].is_outside(core, work_)) upper += parts_[i].bound(core, deepest, work_);
      if (upper <= block.upper[i]) continue;
      block.upper[i] = upper;
      block.promise[i] = parts_[i].common(deepest);
    }
  }

  /// All that is common is round an empty core, as where a body fills a channel: of the faces,
  /// edges and corners of the core, only those count that something common lies at.
  void add_rim(Block& block, const Core& core) const {
    constexpr int kPieces = 27, kMiddle = 13;
    for (int i = 0; i < kPieces; ++i) {
      if (i == kMiddle) continue;
      Box3d piece = core.box, side = core.box;
      const std::array<int, 3> where{i % 3, i / 3 % 3, i / 9};
      for (int k = 0; k < 3; ++k) {
        const int at = where[static_cast<std::size_t>(k)];
        if (at == 0) {
          piece.lo[k] = block.box.lo[k];
          piece.hi[k] = side.hi[k] = core.box.lo[k];
        } else if (at == 2) {
          piece.lo[k] = side.lo[k] = core.box.hi[k];
          piece.hi[k] = block.box.hi[k];
        }
      }
      if (!is_outside(piece)) add(block, side, core.way);
    }
  }

  std::array<PartInFrame, 2> parts_;
  double clear_, inset_;
  PairWork& work_;
  std::vector<Block> blocks_;
};

}  // namespace

std::vector<Block> cut_into_blocks(const DepthField& a, const DepthField& b, const Axes& axes,
                                   const Box3d& box, double slack, PairWork& work) {
  if (std::max(a.part().triangles.size(), b.part().triangles.size()) > kMostTriangles)
    return {whole(box)};
  return Cutter(a, b, axes, slack, work).run(box);
}

}  // namespace strake::geometry
