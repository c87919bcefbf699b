// SPDX-License-Identifier: Apache-2.0
#include "project/stored_report/kept_codec.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "project/codec/blob.hpp"
#include "project/stored_report/pair_columns.hpp"
#include "project/stored_report/value_columns.hpp"

namespace strake::project {
namespace {

using clash::KeptForChanges;

template <class Item>
void write_objects(BlobWriter& out, std::span<const Item> items) {
  write_column(out, items, [](const Item& i) { return index(i.a); });
  write_column(out, items, [](const Item& i) { return index(i.b); });
}

template <class Item>
void write_rules(BlobWriter& out, const std::vector<Item>& items) {
  write_objects(out, std::span<const Item>(items));
  write_column(out, std::span<const Item>(items), [](const Item& i) { return i.rule; });
}

template <class Item>
ColumnsInto<Item> read_objects(BlobReader& in, std::vector<Item>& items) {
  ColumnsInto<Item> columns(in, items);
  columns.template first<std::uint32_t>([](Item& i, std::uint32_t v) { i.a = model::ObjectId{v}; });
  columns.template next<std::uint32_t>([](Item& i, std::uint32_t v) { i.b = model::ObjectId{v}; });
  return columns;
}

template <class Item>
ColumnsInto<Item> read_rules(BlobReader& in, std::vector<Item>& items) {
  ColumnsInto<Item> columns = read_objects(in, items);
  columns.template next<std::uint32_t>([](Item& i, std::uint32_t v) { i.rule = v; });
  return columns;
}

/// Refuses what speaks of objects or rules that are not there, or is not in order.
class KeptCheck {
 public:
  KeptCheck(BlobReader& in, std::size_t objects) : in_(in), objects_(objects) {}

  template <class Item>
  void pairs(const std::vector<Item>& items) {
    const auto objects_of = [](const Item& i) { return std::pair(i.a, i.b); };
    for (const Item& i : items)
      refuse_unless(i.a < i.b && index(i.b) < objects_, "it keeps a pair of no two objects");
    refuse_unless(std::ranges::is_sorted(items, {}, objects_of), "what it keeps is not in order");
  }
  template <class Item>
  void rules(const std::vector<Item>& items, std::size_t count) {
    pairs(items);
    for (const Item& i : items) refuse_unless(i.rule < count, "it keeps a rule that is not there");
  }
  template <class Item>
  void allowed(const std::vector<Item>& items, std::size_t count) {
    pairs(items);
    for (const Item& i : items)
      refuse_unless(i.allowed >= -1 && i.allowed < static_cast<std::int64_t>(count),
                    "it keeps a rule that is not there");
  }
  void refuse_unless(bool holds, std::string_view why) {
    if (!holds && !in_.failed()) in_.refuse(why);
  }

 private:
  BlobReader& in_;
  std::size_t objects_;
};

void check(BlobReader& in, const KeptForChanges& kept, const clash::Report& report,
           std::size_t objects) {
  KeptCheck check(in, objects);
  check.refuse_unless(kept.elements.size() == objects, "it keeps other objects");
  check.rules(kept.exempted, report.exempted.size());
  check.rules(kept.concerned, report.allowed.size());
  check.rules(kept.allowed_regions, report.allowed.size());
  check.pairs(kept.unreported);
  check.allowed(kept.unlisted, report.allowed.size());
  check.allowed(kept.allowed_contacts, report.allowed.size());
  for (const clash::Pair& pair : kept.allowed_contacts)
    check.refuse_unless(std::isfinite(pair.d_mm) && is_finite(pair.point_mm),
                        "a contact is nowhere");
}

}  // namespace

Result<std::vector<std::byte>> encode_kept(const std::optional<KeptForChanges>& kept) {
  if (!kept) return std::vector<std::byte>();
  BlobWriter out;
  out.number(kept->box_pairs);
  out.number(kept->framed ? 1 : 0);
  out.hash(kept->hash_sum);
  out.column(std::span<const std::uint64_t>());  // versions before 4 had the elements here
  write_rules(out, kept->exempted);
  write_rules(out, kept->concerned);
  write_rules(out, kept->allowed_regions);
  using Regions = clash::AllowedRegionCount;
  write_column(out, std::span<const Regions>(kept->allowed_regions),
               [](const Regions& r) { return r.regions; });
  using Unreported = clash::UnreportedPair;
  const std::span<const Unreported> unreported(kept->unreported);
  write_objects(out, unreported);
  write_column(out, unreported,
               [](const Unreported& u) { return static_cast<std::uint8_t>(u.cls); });
  write_column(out, unreported, [](const Unreported& u) { return u.allowed; });
  write_column(out, unreported, [](const Unreported& u) { return u.by_volume; });
  using Unlisted = clash::UnlistedContact;
  const std::span<const Unlisted> unlisted(kept->unlisted);
  write_objects(out, unlisted);
  write_column(out, unlisted, [](const Unlisted& u) { return u.allowed; });
  write_column(out, unlisted, [](const Unlisted& u) { return u.hash; });
  write_pairs(out, kept->allowed_contacts);
  return out.finish();
}

Result<std::optional<KeptForChanges>> decode_kept(std::span<const std::byte> bytes,
                                                  const clash::Report& report, std::size_t objects,
                                                  std::vector<std::uint64_t> elements,
                                                  const std::string& what) {
  if (bytes.empty()) return std::optional<KeptForChanges>();
  Result<BlobReader> in = BlobReader::open(bytes, what + ", what it keeps for changes");
  if (!in) return in.error();
  KeptForChanges kept;
  kept.box_pairs = in->number();
  kept.framed = in->number() != 0;
  kept.hash_sum = in->hash();
  kept.elements = in->column<std::uint64_t>();
  if (kept.elements.empty()) kept.elements = std::move(elements);
  read_rules(*in, kept.exempted);
  read_rules(*in, kept.concerned);
  read_rules(*in, kept.allowed_regions)
      .next<std::uint32_t>([](clash::AllowedRegionCount& r, std::uint32_t v) { r.regions = v; });
  using Unreported = clash::UnreportedPair;
  ColumnsInto<Unreported> unreported = read_objects(*in, kept.unreported);
  unreported.next_enum(clash::Class::hit, [](Unreported& u, clash::Class v) { u.cls = v; });
  unreported.next<bool>([](Unreported& u, bool v) { u.allowed = v; });
  unreported.next<bool>([](Unreported& u, bool v) { u.by_volume = v; });
  using Unlisted = clash::UnlistedContact;
  ColumnsInto<Unlisted> unlisted = read_objects(*in, kept.unlisted);
  unlisted.next<std::int32_t>([](Unlisted& u, std::int32_t v) { u.allowed = v; });
  unlisted.next<Hash128>([](Unlisted& u, const Hash128& v) { u.hash = v; });
  read_pairs(*in, kept.allowed_contacts);
  check(*in, kept, report, objects);
  if (const Status status = in->finish(); !status) return status.error();
  return std::optional(std::move(kept));
}

}  // namespace strake::project
