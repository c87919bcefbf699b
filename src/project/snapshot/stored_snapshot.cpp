// SPDX-License-Identifier: Apache-2.0
#include "project/snapshot/stored_snapshot.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "project/codec/blob.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {
namespace {

using Bytes = std::vector<std::byte>;

/// 131 kB, since hashes do not compress: to write one part costs less than to find out which, and a
/// million objects have 245 of them. The ranges of signatures say which parts stand.
constexpr std::size_t kObjectsPerSnapshotPart = clash::Signatures::kObjectsPerRange;

/// Returns how many parts so many objects have. There is always one: a snapshot without any is one
/// that a version before 4 wrote.
std::size_t count_snapshot_parts(std::size_t objects) {
  return std::max<std::size_t>(1,
                               (objects + kObjectsPerSnapshotPart - 1) / kObjectsPerSnapshotPart);
}

/// The objects of a part.
struct PartOfObjects {
  std::size_t first = 0, count = 0;
};

PartOfObjects objects_of_part(std::size_t part, std::size_t objects) {
  const std::size_t first = part * kObjectsPerSnapshotPart;
  return {first, std::min(kObjectsPerSnapshotPart, objects - std::min(objects, first))};
}

/// Returns how many bytes a part of so many objects has before it is compressed.
std::uint64_t raw_size_of(std::size_t objects, bool has_elements) {
  constexpr std::size_t kNumber = sizeof(std::uint64_t);
  const std::size_t of_each = kNumber + sizeof(Hash128) + (has_elements ? kNumber : 0);
  return 3 * kNumber + objects * of_each;
}

/// What a snapshot has besides its parts.
struct SnapshotHead {
  Hash128 whole, names, source;
  std::uint64_t objects = 0;
  bool has_elements = false;
  std::vector<Hash128> parts, ranges;
};

Result<Bytes> encode_snapshot_head(const SnapshotHead& head) {
  BlobWriter out;
  out.hash(head.whole);
  out.hash(head.names);
  out.hash(head.source);
  out.number(head.objects);
  out.number(head.has_elements ? 1 : 0);
  out.column(std::span<const Hash128>(head.parts));
  out.column(std::span<const Hash128>(head.ranges));
  return out.finish();
}

Result<SnapshotHead> decode_snapshot_head(std::span<const std::byte> bytes, std::size_t parts,
                                          const std::string& what) {
  Result<BlobReader> in = BlobReader::open(bytes, what);
  if (!in) return in.error();
  SnapshotHead head;
  head.whole = in->hash();
  head.names = in->hash();
  head.source = in->hash();
  head.objects = in->number();
  head.has_elements = in->number() != 0;
  head.parts = in->column<Hash128>();
  head.ranges = in->column<Hash128>();
  if (head.parts.size() != parts || head.objects > parts * kObjectsPerSnapshotPart ||
      count_snapshot_parts(head.objects) != parts)
    in->refuse("it has not the parts that it should have");
  if (const Status status = in->finish(); !status) return status.error();
  return head;
}

/// Returns all of a snapshot out of one row, as versions before 4 had it.
Result<Snapshot> decode_one_row(std::span<const std::byte> bytes, const std::string& what) {
  Result<BlobReader> in = BlobReader::open(bytes, what);
  if (!in) return in.error();
  Snapshot snapshot = read_snapshot(*in);
  if (const Status status = in->finish(); !status) return status.error();
  return snapshot;
}

/// Puts the values of a part where the snapshot has them.
Status decode_snapshot_part(std::span<const std::byte> bytes, PartOfObjects part,
                            const std::string& what, StoredSnapshot& stored) {
  Result<BlobReader> in = BlobReader::open(bytes, what);
  if (!in) return in.error();
  const std::vector<std::uint64_t> identities = in->column<std::uint64_t>();
  const std::vector<Hash128> signatures = in->column<Hash128>();
  const std::vector<std::uint64_t> elements = in->column<std::uint64_t>();
  if (identities.size() != part.count || signatures.size() != part.count ||
      elements.size() != (stored.elements.empty() ? 0 : part.count))
    in->refuse("it has not as many signatures as objects");
  if (const Status status = in->finish(); !status) return status;
  const auto first = static_cast<std::ptrdiff_t>(part.first);
  std::ranges::copy(identities, stored.snapshot.identities.begin() + first);
  std::ranges::copy(signatures, stored.snapshot.signatures.begin() + first);
  if (!elements.empty()) std::ranges::copy(elements, stored.elements.begin() + first);
  return {};
}

/// A part to be written; without bytes where it is stored.
struct EncodedSnapshotPart {
  Hash128 hash;
  Bytes bytes;
};

Result<EncodedSnapshotPart> encode_snapshot_part(const Snapshot& snapshot,
                                                 std::span<const std::uint64_t> elements,
                                                 PartOfObjects part, const Hash128& stored) {
  BlobWriter out;
  out.column(std::span(snapshot.identities).subspan(part.first, part.count));
  out.column(std::span(snapshot.signatures).subspan(part.first, part.count));
  out.column(elements.empty() ? elements : elements.subspan(part.first, part.count));
  EncodedSnapshotPart encoded{out.raw_hash(), {}};
  if (encoded.hash == stored) return encoded;
  Result<Bytes> bytes = out.finish();
  if (!bytes) return bytes.error();
  encoded.bytes = std::move(*bytes);
  return encoded;
}

Status write_snapshot_parts(Database& database, std::int64_t test,
                            std::span<const EncodedSnapshotPart> parts) {
  Result<Statement> remove =
      database.prepare("DELETE FROM snapshot_part WHERE test = ?1 AND part >= ?2");
  if (!remove) return remove.error();
  remove->bind(1, test).bind(2, static_cast<std::int64_t>(parts.size()));
  if (const Status status = remove->run(); !status) return status;
  Result<Statement> put = database.prepare(
      "INSERT OR REPLACE INTO snapshot_part (test, part, data) VALUES (?1, ?2, ?3)");
  if (!put) return put.error();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (parts[k].bytes.empty()) continue;
    put->bind(1, test).bind(2, static_cast<std::int64_t>(k));
    put->bind(3, std::span<const std::byte>(parts[k].bytes));
    if (const Status status = put->run(); !status) return status;
  }
  return {};
}

}  // namespace

Result<StoredSnapshot> read_snapshot(Database& database, std::int64_t test,
                                     std::span<const std::byte> head, const std::string& what,
                                     const parallel::Context& context) {
  const Result<std::vector<Bytes>> parts =
      read_parts(database, "snapshot_part", test, "what a result was computed from");
  if (!parts) return parts.error();
  if (parts->empty()) {
    Result<Snapshot> whole = decode_one_row(head, what);
    if (!whole) return whole.error();
    return StoredSnapshot{test, std::move(*whole), {}, {}};
  }
  Result<SnapshotHead> of_all = decode_snapshot_head(head, parts->size(), what);
  if (!of_all) return of_all.error();
  const auto objects = static_cast<std::size_t>(of_all->objects);
  // Nothing is made room for that is not there.
  for (std::size_t k = 0; k < parts->size(); ++k)
    if (BlobReader::raw_hash((*parts)[k]) != of_all->parts[k] ||
        BlobReader::raw_size((*parts)[k]) !=
            raw_size_of(objects_of_part(k, objects).count, of_all->has_elements))
      return database.damaged("a part of what a result was computed from is another one");
  StoredSnapshot stored{test, {}, {}, std::move(of_all->parts)};
  stored.snapshot.whole = of_all->whole;
  stored.snapshot.names = of_all->names;
  stored.snapshot.source = of_all->source;
  stored.snapshot.ranges = std::move(of_all->ranges);
  stored.snapshot.identities.resize(objects);
  stored.snapshot.signatures.resize(objects);
  if (of_all->has_elements) stored.elements.resize(objects);
  const Status status = parallel::for_each(
      context, {.name = "stored signatures", .n = parts->size()}, [&](std::size_t k) {
        return decode_snapshot_part((*parts)[k], objects_of_part(k, objects), what, stored);
      });
  if (!status) return status.error();
  return stored;
}

Status write_snapshot(Database& database, std::int64_t test, const Snapshot& snapshot,
                      std::span<const std::uint64_t> elements, const StoredParts& stored,
                      const parallel::Context& context) {
  const std::size_t objects = snapshot.identities.size();
  Result<std::vector<EncodedSnapshotPart>> parts = parallel::transform(
      context, {.name = "encode signatures", .n = count_snapshot_parts(objects)},
      [&](std::size_t k) -> Result<EncodedSnapshotPart> {
        const Hash128 there = k < stored.hashes.size() ? stored.hashes[k] : Hash128();
        if (k < stored.stand.size() && stored.stand[k] && there != Hash128())
          return EncodedSnapshotPart{there, {}};
        return encode_snapshot_part(snapshot, elements, objects_of_part(k, objects), there);
      });
  if (!parts) return parts.error();
  if (const Status status = write_snapshot_parts(database, test, *parts); !status) return status;
  SnapshotHead head{snapshot.whole, snapshot.names, snapshot.source, objects, !elements.empty(), {},
                    snapshot.ranges};
  for (const EncodedSnapshotPart& part : *parts) head.parts.push_back(part.hash);
  const Result<Bytes> bytes = encode_snapshot_head(head);
  if (!bytes) return bytes.error();
  Result<Statement> update = database.prepare("UPDATE report SET snapshot = ?2 WHERE test = ?1");
  if (!update) return update.error();
  return update->bind(1, test).bind(2, std::span<const std::byte>(*bytes)).run();
}

}  // namespace strake::project
