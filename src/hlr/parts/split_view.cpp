// SPDX-License-Identifier: Apache-2.0
#include "hlr/parts/split_view.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "core/parting.hpp"
#include "hlr/incremental/bounds_projection.hpp"
#include "hlr/incremental/solid_boxes.hpp"
#include "hlr/view/view_bvh.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;

constexpr std::size_t kObjectsAtOnce = 1024;
/// What lines take of a worker, beside a body that only hides: a ship has forty pieces an object,
/// of which few stay where hidden ones are left out.
constexpr std::uint64_t kBytesOfLines = 8000, kBytesOfVisibleLines = 2000;

/// Where an object may be seen.
struct PaperReach {
  std::int64_t u = 0, v = 0;  ///< the middle of its box on paper
};

class ViewSplitter {
 public:
  ViewSplitter(const ViewToSplit& whole, std::uint64_t max_bytes, const parallel::Context& context)
      : whole_(whole),
        max_bytes_(max_bytes),
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
    if (!fits) max_bytes_ = UINT64_MAX;
    if (fits)
      if (const Status placed = place_on_paper(all); !placed) return placed.error();
    if (const Status status = split(all, all); !status) return status.error();
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
    // Boxes that meet in space overlap on paper, and neither lies behind the other: what may hide
    // an object has among it what may cross it.
    if (hides_ && !whole_.view.perspective &&
        std::ranges::none_of(all, [&](std::uint32_t o) { return on_paper_[o].empty(); }))
      crosses_ = false;
    for (const std::uint32_t o : all) {
      const ViewBox& box = on_paper_[o];
      if (!box.empty())
        places_[o] = {box.lo.u + (box.hi.u - box.lo.u) / 2, box.lo.v + (box.hi.v - box.lo.v) / 2};
    }
    return {};
  }

  /// Returns what a worker takes for an object.
  [[nodiscard]] std::uint64_t bytes_of(std::uint32_t object, bool to_solve) const {
    const std::uint64_t lines = whole_.options.hidden ? kBytesOfLines : kBytesOfVisibleLines;
    return 2 * std::uint64_t{whole_.bytes[object]} + (to_solve ? lines : 0);
  }

  /// Returns by place in `objects` which of them are among those that are requested; both ascend.
  static std::vector<bool> solve_flags(const std::vector<std::uint32_t>& objects,
                                       const std::vector<std::uint32_t>& to_solve) {
    std::vector<bool> is_to_solve(objects.size());
    auto next = to_solve.begin();
    for (std::size_t i = 0; i < objects.size() && next != to_solve.end(); ++i) {
      is_to_solve[i] = *next == objects[i];
      if (is_to_solve[i]) ++next;
    }
    return is_to_solve;
  }

  /// Returns the part of the objects that `has` picks by place.
  template <class Has>
  [[nodiscard]] ViewPart part_of(const std::vector<std::uint32_t>& objects,
                                 const std::vector<bool>& is_to_solve, Has&& has) const {
    ViewPart part;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (!has(i)) continue;
      part.objects.push_back(objects[i]);
      part.to_solve.push_back(is_to_solve[i]);
      part.bytes += bytes_of(objects[i], is_to_solve[i]);
    }
    return part;
  }

  /// Finds what of some objects may hide or cross those that are requested.
  [[nodiscard]] Result<ViewPart> find_part(const std::vector<std::uint32_t>& to_solve,
                                           const std::vector<std::uint32_t>& objects) const {
    const std::vector<bool> is_to_solve = solve_flags(objects, to_solve);
    if (to_solve.size() == objects.size())
      return part_of(objects, is_to_solve, [](std::size_t) { return true; });
    std::vector<SegmentQuery> queries;
    std::vector<Box3l> boxes;
    for (const std::uint32_t o : to_solve) {
      if (hides_ && !on_paper_[o].empty()) queries.push_back(anything_in(on_paper_[o]));
      if (crosses_) boxes.push_back(whole_.boxes[o]);
    }
    const OccludeeTree hideable(std::move(queries));
    const SolidBoxes solid(std::move(boxes));
    const auto needed = parallel::transform(
        context_, {.name = "what a part needs", .n = objects.size(), .grain = kObjectsAtOnce},
        [&](std::size_t i) -> std::uint8_t {
          if (is_to_solve[i]) return 1;
          const std::uint32_t o = objects[i];
          const bool any = (hides_ && hideable.may_be_hidden_by(on_paper_[o])) ||
                           (crosses_ && solid.any_meets(whole_.boxes[o])) || holds_eye(o);
          return any ? 1 : 0;
        });
    if (!needed) return needed.error();
    return part_of(objects, is_to_solve, [&](std::size_t i) { return (*needed)[i] != 0; });
  }

  /// Finds those of some objects that find_part() may pick, and others, by the box of all that is
  /// requested: in a small part of the time.
  [[nodiscard]] Result<std::vector<std::uint32_t>> near(
      const std::vector<std::uint32_t>& to_solve, const std::vector<std::uint32_t>& objects) const {
    ViewBox on_paper;
    Box3l box = geometry::empty_box<std::int64_t>();
    for (const std::uint32_t o : to_solve) {
      if (!on_paper_[o].empty()) on_paper.include(on_paper_[o]);
      box.include(whole_.boxes[o]);
    }
    const SegmentQuery hideable = on_paper.empty() ? SegmentQuery() : anything_in(on_paper);
    const std::vector<bool> is_to_solve = solve_flags(objects, to_solve);
    const auto needed = parallel::transform(
        context_, {.name = "what is near a part", .n = objects.size(), .grain = kObjectsAtOnce},
        [&](std::size_t i) -> std::uint8_t {
          const std::uint32_t o = objects[i];
          const bool hides = hides_ && !on_paper.empty() && !on_paper_[o].empty() &&
                             hideable.may_be_hidden_by(rounded_outwards(on_paper_[o]));
          return is_to_solve[i] || hides || (crosses_ && whole_.boxes[o].meets(box)) ||
                 holds_eye(o);
        });
    if (!needed) return needed.error();
    std::vector<std::uint32_t> found;
    for (std::size_t i = 0; i < objects.size(); ++i)
      if ((*needed)[i] != 0) found.push_back(objects[i]);
    return found;
  }

  /// What the eye lies in is reported.
  [[nodiscard]] bool holds_eye(std::uint32_t object) const {
    const auto& perspective = whole_.view.perspective;
    return perspective && whole_.boxes[object].contains({perspective->eye, perspective->eye});
  }

  /// Returns the two halves of some objects along the side of the paper where they lie farther
  /// apart, each ascending.
  [[nodiscard]] std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> halves(
      const std::vector<std::uint32_t>& to_solve) const {
    const auto spread = [&](auto along) {
      const auto [least, largest] = std::ranges::minmax_element(
          to_solve, {}, [&](std::uint32_t o) { return places_[o].*along; });
      return places_[*largest].*along - places_[*least].*along;
    };
    const auto along =
        spread(&PaperReach::u) >= spread(&PaperReach::v) ? &PaperReach::u : &PaperReach::v;
    const auto before = [&](std::uint32_t x, std::uint32_t y) {
      const std::int64_t of_x = places_[x].*along, of_y = places_[y].*along;
      return of_x != of_y ? of_x < of_y : x < y;
    };
    std::vector<std::uint32_t> by_place = to_solve;
    const std::size_t half = by_place.size() / 2;
    part_at(std::span(by_place), half, before);
    std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> parted;
    for (const std::uint32_t o : to_solve)
      (before(o, by_place[half]) ? parted.first : parted.second).push_back(o);
    return parted;
  }

  /// Returns what a worker takes for the lines of some objects, of which `objects` are all that it
  /// has.
  [[nodiscard]] std::uint64_t bytes_of(const std::vector<std::uint32_t>& to_solve,
                                       const std::vector<std::uint32_t>& objects) const {
    std::uint64_t bytes = 0;
    for (const std::uint32_t o : objects) bytes += bytes_of(o, false);
    for (const std::uint32_t o : to_solve) bytes += bytes_of(o, true) - bytes_of(o, false);
    return bytes;
  }

  /// Whether neither half is smaller, to speak of, than the whole.
  static bool gains_nothing(std::uint64_t first, std::uint64_t second, std::uint64_t whole) {
    return std::min(first, second) / 8 >= whole / 9;
  }

  /// Makes parts for the lines of some objects, of which `objects` has all that is needed.
  Status split(const std::vector<std::uint32_t>& to_solve,
               const std::vector<std::uint32_t>& objects) {
    if (to_solve.size() < 2 || bytes_of(to_solve, to_solve) <= max_bytes_) {
      auto part = find_part(to_solve, objects);
      return part ? split_further(to_solve, std::move(*part)) : part.error();
    }
    const auto [first, second] = halves(to_solve);
    auto near_first = near(first, objects);
    if (!near_first) return near_first.error();
    auto near_second = near(second, objects);
    if (!near_second) return near_second.error();
    if (gains_nothing(bytes_of(first, *near_first), bytes_of(second, *near_second),
                      bytes_of(to_solve, objects))) {
      // What lies near by boxes may not be near by what is drawn of it: that is tested for each
      // half.
      auto part = find_part(to_solve, objects);
      return part ? split_further(to_solve, std::move(*part)) : part.error();
    }
    if (Status status = split(first, *near_first); !status) return status;
    return split(second, *near_second);
  }

  /// Splits a part, as long as one of its halves is smaller for it.
  Status split_further(const std::vector<std::uint32_t>& to_solve, ViewPart part) {
    if (part.bytes <= max_bytes_ || to_solve.size() < 2) {
      parts_.push_back(std::move(part));
      return {};
    }
    const auto [first, second] = halves(to_solve);
    auto of_first = find_part(first, part.objects);
    if (!of_first) return of_first.error();
    auto of_second = find_part(second, part.objects);
    if (!of_second) return of_second.error();
    if (gains_nothing(of_first->bytes, of_second->bytes, part.bytes)) {
      parts_.push_back(std::move(part));
      return {};
    }
    part = {};
    if (Status status = split_further(first, std::move(*of_first)); !status) return status;
    return split_further(second, std::move(*of_second));
  }

  const ViewToSplit& whole_;
  std::uint64_t max_bytes_;
  const parallel::Context& context_;
  BoundsProjection paper_;
  bool crosses_, hides_;           ///< whether what crosses or hides is to be looked for
  std::vector<ViewBox> on_paper_;  ///< by object
  std::vector<PaperReach> places_;
  std::vector<ViewPart> parts_;
};

}  // namespace

Result<std::vector<ViewPart>> split_view(const ViewToSplit& whole, std::uint64_t max_bytes,
                                         const parallel::Context& context) {
  return ViewSplitter(whole, max_bytes, context).run();
}

}  // namespace strake::hlr
