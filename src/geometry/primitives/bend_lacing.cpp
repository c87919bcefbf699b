// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitives/bend_lacing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strake::geometry::tessellation {
namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();
/// A triangle that looks the wrong way weighs more than all long edges of a band.
constexpr double kWeightOfWrong = 1e9, kWeightOfThin = 1e6;
/// In length: a triangle narrower than this on paper may come to look either way, once its corners
/// are rounded to the grid.
constexpr double kNarrowOnPaper = 2e-3;

double square_of(const Vec3d& v) { return dot(v, v); }

class BandSearch {
 public:
  BandSearch(const SectionArc& first, const SectionArc& second, const Vec3d& eye, bool faces_eye,
             double step, double least)
      : first_(first),
        second_(second),
        eye_(eye),
        sign_(faces_eye ? 1 : -1),
        step_(step),
        least_(least),
        width_(second.angles.size()) {
    const double at_start = std::fabs(first.angles.front() - second.angles.front());
    const double at_end = std::fabs(first.angles.back() - second.angles.back());
    window_ = std::max(at_start, at_end) + 2 * step;
  }

  [[nodiscard]] BandLacing best() {
    const std::size_t height = first_.angles.size();
    cost_.assign(height * width_, kUnreached);
    from_second_.assign(height * width_, false);
    cost_[0] = 0;
    for (std::size_t i = 0; i < height; ++i)
      for (std::size_t k = 0; k < width_; ++k) {
        const double here = cost_[i * width_ + k];
        if (here == kUnreached) continue;
        if (i + 1 < height) reach(i + 1, k, here + weight_of_first(i, k), false);
        if (k + 1 < width_) reach(i, k + 1, here + weight_of_second(i, k), true);
      }
    return traced(height - 1, width_ - 1);
  }

 private:
  void reach(std::size_t i, std::size_t k, double cost, bool by_second) {
    const double apart = std::fabs(first_.angles[i] - second_.angles[k]);
    const bool alone = first_.angles.size() == 1 || width_ == 1;
    if (apart > window_ && !alone) return;
    const double turns = apart / step_, all = cost + turns * turns;
    double& best = cost_[i * width_ + k];
    if (!(all < best)) return;
    best = all;
    from_second_[i * width_ + k] = by_second;
  }

  [[nodiscard]] double weight_of_first(std::size_t i, std::size_t k) const {
    return weight(first_.points[i], second_.points[k], first_.points[i + 1]);
  }
  [[nodiscard]] double weight_of_second(std::size_t i, std::size_t k) const {
    return weight(first_.points[i], second_.points[k], second_.points[k + 1]);
  }

  /// What speaks against a triangle: the way it looks, by its height on paper over its longest
  /// edge.
  [[nodiscard]] double weight(const Vec3d& a, const Vec3d& b, const Vec3d& c) const {
    const Vec3d sight = eye_ - a;
    const double longest = std::max({square_of(b - a), square_of(c - b), square_of(a - c)});
    const double facing = sign_ * dot(cross(b - a, c - a), sight);
    const double height = facing / std::sqrt(longest * square_of(sight));
    if (height > kNarrowOnPaper) return 0;
    return height > -least_ ? kWeightOfThin : kWeightOfWrong;
  }

  [[nodiscard]] BandLacing traced(std::size_t i, std::size_t k) const {
    BandLacing lacing;
    if (cost_[i * width_ + k] == kUnreached) return lacing;
    while (i > 0 || k > 0) {
      const bool by_second = from_second_[i * width_ + k];
      lacing.second_goes_on.push_back(by_second);
      --(by_second ? k : i);
    }
    std::reverse(lacing.second_goes_on.begin(), lacing.second_goes_on.end());
    return lacing;
  }

  const SectionArc &first_, &second_;
  const Vec3d& eye_;
  double sign_, step_, least_, window_ = 0;
  std::size_t width_;
  std::vector<double> cost_;  ///< of reaching the edge from a point of the first arc to the second
  std::vector<bool> from_second_;
};

}  // namespace

BandLacing lace_band(const SectionArc& first, const SectionArc& second, const Vec3d& eye,
                     bool faces_eye, double step, double least) {
  return BandSearch(first, second, eye, faces_eye, step, least).best();
}

}  // namespace strake::geometry::tessellation
