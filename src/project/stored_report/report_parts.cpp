// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "project/codec/blob.hpp"
#include "project/stored_report/pair_columns.hpp"
#include "project/stored_report/report_codec.hpp"
#include "project/stored_report/report_head.hpp"
#include "project/stored_report/value_columns.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {
namespace {

using clash::Pair;
using clash::Region;

auto members(const Pair& p) {
  return std::tie(p.a, p.b, p.cls, p.relation, p.flags, p.d_mm, p.d_lower_mm, p.d_upper_mm,
                  p.point_mm, p.on_a_mm, p.on_b_mm, p.away, p.deep_in_a, p.depth_complete,
                  p.volume_mm3, p.part_a, p.part_b, p.level_a, p.level_b, p.allowed, p.severest,
                  p.regions, p.allowed_regions);
}

auto members(const Region& r) {
  return std::tie(r.cls, r.flags, r.d_mm, r.d_lower_mm, r.d_upper_mm, r.point_mm, r.box_mm.lo,
                  r.box_mm.hi, r.part_a, r.part_b, r.allowed, r.depth_complete);
}

std::uint32_t listed(const Pair& pair, const clash::Options& options) {
  return pair.regions_listed(options) + pair.allowed_regions_listed(options);
}

/// A pair knows its first region by its place in the part; 0: it has none.
std::uint32_t first_region_in_part(const Pair& pair, std::uint32_t regions, std::size_t first) {
  if (regions == 0) return 0;
  return pair.first_region - static_cast<std::uint32_t>(first) + 1;
}

void write_pairs(BlobWriter& out, const ReportRows& all, const PartRange& range) {
  const std::span<const Pair> pairs(all.report.pairs.data() + range.first_pair,
                                    range.last_pair - range.first_pair);
  write_pairs(out, pairs);
  write_column(out, pairs, [&](const Pair& p) {
    return first_region_in_part(p, listed(p, all.report.options), range.first_region);
  });
  out.column(all.rows.subspan(range.first_pair, pairs.size()));
}

void write_regions(BlobWriter& out, std::span<const Region> regions) {
  const auto put = [&](const auto& value) { write_column(out, regions, value); };
  put([](const Region& r) { return r.flags; });
  put([](const Region& r) { return static_cast<std::uint8_t>(r.cls); });
  for (const auto member : {&Region::d_mm, &Region::d_lower_mm, &Region::d_upper_mm})
    put([&](const Region& r) { return r.*member; });
  for (const int axis : {0, 1, 2}) {
    put([&](const Region& r) { return r.point_mm[axis]; });
    put([&](const Region& r) { return r.box_mm.lo[axis]; });
    put([&](const Region& r) { return r.box_mm.hi[axis]; });
  }
  put([](const Region& r) { return r.part_a; });
  put([](const Region& r) { return r.part_b; });
  put([](const Region& r) { return r.allowed; });
  put([](const Region& r) { return r.depth_complete; });
}

void read_pairs(BlobReader& in, DecodedPart& part) {
  read_pairs(in, part.pairs);
  ColumnsInto<Pair>(in, part.pairs).next<std::uint32_t>([](Pair& p, std::uint32_t v) {
    p.first_region = v;
  });
  part.rows = in.column<std::int64_t>();
  if (part.rows.size() != part.pairs.size()) in.refuse("its columns differ in length");
}

void read_regions(BlobReader& in, std::vector<Region>& regions) {
  ColumnsInto<Region> columns(in, regions);
  columns.first<std::uint16_t>([](Region& r, std::uint16_t v) { r.flags = v; });
  columns.next_enum(clash::Class::hit, [](Region& r, clash::Class v) { r.cls = v; });
  for (const auto member : {&Region::d_mm, &Region::d_lower_mm, &Region::d_upper_mm})
    columns.next<double>([&](Region& r, double v) { r.*member = v; });
  for (const int axis : {0, 1, 2}) {
    columns.next<double>([&](Region& r, double v) { r.point_mm[axis] = v; });
    columns.next<double>([&](Region& r, double v) { r.box_mm.lo[axis] = v; });
    columns.next<double>([&](Region& r, double v) { r.box_mm.hi[axis] = v; });
  }
  columns.next<std::uint32_t>([](Region& r, std::uint32_t v) { r.part_a = v; });
  columns.next<std::uint32_t>([](Region& r, std::uint32_t v) { r.part_b = v; });
  columns.next<std::int32_t>([](Region& r, std::int32_t v) { r.allowed = v; });
  columns.next<bool>([](Region& r, bool v) { r.depth_complete = v; });
}

/// What the pairs of a part must fit.
struct Limits {
  const clash::Report& head;
  std::size_t objects = 0, part = 0;
};

/// Returns what is wrong with a pair of a part; empty where nothing is.
std::string_view fault_of(const Pair& pair, const DecodedPart& part, const Limits& limits) {
  const std::size_t a = index(pair.a), b = index(pair.b);
  if (a >= limits.objects || b >= limits.objects || a >= b) return "a pair is of no two objects";
  if (a / kObjectsPerPart != limits.part) return "a pair is of another part";
  if (pair.cls == clash::Class::no_hit) return "a pair is no result";
  const auto rules = static_cast<std::int64_t>(limits.head.allowed.size());
  if (pair.allowed < -1 || pair.allowed >= rules) return "a pair is allowed by no rule";
  if (!std::isfinite(pair.d_mm) || !is_finite(pair.point_mm)) return "a pair is nowhere";
  const std::size_t regions = listed(pair, limits.head.options);
  if (regions == 0) return {};
  const bool fits = pair.first_region > 0 && pair.first_region - 1 <= part.regions.size() &&
                    regions <= part.regions.size() - (pair.first_region - 1);
  return fits ? std::string_view() : "a pair has regions that are not there";
}

void check_part(BlobReader& in, const DecodedPart& part, const Limits& limits) {
  if (in.failed()) return;
  for (std::size_t i = 0; i < part.pairs.size(); ++i) {
    const Pair& pair = part.pairs[i];
    if (const std::string_view fault = fault_of(pair, part, limits); !fault.empty())
      return in.refuse(fault);
    if (i > 0 && std::pair(part.pairs[i - 1].a, part.pairs[i - 1].b) >= std::pair(pair.a, pair.b))
      return in.refuse("its pairs are not in order");
    if (part.rows[i] < 0) return in.refuse("a pair has a row that is none");
  }
  const auto rules = static_cast<std::int64_t>(limits.head.allowed.size());
  for (const Region& region : part.regions)
    if (region.allowed < -1 || region.allowed >= rules || !is_finite(region.point_mm))
      return in.refuse("a region is allowed by no rule, or nowhere");
}

/// Puts parts one behind the other.
Status join(std::vector<DecodedPart>& parts, RememberedReport& all,
            const parallel::Context& context) {
  struct Place {
    std::size_t pair = 0, region = 0;
  };
  std::vector<Place> places;
  Place end;
  for (const DecodedPart& part : parts) {
    places.push_back(end);
    end.pair += part.pairs.size();
    end.region += part.regions.size();
  }
  auto pairs = parallel::slots<Pair>(end.pair, context);
  if (!pairs) return pairs.error();
  auto regions = parallel::slots<Region>(end.region, context);
  if (!regions) return regions.error();
  auto rows = parallel::slots<std::int64_t>(end.pair, context);
  if (!rows) return rows.error();
  const Status joined =
      parallel::for_each(context, {.name = "join results", .n = parts.size()}, [&](std::size_t k) {
        const DecodedPart part = std::move(parts[k]);
        Pair* const first = pairs->data() + places[k].pair;
        std::ranges::copy(part.pairs, first);
        for (Pair& pair : std::span(first, part.pairs.size()))
          if (pair.first_region > 0)
            pair.first_region += static_cast<std::uint32_t>(places[k].region) - 1;
        std::ranges::copy(part.regions, regions->data() + places[k].region);
        std::ranges::copy(part.rows, rows->data() + places[k].pair);
      });
  if (!joined) return joined;
  all.report.pairs = std::move(*pairs);
  all.report.regions = std::move(*regions);
  all.rows = std::move(*rows);
  return {};
}

std::size_t count_parts(std::size_t objects) {
  return (objects + kObjectsPerPart - 1) / kObjectsPerPart;
}

Error damaged_report(std::string_view why, const std::string& what) {
  return {ErrorCode::input, "is damaged: " + std::string(why), what,
          "take a copy of the project, or make it anew of its model files"};
}

}  // namespace

Hash128 seal_of(std::span<const std::byte> head, std::span<const std::byte> kept,
                std::span<const Hash128> parts) {
  WordHash seal;
  seal.add(hash_bytes(head)).add(hash_bytes(kept));
  for (const Hash128& part : parts) seal.add(part);
  return seal.value();
}

/// Returns where the regions of the pairs [first, last) end; `before` where those before them end.
std::size_t end_of_regions(const clash::Report& report, std::size_t first, std::size_t last,
                           std::size_t before) {
  for (std::size_t i = last; i > first; --i) {
    const Pair& pair = report.pairs[i - 1];
    if (const std::uint32_t count = listed(pair, report.options); count > 0)
      return std::size_t{pair.first_region} + count;
  }
  return before;
}

std::vector<PartRange> parts_of(const clash::Report& report, std::size_t objects) {
  std::vector<PartRange> parts(count_parts(objects));
  std::size_t pair = 0, region = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    parts[k].first_pair = pair;
    parts[k].first_region = region;
    // Of a million results few are looked at: those where parts end.
    const auto end = std::partition_point(
        report.pairs.begin() + static_cast<std::ptrdiff_t>(pair), report.pairs.end(),
        [&](const Pair& p) { return index(p.a) / kObjectsPerPart <= k; });
    pair = static_cast<std::size_t>(end - report.pairs.begin());
    if (!report.regions.empty()) region = end_of_regions(report, parts[k].first_pair, pair, region);
    // Regions of contacts that are only counted lie behind those of the pairs before them.
    if (k + 1 == parts.size()) region = report.regions.size();
    parts[k].last_pair = pair;
    parts[k].last_region = region;
  }
  return parts;
}

bool is_same_part(const ReportRows& x, const PartRange& of_x, const ReportRows& y,
                  const PartRange& of_y) {
  const std::size_t pairs = of_x.last_pair - of_x.first_pair,
                    regions = of_x.last_region - of_x.first_region;
  if (pairs != of_y.last_pair - of_y.first_pair || regions != of_y.last_region - of_y.first_region)
    return false;
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::size_t at_x = of_x.first_pair + i, at_y = of_y.first_pair + i;
    const Pair &p = x.report.pairs[at_x], &q = y.report.pairs[at_y];
    const std::uint32_t of_p = listed(p, x.report.options), of_q = listed(q, y.report.options);
    if (x.rows[at_x] != y.rows[at_y] || members(p) != members(q) || of_p != of_q ||
        first_region_in_part(p, of_p, of_x.first_region) !=
            first_region_in_part(q, of_q, of_y.first_region))
      return false;
  }
  for (std::size_t i = 0; i < regions; ++i)
    if (members(x.report.regions[of_x.first_region + i]) !=
        members(y.report.regions[of_y.first_region + i]))
      return false;
  return true;
}

Result<bool> is_same_result(const clash::Report& x, const clash::Report& y) {
  if (x.in_a.size() != y.in_a.size() || x.pairs.size() != y.pairs.size()) return false;
  const std::vector<std::int64_t> no_rows(x.pairs.size());
  const std::vector<PartRange> of_x = parts_of(x, x.in_a.size()), of_y = parts_of(y, y.in_a.size());
  for (std::size_t k = 0; k < of_x.size(); ++k)
    if (!is_same_part({x, no_rows}, of_x[k], {y, no_rows}, of_y[k])) return false;
  const auto head = [](const clash::Report& report) {
    clash::Report without_pairs = report;
    without_pairs.pairs.clear();
    without_pairs.counters = {};
    return encode_head(without_pairs);
  };
  const Result<std::vector<std::byte>> head_x = head(x), head_y = head(y);
  if (!head_x) return head_x.error();
  if (!head_y) return head_y.error();
  return *head_x == *head_y;
}

Result<std::vector<std::byte>> encode_part(const ReportRows& report, const PartRange& range,
                                           int level) {
  BlobWriter out;
  write_pairs(out, report, range);
  write_regions(out, {report.report.regions.data() + range.first_region,
                      range.last_region - range.first_region});
  return out.finish(level);
}

Result<DecodedPart> decode_part(std::span<const std::byte> bytes, const clash::Report& head,
                                std::size_t objects, std::size_t number, const std::string& what) {
  DecodedPart part;
  Result<BlobReader> in = BlobReader::open(bytes, what);
  if (!in) return in.error();
  read_pairs(*in, part);
  read_regions(*in, part.regions);
  check_part(*in, part, {head, objects, number});
  if (const Status status = in->finish(); !status) return status.error();
  return part;
}

Result<RememberedReport> decode_report(const EncodedReport& encoded, std::size_t objects,
                                       const std::string& what, const parallel::Context& context) {
  RememberedReport all;
  if (encoded.parts.size() != count_parts(objects))
    return damaged_report("its parts are not as many as its objects need", what);
  for (const std::vector<std::byte>& part : encoded.parts) all.parts.push_back(hash_bytes(part));
  if (seal_of(encoded.head, encoded.kept, all.parts) != encoded.seal)
    return damaged_report("its parts are not those that were stored together", what);
  Result<clash::Report> head = decode_head(encoded.head, objects, what);
  if (!head) return head.error();
  all.report = std::move(*head);
  clash::PartnerBlocks& partners = all.partners.emplace();
  partners.of.resize(encoded.parts.size());
  Result<std::vector<DecodedPart>> parts = parallel::transform(
      context, {.name = "decode results", .n = encoded.parts.size()},
      [&](std::size_t k) -> Result<DecodedPart> {
        Result<DecodedPart> part = decode_part(encoded.parts[k], all.report, objects, k,
                                               what + ", part " + std::to_string(k));
        if (part) partners.of[k] = clash::partners_of(part->pairs);
        return part;
      });
  if (!parts) return parts.error();
  if (const Status joined = join(*parts, all, context); !joined) return joined.error();
  return all;
}

}  // namespace strake::project
