// SPDX-License-Identifier: Apache-2.0
// The removal of coincident lines with equal ends, and building and querying the index.
#include "drawing/collinear/line_index.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::drawing {

namespace {

constexpr std::uint32_t kGone = 0xffffffffU;

struct TwinKey {
  SegmentEnds ends;
  double reach = 0;
  std::uint32_t line = 0;
  KeyedItem* key = nullptr;

  [[nodiscard]] auto twins() const { return std::tie(ends, reach); }
};

/// Removes coincident lines from a run with one key.
void take_out(std::vector<TwinKey>& run, std::span<const PlaneSegment> lines,
              const OverlapRule& rule, parallel::Marks& gone) {
  std::sort(run.begin(), run.end(), [&](const TwinKey& a, const TwinKey& b) {
    if (a.twins() != b.twins()) return a.twins() < b.twins();
    return has_precedence(lines, a.line, b.line);
  });
  for (std::size_t i = 1, first = 0; i < run.size(); ++i) {
    const PlaneSegment& line = lines[run[i].line];
    if (run[i - 1].twins() != run[i].twins()) first = i;
    if (first == i || !can_cover(lines[run[first].line], rule) || !can_be_covered(line, rule))
      continue;
    if (!(line.length() > rule.least)) continue;
    gone.set(run[i].line);
    run[i].key->item = kGone;
  }
}

}  // namespace

Status remove_coincident(std::vector<KeyedItem>& keys, std::span<const PlaneSegment> lines,
                         const OverlapRule& rule, parallel::Marks& gone,
                         const parallel::Context& context) {
  const Status status = parallel::for_each_with(
      context, {.name = "lines with the same ends", .n = keys.size(), .grain = 8192},
      [] { return std::vector<TwinKey>{}; },
      [&](std::vector<TwinKey>& run, std::size_t i) {
        if (i > 0 && keys[i - 1].key == keys[i].key) return;
        std::size_t end = i + 1;
        while (end < keys.size() && keys[end].key == keys[i].key) ++end;
        if (end == i + 1) return;
        run.clear();
        for (std::size_t k = i; k < end; ++k) {
          const PlaneSegment& line = lines[keys[k].item];
          run.push_back({line.ends(), line.reach, keys[k].item, &keys[k]});
        }
        take_out(run, lines, rule, gone);
      });
  if (!status) return status;
  std::erase_if(keys, [](const KeyedItem& k) { return k.item == kGone; });
  return {};
}

namespace {

/// A class of lengths: its shortest lines, in distances; the number of sectors of a half turn; and
/// how many more bits of a key the distance across has than that along.
///
/// A sector is about four times as wide as the angle within which lines of the class can lie on
/// each other: mostly one or two are queried. In the isometric view of a ship of 100,000 objects,
/// 4.4 million lines, finding overlaps takes 2.2 CPU s; in a grid it took 25 (decision 0025).
struct LengthClass {
  double shortest;
  std::uint32_t sectors, first;
  unsigned bits_across;
};
constexpr std::array<LengthClass, LineIndex::kClasses> kLengths = {
    {{0, 1, 0, 0}, {32, 8, 1, 2}, {512, 128, 9, 6}, {8192, 2048, 137, 10}}};
constexpr std::uint32_t kSectors = 137 + 2048;
constexpr double kSmallSine = 0.125;  ///< half a sector of the lowest class that has any
constexpr unsigned kPlaceBits = 52;
// Only shares the work out: between 2048 and 32'768 no difference can be seen (decision 0073).
constexpr std::size_t kGrain = 8192;

/// Returns the direction of a line, whichever way it runs, as a number from 0 to below 2 that grows
/// with the angle, no faster than the angle in radians does.
double slant(double x, double y) {
  if (y < 0 || (y == 0 && x < 0)) {
    x = -x;
    y = -y;
  }
  return x >= 0 ? y / (x + y) : 1 - x / (y - x);
}
double slant(const PlaneSegment& line) { return slant(line.bx - line.ax, line.by - line.ay); }

std::uint32_t sector_at(double slant, const LengthClass& c) {
  return c.first + std::min(c.sectors - 1, static_cast<std::uint32_t>(slant * c.sectors / 2));
}

/// Returns the lower 32 bits with a zero before each.
std::uint64_t spread(std::uint64_t bits) {
  bits &= 0xffffffffU;
  bits = (bits | bits << 16U) & 0x0000ffff0000ffffU;
  bits = (bits | bits << 8U) & 0x00ff00ff00ff00ffU;
  bits = (bits | bits << 4U) & 0x0f0f0f0f0f0f0f0fU;
  bits = (bits | bits << 2U) & 0x3333333333333333U;
  return (bits | bits << 1U) & 0x5555555555555555U;
}

std::uint64_t whole(double share, unsigned bits) {
  const double largest = static_cast<double>(std::uint64_t{1} << bits);
  return static_cast<std::uint64_t>(std::clamp(share * largest, 0.0, largest - 1));
}

struct LineExtent {
  double left = std::numeric_limits<double>::max(), right = -left, low = left, high = -left;
  double reach = 0;
  void add(const PlaneSegment& line) {
    left = std::min({left, line.ax, line.bx});
    right = std::max({right, line.ax, line.bx});
    low = std::min({low, line.ay, line.by});
    high = std::max({high, line.ay, line.by});
    reach = std::max(reach, line.reach);
  }
  void add(const LineExtent& other) {
    left = std::min(left, other.left);
    right = std::max(right, other.right);
    low = std::min(low, other.low);
    high = std::max(high, other.high);
    reach = std::max(reach, other.reach);
  }
};

bool takes_part(const PlaneSegment& line, double least) {
  // A rounding below the least length: lines of just that length are decided where lines are
  // compared.
  constexpr double kBelow = 1 - 1e-9;
  const double length = line.length();
  return line.rank != OverlapRank::none && length > 0 && length > least * kBelow;
}

}  // namespace

Result<LineIndex> LineIndex::build(std::span<const PlaneSegment> lines, const OverlapRule& rule,
                                   parallel::Marks& gone, const parallel::Context& context) {
  LineIndex index;
  index.greatest_sine_ = rule.greatest_sine;
  Status status = index.measure(lines, rule.least, context);
  if (!status) return status.error();
  index.choose_frames(lines, rule.least);
  {
    auto keys = index.sorted(lines, rule.least, context);
    if (!keys) return keys.error();
    status = remove_coincident(*keys, lines, rule, gone, context);
    if (!status) return status.error();
    status = index.take(lines, *keys, context);
    if (!status) return status.error();
  }
  status = index.lay_out_sectors();
  if (!status) return status.error();
  status = index.make_leaves(context);
  if (!status) return status.error();
  status = index.make_nodes(context);
  if (!status) return status.error();
  return index;
}

Status LineIndex::measure(std::span<const PlaneSegment> lines, double least,
                          const parallel::Context& context) {
  const auto extent = parallel::reduce(
      context, {.name = "extent of lines", .n = lines.size(), .grain = kGrain}, LineExtent{},
      [&](LineExtent& e, std::size_t i) {
        if (takes_part(lines[i], least)) e.add(lines[i]);
      },
      [](LineExtent& into, const LineExtent& e) { into.add(e); });
  if (!extent) return extent.error();
  sectors_.resize(kSectors);
  if (extent->left > extent->right) return {};
  const double width = extent->right - extent->left, height = extent->high - extent->low;
  x_ = extent->left + width / 2;
  y_ = extent->low + height / 2;
  radius_ = std::sqrt(width * width + height * height) / 2 * (1 + 1e-6);
  reach_ = 2 * extent->reach;
  // Twice half a unit in the last place of a float, and that of doubles far from the origin.
  pad_ = std::ldexp(radius_, -23) + 1e-14 * (std::fabs(x_) + std::fabs(y_) + radius_);
  return {};
}

/// Takes the axes of a sector from the longest line of a sample: in a model of plates and bars most
/// lines of a sector are exactly parallel, and their boxes are thin along their own axes.
void LineIndex::choose_frames(std::span<const PlaneSegment> lines, double least) {
  for (const LengthClass& c : kLengths)
    for (std::uint32_t k = 0; k < c.sectors; ++k) {
      Sector& sector = sectors_[c.first + k];
      sector.length_class = static_cast<unsigned>(&c - kLengths.data());
      if (c.sectors == 1) continue;
      const double middle = (k + 0.5) * 2 / c.sectors;
      const double x = 1 - middle, y = middle < 1 ? middle : 2 - middle;
      const double length = std::sqrt(x * x + y * y);
      sector.frame = {x / length, y / length};
    }
  constexpr std::size_t kSample = 65536;
  std::vector<double> longest(kSectors, 0);
  for (std::size_t i = 0; i < lines.size(); i += lines.size() / kSample + 1) {
    const PlaneSegment& line = lines[i];
    const double length = line.length();
    if (!takes_part(line, least)) continue;
    const std::uint32_t number = sector_of(line);
    if (number == 0 || length <= longest[number]) continue;
    longest[number] = length;
    sectors_[number].frame = {(line.bx - line.ax) / length, (line.by - line.ay) / length};
  }
}

std::uint32_t LineIndex::sector_of(const PlaneSegment& line) const {
  const double length = line.length();
  unsigned c = kClasses - 1;
  // Where no angle is large the shortest lines have sectors, too: those of the class above.
  const unsigned lowest = greatest_sine_ <= 2 * kSmallSine ? 1 : 0;
  while (c > lowest && !(length >= kLengths[c].shortest * reach_)) --c;
  return kLengths[c].sectors == 1 ? kLengths[c].first : sector_at(slant(line), kLengths[c]);
}

std::uint64_t LineIndex::key_of(const PlaneSegment& line) const {
  const std::uint32_t number = sector_of(line);
  const Sector& sector = sectors_[number];
  const double x = (line.ax - x_ + (line.bx - x_)) / 2, y = (line.ay - y_ + (line.by - y_)) / 2;
  const unsigned extra = kLengths[sector.length_class].bits_across;
  const unsigned bits = (kPlaceBits - extra) / 2;
  const auto share = [&](double at) { return radius_ > 0 ? at / radius_ / 2 + 0.5 : 0; };
  const std::uint64_t u = whole(share(sector.frame.along(x, y)), bits);
  const std::uint64_t v = whole(share(sector.frame.across(x, y)), bits + extra);
  const std::uint64_t low = v & ((std::uint64_t{1} << bits) - 1);
  return std::uint64_t{number} << kPlaceBits | (v >> bits) << (2 * bits) | spread(low) << 1U |
         spread(u);
}

Result<std::vector<KeyedItem>> LineIndex::sorted(std::span<const PlaneSegment> lines, double least,
                                                 const parallel::Context& context) const {
  auto keys = parallel::collect<KeyedItem>(
      context, {.name = "keys of lines", .n = lines.size(), .grain = kGrain},
      [&](std::size_t i, std::vector<KeyedItem>& out) {
        if (takes_part(lines[i], least))
          out.push_back({key_of(lines[i]), static_cast<std::uint32_t>(i)});
      });
  if (!keys) return keys;
  const Status status = radix_sort(*keys, context);
  if (!status) return status.error();
  return keys;
}

Status LineIndex::take(std::span<const PlaneSegment> lines, std::span<const KeyedItem> keys,
                       const parallel::Context& context) {
  std::uint32_t at = 0;
  for (std::uint32_t number = 0; number < kSectors; ++number) {
    sectors_[number].first = at;
    at = static_cast<std::uint32_t>(
        std::partition_point(keys.begin() + at, keys.end(),
                             [&](const KeyedItem& k) { return k.key >> kPlaceBits <= number; }) -
        keys.begin());
    sectors_[number].last = at;
  }
  auto order = parallel::unset_slots<std::uint32_t>(keys.size());
  if (!order) return order.error();
  auto flats = parallel::unset_slots<PlaneSegment>(keys.size());
  if (!flats) return flats.error();
  order_ = std::move(*order);
  flats_ = std::move(*flats);
  return parallel::for_each(context, {.name = "order of lines", .n = keys.size(), .grain = kGrain},
                            [&](std::size_t i) {
                              order_[i] = keys[i].item;
                              flats_[i] = lines[keys[i].item];
                            });
}

Status LineIndex::lay_out_sectors() {
  std::size_t nodes = 0;
  for (Sector& sector : sectors_) {
    sector.nodes = nodes;
    sector.leaf = leaves_;
    std::size_t count = (sector.last - sector.first + kFan - 1) / kFan;
    leaves_ += count;
    for (; count > 0; count = (count + kFan - 1) / kFan) {
      nodes += count;
      if (count == 1) break;
    }
  }
  // Leaves and nodes write all of theirs.
  auto made = parallel::unset_slots<BoxLanes>(nodes);
  if (!made) return made.error();
  nodes_ = std::move(*made);
  return {};
}

LineIndex::Leaf LineIndex::leaf(std::size_t number) const {
  const auto after =
      std::partition_point(sectors_.begin(), sectors_.end(),
                           [&](const Sector& sector) { return sector.leaf <= number; });
  const Sector& sector = *(after - 1);
  const auto first = static_cast<std::uint32_t>(sector.first + (number - sector.leaf) * kFan);
  return {static_cast<std::uint32_t>(&sector - sectors_.data()), first,
          std::min(first + static_cast<std::uint32_t>(kFan), sector.last)};
}

Box2 LineIndex::box_of(const PlaneSegment& line, const SectorAxes& frame) const {
  const double ax = line.ax - x_, ay = line.ay - y_, bx = line.bx - x_, by = line.by - y_;
  const double au = frame.along(ax, ay), bu = frame.along(bx, by);
  const double av = frame.across(ax, ay), bv = frame.across(bx, by);
  return {static_cast<float>(std::min(au, bu) - pad_), static_cast<float>(std::max(au, bu) + pad_),
          static_cast<float>(std::min(av, bv) - pad_), static_cast<float>(std::max(av, bv) + pad_)};
}

Status LineIndex::make_leaves(const parallel::Context& context) {
  return parallel::for_each(
      context, {.name = "boxes of lines", .n = leaves_, .grain = kGrain / kFan},
      [&](std::size_t number) {
        const Leaf of = leaf(number);
        const Sector& sector = sectors_[of.sector];
        BoxLanes& boxes = nodes_[sector.nodes + (number - sector.leaf)];
        for (std::uint32_t k = 0; k < kFan; ++k)
          boxes.set(k, of.first + k < of.last ? box_of(flats_[of.first + k], sector.frame)
                                              : Box2::nothing());
      });
}

Status LineIndex::make_nodes(const parallel::Context& context) {
  return parallel::for_each(
      context, {.name = "tree of lines", .n = sectors_.size(), .grain = 16},
      [&](std::size_t number) {
        const Sector& sector = sectors_[number];
        std::size_t base = sector.nodes, count = (sector.last - sector.first + kFan - 1) / kFan;
        while (count > 1) {
          const std::size_t above = (count + kFan - 1) / kFan;
          for (std::size_t j = 0; j < above * kFan; ++j)
            nodes_[base + count + j / kFan].set(
                j % kFan, j < count ? nodes_[base + j].all() : Box2::nothing());
          base += count;
          count = above;
        }
      });
}

LineIndex::Target::Target(const LineIndex& index, const Leaf& of) : leaf(of) {
  for (std::uint32_t k = of.first; k < of.last; ++k) {
    const double at = slant(index.flats_[k]);
    from = std::min(from, at);
    to = std::max(to, at);
  }
  const Sector& sector = index.sectors_[of.sector];
  box = index.nodes_[sector.nodes + (of.first - sector.first) / kFan].all();
}

LineIndex::Numbers LineIndex::sectors_near(const Target& target, unsigned length_class) const {
  const LengthClass& c = kLengths[length_class];
  Numbers out;
  if (c.sectors == 1) {
    out.number[out.count++] = c.first;
    return out;
  }
  // The bound of the angle's sine, with a margin for the angle and for rounding.
  const double bound = 2 / c.shortest;
  const double window =
      1.05 * (greatest_sine_ <= 2 * kSmallSine && length_class == 1 ? greatest_sine_ : bound);
  const double per = c.sectors / 2.0;
  const auto from = static_cast<std::int64_t>(std::floor((target.from - window) * per));
  const auto to = static_cast<std::int64_t>(std::floor((target.to + window) * per));
  const auto n = static_cast<std::int64_t>(c.sectors);
  for (std::int64_t k = from; k <= to && k < from + n; ++k)
    out.number[out.count++] = c.first + static_cast<std::uint32_t>((k + n) % n);
  return out;
}

LineIndex::Query::Query(const LineIndex& index, const Target& target, std::uint32_t number)
    : sector(&index.sectors_[number]), turned(target.leaf.sector != number) {
  const Sector& from = index.sectors_[target.leaf.sector];
  const std::uint32_t first = target.leaf.first, count = target.leaf.last - first;
  const BoxLanes& as_stored = index.nodes_[from.nodes + (first - from.first) / kFan];
  const double slack = index.reach_ + index.pad_;
  for (std::uint32_t i = 0; i < kFan; ++i) {
    Box2 box = Box2::nothing();
    if (i < count)
      box = turned ? index.box_of(index.flats_[first + i], sector->frame) : as_stored[i];
    lines.set(i, box.widened(static_cast<float>(slack)));
  }
  all = lines.all();
  // pad_ is half a unit in the last place of a float at the rim; no more than 16 such roundings
  // follow.
  const auto margin = static_cast<float>(slack + 16 * index.pad_);
  const Box2& box = target.box;
  own = {.cosine = static_cast<float>(sector->frame.along(from.frame.x, from.frame.y)),
         .sine = static_cast<float>(sector->frame.across(from.frame.x, from.frame.y)),
         .u = (box.u0 + box.u1) / 2,
         .v = (box.v0 + box.v1) / 2,
         .hu = (box.u1 - box.u0) / 2 + margin,
         .hv = (box.v1 - box.v0) / 2 + margin};
}

}  // namespace strake::drawing
