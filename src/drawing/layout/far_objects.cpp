// SPDX-License-Identifier: Apache-2.0
#include "drawing/layout/far_objects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "core/number.hpp"
#include "core/parting.hpp"
#include "drawing/layout/expected_extent.hpp"

namespace strake::drawing {

namespace {

/// Without the far ones a view is smaller by more than this, the largest step between usual scales.
constexpr double kShrinks = 2.5;

/// Returns how many of so many boxes may be far.
std::size_t max_far(std::size_t boxes) {
  constexpr std::size_t kFew = 10, kFewOf = 5, kPerThousand = 1000;
  return std::max(boxes / kPerThousand, std::min(kFew, boxes / kFewOf));
}

double size_of(const PlaneBox& box) { return std::max(box.width(), box.height()); }

/// Returns the distance of two boxes along the axis along which it is larger; negative where they
/// meet along both.
double gap_between(const PlaneBox& a, const PlaneBox& b) {
  return std::max(std::max(a.left - b.right, b.left - a.right),
                  std::max(a.bottom - b.top, b.bottom - a.top));
}

double median(std::vector<double> values) {
  return nth_value(std::span(values), values.size() / 2);
}

/// The boxes that are not empty, those first that may be far, in the order of far_boxes().
class FarthestFirst {
 public:
  explicit FarthestFirst(std::span<const PlaneBox> boxes) : boxes_(boxes) {
    std::vector<double> x, y;
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      if (boxes[b].left > boxes[b].right) continue;
      order_.push_back({0, b});
      x.push_back(boxes[b].left / 2 + boxes[b].right / 2);
      y.push_back(boxes[b].bottom / 2 + boxes[b].top / 2);
    }
    limit_ = max_far(order_.size());
    if (limit_ == 0) return;
    const double at_x = median(std::move(x)), at_y = median(std::move(y));
    for (auto& [near, b] : order_)
      near = -std::max({at_x - boxes[b].left, boxes[b].right - at_x, at_y - boxes[b].bottom,
                        boxes[b].top - at_y});
    std::ranges::partial_sort(order_, order_.begin() + static_cast<std::ptrdiff_t>(limit_));
  }

  /// Returns how many of the first are far.
  [[nodiscard]] std::size_t far() const {
    const std::vector<PlaneBox> rest = without_the_first();
    std::size_t far = 0;
    for (std::size_t n = 1; n < rest.size(); ++n)
      if (size_of(rest[n]) * kShrinks < size_of(rest[far]) && lie_apart(far, n, rest[n])) far = n;
    return far;
  }

  [[nodiscard]] std::size_t at(std::size_t n) const { return order_[n].second; }

 private:
  /// Returns the box of all but the first n, for each n that may be far.
  [[nodiscard]] std::vector<PlaneBox> without_the_first() const {
    std::vector<PlaneBox> rest(limit_ + 1, kNoPlaneBox);
    for (std::size_t n = limit_; n < order_.size(); ++n) rest[limit_].include(boxes_[at(n)]);
    for (std::size_t n = limit_; n-- > 0;) {
      rest[n] = rest[n + 1];
      rest[n].include(boxes_[at(n)]);
    }
    return rest;
  }

  [[nodiscard]] bool lie_apart(std::size_t from, std::size_t to, const PlaneBox& rest) const {
    for (std::size_t n = from; n < to; ++n)
      if (gap_between(boxes_[at(n)], rest) < size_of(rest)) return false;
    return true;
  }

  std::span<const PlaneBox> boxes_;
  std::vector<std::pair<double, std::size_t>> order_;  ///< distance, negative, and index
  std::size_t limit_ = 0;
};

/// Returns a distance with three digits, or as many as the whole number has: "85 mm", "12.3 m".
std::string distance_text(double mm) {
  const double value = mm >= 1e6 ? mm / 1e6 : mm >= 1e3 ? mm / 1e3 : mm;
  const int decimals = value < 10 ? 2 : value < 100 ? 1 : 0;
  return fixed(value, decimals) + (mm >= 1e6 ? " km" : mm >= 1e3 ? " m" : " mm");
}

}  // namespace

std::vector<std::size_t> far_boxes(std::span<const PlaneBox> boxes) {
  const FarthestFirst order(boxes);
  std::vector<std::size_t> far(order.far());
  for (std::size_t n = 0; n < far.size(); ++n) far[n] = order.at(n);
  return far;
}

Result<FarObjects> find_far_objects(const model::Scene& scene, const std::vector<bool>& drawn,
                                    const hlr::View& view, const parallel::Context& context) {
  if (view.perspective) return FarObjects{};
  Result<std::vector<PlaneBox>> boxes = expected_boxes(scene, drawn, view, context);
  if (!boxes) return boxes.error();
  FarObjects found;
  const std::vector<std::size_t> far = far_boxes(*boxes);
  if (far.empty()) return found;
  const PlaneBox farthest = (*boxes)[far.front()];
  found.whole = found.rest = kNoPlaneBox;
  for (const PlaneBox& box : *boxes) found.whole.include(box);
  for (const std::size_t object : far) {
    found.objects.push_back(model::ObjectId{static_cast<std::uint32_t>(object)});
    (*boxes)[object] = kNoPlaneBox;
  }
  for (const PlaneBox& box : *boxes) found.rest.include(box);
  found.distance_mm = gap_between(farthest, found.rest);
  return found;
}

void leave_out(const FarObjects& far, const model::Model& model, std::vector<bool>& drawn) {
  if (far.objects.empty()) return;
  if (drawn.empty()) drawn.assign(model.objects.size(), true);
  for (const model::ObjectId object : far.objects) drawn[model::index(object)] = false;
}

std::string far_objects_text(const FarObjects& far, const model::Model& model) {
  const model::Object& object = model.object(far.objects.front());
  const std::string name = fmt::format("'{}' ({})", object.name.empty() ? object.id : object.name,
                                       model.files[object.file].label);
  const std::string distance = distance_text(far.distance_mm);
  if (far.objects.size() == 1) return fmt::format("{} lies {} from the rest", name, distance);
  return fmt::format("{} objects, {} the farthest, lie up to {} from the rest", far.objects.size(),
                     name, distance);
}

}  // namespace strake::drawing
