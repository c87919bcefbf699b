// SPDX-License-Identifier: Apache-2.0
#include "project/model/shape_packs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "project/model/file_blocks.hpp"
#include "project/model/file_rows.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {
namespace {

/// A pack is closed when it has so many bytes, so that there are enough of them for all workers.
constexpr std::uint64_t kPackBytes = std::uint64_t{1} << 20U;
constexpr std::size_t kMaxOfPack = 65'536;

struct PackRow {
  std::uint32_t id = 0;
  std::vector<Hash128> hashes;  ///< zero: a shape that was taken out
  Blob data;
};

enum class WithData : bool { no, yes };

std::vector<std::byte> to_bytes(std::span<const Hash128> hashes) {
  const auto bytes = std::as_bytes(hashes);
  return {bytes.begin(), bytes.end()};
}

Result<std::vector<PackRow>> read_packs(Database& database, WithData with_data) {
  Result<Statement> statement = database.prepare(
      with_data == WithData::yes ? "SELECT id, hashes, data FROM shape_pack ORDER BY id"
                                 : "SELECT id, hashes FROM shape_pack ORDER BY id");
  if (!statement) return statement.error();
  std::vector<PackRow> packs;
  for (;;) {
    const Result<bool> more = statement->step();
    if (!more) return more.error();
    if (!*more) return packs;
    const std::int64_t id = statement->integer(0);
    const std::span<const std::byte> hashes = statement->bytes(1);
    if (id <= 0 || id >= std::numeric_limits<std::uint32_t>::max() ||
        (!packs.empty() && id <= packs.back().id) || hashes.size() % sizeof(Hash128) != 0)
      return database.damaged("a row of the table 'shape_pack' cannot be");
    PackRow& pack = packs.emplace_back();
    pack.id = static_cast<std::uint32_t>(id);
    pack.hashes.resize(hashes.size() / sizeof(Hash128));
    std::ranges::copy(hashes, std::as_writable_bytes(std::span(pack.hashes)).begin());
    if (with_data == WithData::yes) {
      const std::span<const std::byte> data = statement->bytes(2);
      pack.data.assign(data.begin(), data.end());
    }
  }
}

std::string name_of(const Database& database, std::uint32_t pack) {
  return fmt::format("{}: the shapes of pack {}", database.file().string(), pack);
}

Result<UnpackedPack> unpacked(const Database& database, const PackRow& pack) {
  Result<std::vector<model::Shape>> shapes =
      unpack_meshes(pack.data, pack.hashes, name_of(database, pack.id));
  if (!shapes) return shapes.error();
  return UnpackedPack{pack.id, pack.hashes, std::move(*shapes)};
}

/// Returns which shapes of all packs files use; packs are ordered by id.
Result<std::vector<std::vector<bool>>> used_shapes(Database& database,
                                                   std::span<const PackRow> packs,
                                                   const parallel::Context& context) {
  const Result<std::vector<FileRow>> rows = read_rows(database);
  if (!rows) return rows.error();
  std::vector<std::vector<bool>> used;
  for (const PackRow& pack : packs) used.emplace_back(pack.hashes.size(), false);
  for (const FileRow& row : *rows) {
    const Result<std::vector<Blob>> blocks =
        read_blocks(database, row.file.id, BlockKind::shapes, row.shapes);
    if (!blocks) return blocks.error();
    const auto shared = parallel::transform(
        context, {.name = "used shapes", .n = blocks->size()},
        [&](std::size_t b) -> Result<std::vector<SharedShape>> {
          std::vector<model::Shape> shapes(items_of_block(row.shapes, b));
          return unpack_shapes((*blocks)[b], block_name(database, row, BlockKind::shapes), shapes);
        });
    if (!shared) return shared.error();
    for (const std::vector<SharedShape>& block : *shared)
      for (const SharedShape& shape : block) {
        const auto pack = std::ranges::lower_bound(packs, shape.from.pack, {}, &PackRow::id);
        const auto p = static_cast<std::size_t>(pack - packs.begin());
        if (pack == packs.end() || pack->id != shape.from.pack ||
            shape.from.number >= used[p].size())
          return database.damaged("a file has shapes that are not there");
        used[p][shape.from.number] = true;
      }
  }
  return used;
}

Status write_data(Database& database, std::uint32_t id, std::span<const Hash128> hashes,
                  const Blob& data) {
  Result<Statement> statement = database.prepare(
      "INSERT INTO shape_pack (id, shapes, hashes, data) VALUES (?1, ?2, ?3, ?4) "
      "ON CONFLICT (id) DO UPDATE SET shapes = ?2, hashes = ?3, data = ?4");
  if (!statement) return statement.error();
  const std::vector<std::byte> bytes = to_bytes(hashes);
  const auto held = std::ranges::count_if(hashes, [](const Hash128& h) { return h != Hash128(); });
  statement->bind(1, std::int64_t{id});
  statement->bind(2, std::int64_t{held});
  statement->bind(3, bytes);
  statement->bind(4, data);
  return statement->run();
}

/// Writes a pack again without what is not used.
Status shrink(Database& database, const PackRow& row, const std::vector<bool>& used) {
  Result<Statement> statement = database.prepare("SELECT data FROM shape_pack WHERE id = ?1");
  if (!statement) return statement.error();
  statement->bind(1, std::int64_t{row.id});
  const Result<bool> found = statement->step();
  if (!found) return found.error();
  PackRow whole{row.id, row.hashes, {}};
  const std::span<const std::byte> data = statement->bytes(0);
  whole.data.assign(data.begin(), data.end());
  statement->reset();
  const Result<UnpackedPack> pack = unpacked(database, whole);
  if (!pack) return pack.error();
  std::vector<const model::Shape*> left;
  for (std::size_t i = 0; i < used.size(); ++i) {
    left.push_back(used[i] ? &pack->shapes[i] : nullptr);
    if (!used[i]) whole.hashes[i] = {};
  }
  const Result<Blob> blob = pack_meshes(left, whole.hashes);
  if (!blob) return blob.error();
  return write_data(database, row.id, whole.hashes, *blob);
}

Status remove_pack(Database& database, std::uint32_t id) {
  Result<Statement> statement = database.prepare("DELETE FROM shape_pack WHERE id = ?1");
  if (!statement) return statement.error();
  return statement->bind(1, std::int64_t{id}).run();
}

}  // namespace

Result<ShapePacks> ShapePacks::open(Database& database) {
  const Result<std::vector<PackRow>> rows = read_packs(database, WithData::no);
  if (!rows) return rows.error();
  ShapePacks packs(database);
  for (const PackRow& row : *rows)
    for (std::uint32_t i = 0; i < row.hashes.size(); ++i)
      if (row.hashes[i] != Hash128())
        packs.known_.try_emplace(row.hashes[i], PackedShape{row.id, i});
  return packs;
}

Result<std::vector<PackedShape>> ShapePacks::add(std::span<const model::Shape> shapes,
                                                 const parallel::Context& context) {
  std::vector<std::uint32_t> shared;
  for (std::uint32_t i = 0; i < shapes.size(); ++i)
    if (is_shared(shapes[i])) shared.push_back(i);
  const auto hashes = parallel::transform(
      context, {.name = "hashes of shapes", .n = shared.size(), .grain = 16},
      [&](std::size_t i) -> Result<Hash128> {
        const model::Shape& shape = shapes[shared[i]];
        if (!is_sound(shape))
          return Error{ErrorCode::input, "a shape numbers vertices that it does not have", "", ""};
        return shape_hash(shape);
      });
  if (!hashes) return hashes.error();

  std::int64_t next = 1;
  {
    Result<Statement> last = database_->prepare("SELECT coalesce(max(id), 0) FROM shape_pack");
    if (!last) return last.error();
    const Result<bool> row = last->step();
    if (!row) return row.error();
    next = last->integer(0) + 1;
  }
  std::vector<PackedShape> places;
  places.reserve(shared.size());
  std::vector<std::vector<std::uint32_t>> packs;  // of numbers among the shared ones
  std::uint64_t bytes = kPackBytes;
  for (std::uint32_t i = 0; i < shared.size(); ++i) {
    const auto found = known_.find((*hashes)[i]);
    if (found != known_.end()) {
      places.push_back(found->second);
      continue;
    }
    if (bytes >= kPackBytes || packs.back().size() >= kMaxOfPack) {
      packs.emplace_back();
      bytes = 0;
    }
    const PackedShape place{
        static_cast<std::uint32_t>(next + static_cast<std::int64_t>(packs.size()) - 1),
        static_cast<std::uint32_t>(packs.back().size())};
    packs.back().push_back(i);
    bytes += shape_bytes(shapes[shared[i]]);
    known_.emplace((*hashes)[i], place);
    places.push_back(place);
  }
  std::vector<std::vector<Hash128>> hashes_of(packs.size());
  for (std::size_t p = 0; p < packs.size(); ++p)
    for (const std::uint32_t i : packs[p]) hashes_of[p].push_back((*hashes)[i]);
  const auto blobs = parallel::transform(context, {.name = "packs of shapes", .n = packs.size()},
                                         [&](std::size_t p) -> Result<Blob> {
                                           std::vector<const model::Shape*> of_pack;
                                           of_pack.reserve(packs[p].size());
                                           for (const std::uint32_t i : packs[p])
                                             of_pack.push_back(&shapes[shared[i]]);
                                           return pack_meshes(of_pack, hashes_of[p]);
                                         });
  if (!blobs) return blobs.error();
  for (std::size_t p = 0; p < packs.size(); ++p) {
    const auto id = static_cast<std::uint32_t>(next + static_cast<std::int64_t>(p));
    if (const Status status = write_data(*database_, id, hashes_of[p], (*blobs)[p]); !status)
      return status.error();
  }
  return places;
}

Status sweep_packs(Database& database, const parallel::Context& context) {
  const Result<std::vector<PackRow>> packs = read_packs(database, WithData::no);
  if (!packs) return packs.error();
  const auto used = used_shapes(database, *packs, context);
  if (!used) return used.error();
  for (std::size_t p = 0; p < packs->size(); ++p) {
    const PackRow& pack = (*packs)[p];
    const auto needed = std::ranges::count((*used)[p], true);
    const auto held =
        std::ranges::count_if(pack.hashes, [](const Hash128& h) { return h != Hash128(); });
    Status status;
    if (needed == 0)
      status = remove_pack(database, pack.id);
    else if (needed * 2 <= held)
      status = shrink(database, pack, (*used)[p]);
    if (!status) return status;
  }
  return {};
}

Result<std::vector<UnpackedPack>> unpack_all(Database& database, const parallel::Context& context) {
  const Result<std::vector<PackRow>> packs = read_packs(database, WithData::yes);
  if (!packs) return packs.error();
  return parallel::transform(context, {.name = "shapes of the project", .n = packs->size()},
                             [&](std::size_t p) { return unpacked(database, (*packs)[p]); });
}

Status check_packs(Database& database, const parallel::Context& context) {
  const Result<std::vector<UnpackedPack>> packs = unpack_all(database, context);
  if (!packs) return packs.error();
  for (const UnpackedPack& pack : *packs)
    for (std::size_t i = 0; i < pack.shapes.size(); ++i)
      if (pack.hashes[i] != Hash128() && shape_hash(pack.shapes[i]) != pack.hashes[i])
        return database.damaged(
            fmt::format("shape {} of pack {} is not the one that its hash says", i, pack.id));
  return {};
}

}  // namespace strake::project
