// SPDX-License-Identifier: Apache-2.0
#include "hlr/parts/split_view.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "hlr/incremental/bounds_projection.hpp"
#include "hlr/incremental/solid_boxes.hpp"
#include "hlr/view/view_bvh.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;

constexpr std::size_t kObjectsAtOnce = 1024;
/// What lines take of a worker, beside a body that only hides: a ship has forty pieces an object.
constexpr std::uint64_t kBytesOfLines = 8000;

/// Where an object may be seen.
struct PaperReach {
  std::int64_t u = 0, v = 0;  ///< the middle of its box on paper
};

class ViewSplitter {
 public:
  ViewSplitter(const ViewToSplit& whole, std::uint64_t most_bytes, const parallel::Context& context)
      : whole_(whole),
        most_bytes_(most_bytes),
        context_(context),
        paper_(whole.view, whole.drawn),
        crosses_(whole.options.intersections != Intersections::off),
        hides_(whole.options.stage == Stage::global) {}

  Result<std::vector<ViewPart>> run() {
    std::vector<std::uint32_t> all;
    bool fits = true;
    for (std::uint32_t o = 0; o < whole_.boxes.size(); ++o) {
      if (whole_.boxes[o].empty()) continue;
      all.push_back(o);
      fits = fits && paper_.reaches(whole_.boxes[o]);
    }
    // What lies too far off for this view is an error, which its part tells.
    if (!fits) most_bytes_ = UINT64_MAX;
    if (fits)
      if (const Status placed = place_on_paper(all); !placed) return placed.error();
    if (const Status status = split(all, part_of(all, all, {})); !status) return status.error();
    return std::move(parts_);
  }

 private:
  Status place_on_paper(const std::vector<std::uint32_t>& all) {
    auto on_paper = parallel::transform(
        context_, {.name = "objects on paper", .n = whole_.boxes.size(), .grain = kObjectsAtOnce},
        [&](std::size_t o) {
          const Box3l& box = whole_.boxes[o];
          return box.empty() ? ViewBox() : paper_.box_of(box.inflated(kRounded));
        });
    if (!on_paper) return on_paper.error();
    on_paper_ = std::move(*on_paper);
    places_.resize(whole_.boxes.size());
    for (const std::uint32_t o : all) {
      const ViewBox& box = on_paper_[o];
      if (!box.empty())
        places_[o] = {box.lo.u + (box.hi.u - box.lo.u) / 2, box.lo.v + (box.hi.v - box.lo.v) / 2};
    }
    return {};
  }

  /// Returns the part that asks for some of these objects; `needed` says by place which others it
  /// has.
  [[nodiscard]] ViewPart part_of(const std::vector<std::uint32_t>& asked,
                                 const std::vector<std::uint32_t>& objects,
                                 const std::vector<bool>& needed) const {
    ViewPart part;
    auto next = asked.begin();
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const std::uint32_t object = objects[i];
      const bool is_asked = next != asked.end() && *next == object;
      if (is_asked) ++next;
      if (!is_asked && !needed[i]) continue;
      part.objects.push_back(object);
      part.asked.push_back(is_asked);
      part.bytes += bytes_in_part(whole_.bytes[object], is_asked);
    }
    return part;
  }

  /// Finds what of some objects may hide or cross those that are asked for.
  [[nodiscard]] Result<ViewPart> find_part(const std::vector<std::uint32_t>& asked,
                                           const std::vector<std::uint32_t>& objects) const {
    std::vector<SegmentQuery> queries;
    std::vector<Box3l> boxes;
    for (const std::uint32_t o : asked) {
      if (hides_ && !on_paper_[o].empty()) queries.push_back(anything_in(on_paper_[o]));
      if (crosses_) boxes.push_back(whole_.boxes[o]);
    }
    const OccludeeTree hideable(std::move(queries));
    const SolidBoxes solid(std::move(boxes));
    const auto needed = parallel::transform(
        context_, {.name = "what a part needs", .n = objects.size(), .grain = kObjectsAtOnce},
        [&](std::size_t i) -> std::uint8_t {
          const std::uint32_t o = objects[i];
          const bool any = (hides_ && hideable.may_be_hidden_by(on_paper_[o])) ||
                           (crosses_ && solid.any_meets(whole_.boxes[o])) || holds_eye(o);
          return any ? 1 : 0;
        });
    if (!needed) return needed.error();
    return part_of(asked, objects, std::vector<bool>(needed->begin(), needed->end()));
  }

  /// What the eye lies in is reported.
  [[nodiscard]] bool holds_eye(std::uint32_t object) const {
    const auto& perspective = whole_.view.perspective;
    return perspective && whole_.boxes[object].contains({perspective->eye, perspective->eye});
  }

  /// Returns the two halves of some objects along the side of the paper where they lie farther
  /// apart, each ascending.
  [[nodiscard]] std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> halves(
      std::vector<std::uint32_t> asked) const {
    const auto spread = [&](auto along) {
      const auto [least, most] = std::ranges::minmax_element(
          asked, {}, [&](std::uint32_t o) { return places_[o].*along; });
      return places_[*most].*along - places_[*least].*along;
    };
    const auto along =
        spread(&PaperReach::u) >= spread(&PaperReach::v) ? &PaperReach::u : &PaperReach::v;
    const auto half = asked.begin() + static_cast<std::ptrdiff_t>(asked.size() / 2);
    std::nth_element(asked.begin(), half, asked.end(), [&](std::uint32_t x, std::uint32_t y) {
      const std::int64_t of_x = places_[x].*along, of_y = places_[y].*along;
      return of_x != of_y ? of_x < of_y : x < y;
    });
    std::vector<std::uint32_t> second(half, asked.end());
    asked.erase(half, asked.end());
    std::ranges::sort(asked);
    std::ranges::sort(second);
    return {std::move(asked), std::move(second)};
  }

  /// Splits a part, as long as one of its halves is smaller for it.
  Status split(const std::vector<std::uint32_t>& asked, ViewPart part) {
    if (part.bytes <= most_bytes_ || asked.size() < 2) {
      parts_.push_back(std::move(part));
      return {};
    }
    const auto [first, second] = halves(asked);
    auto of_first = find_part(first, part.objects);
    if (!of_first) return of_first.error();
    auto of_second = find_part(second, part.objects);
    if (!of_second) return of_second.error();
    if (std::min(of_first->bytes, of_second->bytes) / 8 >= part.bytes / 9) {
      parts_.push_back(std::move(part));
      return {};
    }
    part = {};
    if (const Status status = split(first, std::move(*of_first)); !status) return status;
    return split(second, std::move(*of_second));
  }

  const ViewToSplit& whole_;
  std::uint64_t most_bytes_;
  const parallel::Context& context_;
  BoundsProjection paper_;
  bool crosses_, hides_;
  std::vector<ViewBox> on_paper_;  ///< by object
  std::vector<PaperReach> places_;
  std::vector<ViewPart> parts_;
};

}  // namespace

std::uint64_t bytes_in_part(std::uint32_t bytes, bool asked) {
  return 2 * std::uint64_t{bytes} + (asked ? kBytesOfLines : 0);
}

Result<std::vector<ViewPart>> split_view(const ViewToSplit& whole, std::uint64_t most_bytes,
                                         const parallel::Context& context) {
  return ViewSplitter(whole, most_bytes, context).run();
}

}  // namespace strake::hlr
