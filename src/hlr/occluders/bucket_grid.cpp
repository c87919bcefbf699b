// SPDX-License-Identifier: Apache-2.0
// The choice of a grid's size, and the grid: filling it and traversing it.
#include "hlr/occluders/bucket_grid.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "hlr/edges/element_loop.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::hlr {
namespace {

/// The most buckets and entries per box of any grid, and of a grid whose size is chosen. For
/// an imported machine of a million faces gathering takes 3.2, 1.6 and 1.3 CPU s with 64, 256 and
/// 1,024 buckets along a side; 256 are chosen, since making a million takes longer than they spare
/// (decision 0029).
constexpr double kMaxPerBox = 64, kChosenPerBox = 8;
/// The cost of a step to the next bucket, in boxes examined. With 1 and 4 an isometric view of
/// 3,000 objects takes the same instructions.
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

// There are fewer buckets along the shorter side.
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
  for (std::uint32_t side = 1; side <= Options::kMaxBuckets && fits(side, kChosenPerBox);
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
  side = std::clamp<std::uint32_t>(side, 1, Options::kMaxBuckets);
  while (!fits(side, kMaxPerBox)) side /= 2;
  const Sides count = sides(side);
  const auto axis = [](std::int64_t lo, std::int64_t hi, double extent, double buckets) {
    return BucketAxis{static_cast<double>(lo), static_cast<double>(hi),
                      std::max(extent / buckets, 1.0), static_cast<std::uint32_t>(buckets)};
  };
  return {axis(extent_.lo.u, extent_.hi.u, width(), count.u),
          axis(extent_.lo.v, extent_.hi.v, height(), count.v)};
}

namespace {

/// Returns a float that is no less.
float no_less(std::int64_t x) {
  return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

}  // namespace

/// Distributes boxes to buckets, in a few runs of boxes, each with counts of its own: the entries
/// of a bucket are those of the first run, then those of the second, and so in the order of the
/// boxes.
class BucketGrid::Dealer {
 public:
  Dealer(std::span<const ViewBox> boxes, BucketGrid& to, const parallel::Context& context)
      : boxes_(boxes),
        to_(to),
        context_(context),
        buckets_(std::size_t{to.axes_.u.count} * to.axes_.v.count),
        runs_(std::clamp<std::size_t>(
            std::min(boxes.size() / kBigShape, 4 * boxes.size() / buckets_), 1, 16)),
        next_(buckets_ * runs_, 0) {}

  Status run() {
    const Status counted = in_runs([&](std::size_t run) {
      each_entry(run, [&](std::uint32_t& next, const Entry&) { ++next; });
    });
    if (!counted) return counted;
    if (const Status s = find_places(); !s) return s;
    const Status dealt = in_runs([&](std::size_t run) {
      each_entry(run,
                 [&](std::uint32_t& next, const Entry& entry) { to_.entries_[next++] = entry; });
    });
    if (!dealt) return dealt;
    return parallel::for_each(
        context_, over_elements("hidden lines: buckets sorted", buckets_), [&](std::size_t b) {
          const auto own =
              std::span(to_.entries_).subspan(to_.first_[b], to_.first_[b + 1] - to_.first_[b]);
          std::ranges::sort(own, [](const Entry& x, const Entry& y) {
            return x.nearest != y.nearest ? x.nearest > y.nearest : x.item < y.item;
          });
        });
  }

 private:
  template <class Body>
  Status in_runs(Body&& body) {
    return parallel::for_each(runs_ == 1 ? parallel::Context{.stop = context_.stop} : context_,
                              {.name = "hidden lines: buckets", .n = runs_}, body);
  }

  template <class Use>
  void each_entry(std::size_t run, Use&& use) {
    const BucketAxis &u = to_.axes_.u, &v = to_.axes_.v;
    std::uint32_t* const next = next_.data() + run * buckets_;
    const std::size_t last = boxes_.size() * (run + 1) / runs_;
    for (std::size_t b = boxes_.size() * run / runs_; b < last; ++b) {
      const ViewBox& box = boxes_[b];
      if (box.empty()) continue;
      const Entry entry{static_cast<std::uint32_t>(b), no_less(box.hi.w)};
      const std::uint32_t u0 = u.cell(static_cast<double>(box.lo.u));
      const std::uint32_t u1 = u.cell(static_cast<double>(box.hi.u));
      const std::uint32_t v1 = v.cell(static_cast<double>(box.hi.v));
      for (std::uint32_t j = v.cell(static_cast<double>(box.lo.v)); j <= v1; ++j)
        for (std::uint32_t i = u0; i <= u1; ++i) use(next[std::size_t{j} * u.count + i], entry);
    }
  }

  // Turns counts into the place where each run starts in each bucket.
  Status find_places() {
    to_.first_.resize(buckets_ + 1);
    std::uint32_t sum = 0;
    for (std::size_t b = 0; b < buckets_; ++b) {
      to_.first_[b] = sum;
      for (std::size_t run = 0; run < runs_; ++run)
        sum += std::exchange(next_[run * buckets_ + b], sum);
    }
    to_.first_[buckets_] = sum;
    auto entries = parallel::slots<Entry>(sum, context_);
    if (!entries) return entries.error();
    to_.entries_ = std::move(*entries);
    return {};
  }

  std::span<const ViewBox> boxes_;
  BucketGrid& to_;
  const parallel::Context& context_;
  std::size_t buckets_, runs_;
  std::vector<std::uint32_t> next_;  ///< next entry by run and bucket
};

Result<BucketGrid> BucketGrid::of(std::span<const ViewBox> boxes, const BucketAxes& axes,
                                  const parallel::Context& context) {
  BucketGrid made;
  made.axes_ = axes;
  made.items_ = boxes.size();
  if (const Status s = Dealer(boxes, made, context).run(); !s) return s.error();
  return made;
}

double BucketGrid::crowding() const {
  double squares = 0;
  for (std::size_t b = 0; b + 1 < first_.size(); ++b) {
    const auto count = static_cast<double>(first_[b + 1] - first_[b]);
    squares += count * count;
  }
  const auto entries = static_cast<double>(entries_.size());
  return entries > 0 ? squares / entries : 0;
}

BucketGrid::Cells BucketGrid::across(const SegmentQuery& s, bool steep, std::uint32_t i) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const BucketAxis& along = steep ? axes_.v : axes_.u;
  const BucketAxis& to_side = steep ? axes_.u : axes_.v;
  const double lo = steep ? s.u0 : s.v0, hi = steep ? s.u1 : s.v1;
  const double from = steep ? s.av : s.au, step = steep ? s.dv : s.du;
  // The line is unknown, or a point.
  if (step == 0) return {to_side.cell(lo), to_side.cell(hi)};
  const double at = steep ? s.au : s.av, slope = (steep ? s.du : s.dv) / step;
  // The first and the last bucket extend to infinity.
  const double begin = i == 0 ? -kInfinity : along.lo + along.size * i;
  const double end = i + 1 == along.count ? kInfinity : along.lo + along.size * (i + 1);
  const double least = std::max(begin, steep ? s.v0 : s.u0);
  const double largest = std::min(end, steep ? s.v1 : s.u1);
  const double p = at + (least - from) * slope, q = at + (largest - from) * slope;
  // The bound of rounding of the bucket's sides and of the line; |slope| <= 1.
  const double slack = 1e-12 * (std::abs(at) + std::abs(from) + std::abs(least) +
                                std::abs(largest) + std::abs(along.lo) + std::abs(along.hi)) +
                       s.beside / std::abs(step);
  return {to_side.cell(std::max(lo, std::min(p, q) - slack)),
          to_side.cell(std::min(hi, std::max(p, q) + slack))};
}

}  // namespace strake::hlr
