// SPDX-License-Identifier: Apache-2.0
#include "hlr/bucket_plan.hpp"

#include <cmath>
#include <limits>

#include "strake/hlr/hlr.hpp"

namespace strake::hlr {
namespace {

/// Buckets and entries per box that a grid may have, and one that is chosen.
constexpr double kMostPerBox = 64, kChosenPerBox = 8;
/// What a step to the next bucket costs, in boxes looked at.
constexpr double kStep = 2;

double length(std::int64_t lo, std::int64_t hi) {
  return static_cast<double>(hi) - static_cast<double>(lo);
}

}  // namespace

BucketPlan::BucketPlan(std::span<const ViewBox> boxes) {
  for (const ViewBox& box : boxes) add(box);
}

void BucketPlan::add(const ViewBox& box) {
  if (box.empty()) return;
  ++count_;
  extent_.include(box);
  const double a = length(box.lo.u, box.hi.u), b = length(box.lo.v, box.hi.v);
  sides_sum_ += a + b;
  area_ += a * b;
}

void BucketPlan::add(const BucketPlan& more) {
  extent_.include(more.extent_);
  count_ += more.count_;
  sides_sum_ += more.sides_sum_;
  area_ += more.area_;
}

double BucketPlan::width() const {
  return extent_.empty() ? 0 : length(extent_.lo.u, extent_.hi.u);
}
double BucketPlan::height() const {
  return extent_.empty() ? 0 : length(extent_.lo.v, extent_.hi.v);
}

// Fewer buckets along the shorter side.
BucketPlan::Sides BucketPlan::sides(std::uint32_t side) const {
  if (!(longest() > 0)) return {};
  return {std::max(1.0, std::round(side * width() / longest())),
          std::max(1.0, std::round(side * height() / longest()))};
}

double BucketPlan::buckets(std::uint32_t side) const {
  const Sides n = sides(side);
  return n.u * n.v;
}

// A box of sides a and b stands in (a / s + 1) (b / s + 1) buckets of side s.
double BucketPlan::entries(std::uint32_t side) const {
  const double s = longest() / side;
  return s > 0 ? count_ + sides_sum_ / s + area_ / (s * s) : count_;
}

bool BucketPlan::fits(std::uint32_t side, double per_box) const {
  return side <= 1 || buckets(side) + entries(side) <= per_box * count_;
}

// An edge of length l meets l / s + 1 of them.
std::uint32_t BucketPlan::best_side(const EdgeLengths& own) const {
  const EdgeLengths edges = own.count > 0 ? own : EdgeLengths{count_, sides_sum_ / 2};
  std::uint32_t best = 1;
  if (!(longest() > 0)) return best;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t side = 1; side <= Options::kMostBuckets && fits(side, kChosenPerBox);
       side *= 2) {
    const double walks = edges.count + edges.sum * side / longest();
    const double cost = walks * (kStep + entries(side) / buckets(side));
    if (cost >= least) continue;
    least = cost;
    best = side;
  }
  return best;
}

BucketAxes BucketPlan::axes(std::uint32_t side) const {
  side = std::clamp<std::uint32_t>(side, 1, Options::kMostBuckets);
  while (!fits(side, kMostPerBox)) side /= 2;
  const Sides count = sides(side);
  const auto axis = [](std::int64_t lo, std::int64_t hi, double extent, double buckets) {
    return BucketAxis{static_cast<double>(lo), static_cast<double>(hi),
                      std::max(extent / buckets, 1.0), static_cast<std::uint32_t>(buckets)};
  };
  return {axis(extent_.lo.u, extent_.hi.u, width(), count.u),
          axis(extent_.lo.v, extent_.hi.v, height(), count.v)};
}

}  // namespace strake::hlr
