// SPDX-License-Identifier: Apache-2.0
#include "project/model/file_blocks.hpp"

#include <fmt/format.h>

#include <array>

#include "project/codec/blob.hpp"

namespace strake::project {
namespace {

struct BlockFacts {
  std::string_view name;
  std::uint64_t min_bytes;  ///< of an item, before it is compressed
};

constexpr std::array<BlockFacts, 6> kKindFacts{{{"objects", kMinOfObject},
                                                {"bodies", kMinOfBody},
                                                {"shapes", kMinOfShape},
                                                {"groups", kMinOfGroup},
                                                {"group attributes", kMinOfAttributes},
                                                {"diagnostics", 0}}};

const BlockFacts& facts_of(BlockKind kind) { return kKindFacts[static_cast<std::size_t>(kind)]; }

}  // namespace

std::string_view kind_name(BlockKind kind) { return facts_of(kind).name; }

std::string block_name(const Database& database, const FileRow& row, BlockKind kind) {
  return fmt::format("{}: the {} of {}", database.file().string(), kind_name(kind),
                     row.file.source.label);
}

Result<std::vector<Blob>> read_blocks(Database& database, std::int64_t file, BlockKind kind,
                                      std::uint64_t items) {
  Result<Statement> statement = database.prepare(
      "SELECT number, data FROM file_block WHERE file = ?1 AND kind = ?2 ORDER BY number");
  if (!statement) return statement.error();
  statement->bind(1, file).bind(2, kind_name(kind));
  const std::size_t count = block_count(items);
  std::vector<Blob> blocks;
  for (;;) {
    const Result<bool> more = statement->step();
    if (!more) return more.error();
    if (!*more && blocks.size() == count) return blocks;
    if (!*more || blocks.size() == count ||
        statement->integer(0) != static_cast<std::int64_t>(blocks.size()))
      return database.damaged(
          fmt::format("there are not all {} of file {}, or too many", kind_name(kind), file));
    const std::span<const std::byte> data = statement->bytes(1);
    if (BlobReader::raw_size(data) <
        items_of_block(items, blocks.size()) * facts_of(kind).min_bytes)
      return database.damaged(
          fmt::format("there are fewer {} of file {} than it says", kind_name(kind), file));
    blocks.emplace_back(data.begin(), data.end());
  }
}

Hash128 hash_of_blocks(std::span<const Hash128> hashes) {
  Hasher hasher;
  for (const Hash128& hash : hashes) hasher.add(hash.high).add(hash.low);
  return hasher.value();
}

Status write_blocks(Database& database, std::int64_t file, BlockKind kind,
                    std::span<const Blob> blocks) {
  Result<Statement> statement =
      database.prepare("INSERT INTO file_block (file, kind, number, data) VALUES (?1, ?2, ?3, ?4)");
  if (!statement) return statement.error();
  for (std::size_t number = 0; number < blocks.size(); ++number) {
    statement->bind(1, file).bind(2, kind_name(kind));
    statement->bind(3, static_cast<std::int64_t>(number)).bind(4, blocks[number]);
    if (const Status status = statement->run(); !status) return status;
  }
  return {};
}

Status remove_blocks(Database& database, std::int64_t file) {
  Result<Statement> statement = database.prepare("DELETE FROM file_block WHERE file = ?1");
  if (!statement) return statement.error();
  return statement->bind(1, file).run();
}

}  // namespace strake::project
