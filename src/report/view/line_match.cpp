// SPDX-License-Identifier: Apache-2.0
#include "report/view/line_match.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "geometry/bvh/scene_bvh.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::report {
namespace {

using geometry::Vec3d;
using geometry::Vec3l;

constexpr double kMmPerUm = 1e-3;

Vec3d mm(const Vec3l& um) { return um.as<double>() * kMmPerUm; }

/// The classes of the lines at one place, each once, in order.
struct ClassesAtPoint {
  std::vector<DiffLineClass> before, after;
};

void add_once(std::vector<DiffLineClass>& to, const DiffLineClass& cls) {
  const auto at = std::ranges::lower_bound(to, cls);
  if (at == to.end() || *at != cls) to.insert(at, cls);
}

std::vector<DiffLineClass> without(const std::vector<DiffLineClass>& all,
                                   const std::vector<DiffLineClass>& these) {
  std::vector<DiffLineClass> left;
  std::ranges::set_difference(all, these, std::back_inserter(left));
  return left;
}

/// Returns which class of `before` each of `after` was: first those of one object and kind, then
/// those of one object, then as they come. It is the same whichever of the drawings is first.
std::vector<std::pair<DiffLineClass, DiffLineClass>> pair_up(std::vector<DiffLineClass> before,
                                                             std::vector<DiffLineClass> after) {
  std::vector<std::pair<DiffLineClass, DiffLineClass>> pairs;
  for (int strictness = 2; strictness >= 0; --strictness)
    for (std::size_t n = 0; n < after.size();) {
      const DiffLineClass cls = after[n];
      const auto was = std::ranges::find_if(before, [&](const DiffLineClass& o) {
        return (strictness < 1 || o.object == cls.object) && (strictness < 2 || o.kind == cls.kind);
      });
      if (was == before.end()) {
        ++n;
        continue;
      }
      pairs.emplace_back(*was, cls);
      before.erase(was);
      after.erase(after.begin() + static_cast<std::ptrdiff_t>(n));
    }
  return pairs;
}

struct IntervalChange {
  LineChange change = LineChange::same;
  DiffLineClass was;
  friend bool operator==(const IntervalChange&, const IntervalChange&) = default;
};

IntervalChange classify_interval(const ClassesAtPoint& place, const DiffLineClass& cls,
                                 bool after) {
  const auto& theirs = after ? place.before : place.after;
  if (std::ranges::binary_search(theirs, cls)) return {};
  for (const auto& [was, is] :
       pair_up(without(place.before, place.after), without(place.after, place.before)))
    if ((after ? is : was) == cls) return {LineChange::changed, was};
  return {after ? LineChange::added : LineChange::gone, {}};
}

}  // namespace

std::optional<std::pair<double, double>> common_interval(const ViewPiece& piece,
                                                         const ViewPiece& other,
                                                         double tolerance_mm) {
  const Vec3d along = mm(piece.b - piece.a), others = mm(other.b - other.a);
  const Vec3d to_a = mm(other.a - piece.a), to_b = mm(other.b - piece.a);
  const double length = std::sqrt(dot(along, along));
  const double other_length = std::sqrt(dot(others, others));
  if (length <= tolerance_mm) {
    // The piece is a point: does the other pass there?
    const double reach = dot(others, others);
    const double at = reach > 0 ? std::clamp(-dot(to_a, others) / reach, 0.0, 1.0) : 0.0;
    const Vec3d off = to_a + others * at;
    if (dot(off, off) > tolerance_mm * tolerance_mm) return std::nullopt;
    return std::pair(0.0, length);
  }
  const Vec3d unit = along * (1 / length);
  const Vec3d cross = geometry::cross(unit, others);
  const double shorter = std::min(length, other_length);
  // |cross| is the sine times the other's length.
  if (shorter > 0 && std::sqrt(dot(cross, cross)) * shorter > 2 * tolerance_mm * other_length)
    return std::nullopt;
  const double s0 = dot(to_a, unit), s1 = dot(to_b, unit);
  const double from = std::max(0.0, std::min(s0, s1)), to = std::min(length, std::max(s0, s1));
  if (from > to + tolerance_mm) return std::nullopt;
  // The distance of the other, as a line, is off(s) = p + q (s - s0), at most the tolerance between
  // the roots.
  const Vec3d p = to_a - unit * s0;
  const double run = s1 - s0;
  const Vec3d q = run != 0 ? (to_b - unit * s1 - p) * (1 / run) : Vec3d{};
  const double a = dot(q, q), b = dot(p, q), c = dot(p, p) - tolerance_mm * tolerance_mm;
  if (a * length * length < 1e-6 * tolerance_mm * tolerance_mm) {
    // They are parallel, but for what does not matter.
    if (c > 0) return std::nullopt;
    return std::pair(std::min(from, to), std::max(from, to));
  }
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  const double lo = std::max(from, s0 + (-b - root) / a), hi = std::min(to, s0 + (-b + root) / a);
  if (lo > hi) return std::nullopt;
  return std::pair(lo, hi);
}

void append_diff_intervals(std::vector<DiffInterval>& out, std::uint32_t piece, double length_mm,
                           const DiffLineClass& cls, bool after,
                           std::span<const CoveredInterval> covers, double tolerance_mm) {
  const std::size_t first = out.size();
  std::vector<double> cuts{0, length_mm};
  for (const CoveredInterval& cover : covers) {
    cuts.push_back(cover.from_mm);
    cuts.push_back(cover.to_mm);
  }
  std::ranges::sort(cuts);
  // Ends that rounding moved apart are one: what is left between two cuts is longer than that.
  std::vector<double> kept{0};
  for (const double cut : cuts)
    if (cut > kept.back() + tolerance_mm && cut + tolerance_mm < length_mm) kept.push_back(cut);
  kept.push_back(length_mm);
  IntervalChange last;
  for (std::size_t i = 0; i + 1 < kept.size(); ++i) {
    const double middle = kept[i] + (kept[i + 1] - kept[i]) / 2;
    ClassesAtPoint place;
    add_once(after ? place.after : place.before, cls);
    for (const CoveredInterval& cover : covers)
      if (cover.from_mm <= middle + tolerance_mm / 2 && middle <= cover.to_mm + tolerance_mm / 2)
        add_once(cover.after ? place.after : place.before, cover.cls);
    const IntervalChange verdict = classify_interval(place, cls, after);
    const double scale = length_mm > 0 ? 1 / length_mm : 0;
    const auto to = i + 2 == kept.size() ? 1.0F : static_cast<float>(kept[i + 1] * scale);
    if (out.size() > first && verdict == last)
      out.back().to = to;
    else
      out.push_back({piece, static_cast<float>(kept[i] * scale), to, verdict.change, verdict.was});
    last = verdict;
  }
}

namespace {

using geometry::Box3l;

/// The most pairs of boxes that overlap, 8 bytes each.
constexpr std::uint64_t kMaxPairs = std::uint64_t{1} << 28U;

auto key(const ClassedPiece& p) {
  const auto& [least, largest] = std::minmax(p.piece->a, p.piece->b);
  return std::tuple(Vec3l(least), Vec3l(largest), p.cls);
}

Box3l box_of(const ViewPiece& piece, std::int64_t margin) {
  Box3l box = geometry::empty_box<std::int64_t>();
  box.include(piece.a);
  box.include(piece.b);
  for (int k = 0; k < 3; ++k) {
    box.lo[k] -= margin;
    box.hi[k] += margin;
  }
  return box;
}

}  // namespace

std::vector<std::uint8_t> find_equal_pieces(std::span<const ClassedPiece> pieces) {
  std::vector<std::uint32_t> before, after;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) (pieces[i].after ? after : before).push_back(i);
  const auto by_key = [&](std::uint32_t i) { return key(pieces[i]); };
  std::ranges::sort(before, {}, by_key);
  std::ranges::sort(after, {}, by_key);
  std::vector<std::uint8_t> twins(pieces.size());
  auto a = before.begin();
  auto b = after.begin();
  while (a != before.end() && b != after.end()) {
    const auto order = by_key(*a) <=> by_key(*b);
    if (order < 0) {
      ++a;
    } else if (order > 0) {
      ++b;
    } else {
      // They are of one class at one place, however often.
      const auto same = by_key(*a);
      for (; a != before.end() && by_key(*a) == same; ++a) twins[*a] = 1;
      for (; b != after.end() && by_key(*b) == same; ++b) twins[*b] = 1;
    }
  }
  return twins;
}

Result<std::vector<PieceCoverage>> find_coverage(std::span<const ClassedPiece> pieces,
                                                 std::span<const std::uint8_t> has_equal,
                                                 double tolerance_mm,
                                                 const parallel::Context& context) {
  const auto margin = static_cast<std::int64_t>(std::ceil(tolerance_mm * 1000));
  Box3l searched = geometry::empty_box<std::int64_t>();
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (has_equal[i] == 0) searched.include(box_of(*pieces[i].piece, margin));
  if (searched.empty()) return std::vector<PieceCoverage>{};
  std::vector<geometry::BoxItem> items(pieces.size());
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const Box3l box = box_of(*pieces[i].piece, margin);
    items[i] = {box.meets(searched) ? box : geometry::empty_box<std::int64_t>(), i,
                static_cast<std::uint8_t>(has_equal[i] != 0 ? geometry::kSetB
                                                            : geometry::kSetA | geometry::kSetB)};
  }
  const auto tree = geometry::SceneBvh::build(items, context);
  if (!tree) return tree.error();
  const auto pairs = geometry::overlapping_box_pairs(*tree, context, kMaxPairs);
  if (!pairs) return pairs.error();
  auto covers = parallel::collect<PieceCoverage>(
      context, {.name = "lines at one place", .n = pairs->size(), .grain = 1024},
      [&](std::size_t i, std::vector<PieceCoverage>& out) {
        const auto [first, second] = (*pairs)[i];
        for (const auto& [of, by] : {std::pair(first, second), std::pair(second, first)}) {
          if (has_equal[of] != 0) continue;
          const auto interval = common_interval(*pieces[of].piece, *pieces[by].piece, tolerance_mm);
          if (interval)
            out.push_back(
                {of, {interval->first, interval->second, pieces[by].cls, pieces[by].after}});
        }
      });
  if (!covers) return covers.error();
  std::ranges::sort(*covers, {}, [](const PieceCoverage& c) {
    return std::tuple(c.of, c.cover.from_mm, c.cover.to_mm, c.cover.after, c.cover.cls);
  });
  return covers;
}

}  // namespace strake::report
