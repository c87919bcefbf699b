// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "project/codec/blob.hpp"
#include "project/model/blocks.hpp"
#include "project/model/file_blocks.hpp"
#include "project/model/file_rows.hpp"
#include "project/model/model_store.hpp"
#include "project/model/shape_packs.hpp"
#include "project/model/stored_diagnostics.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {
namespace {

namespace fs = std::filesystem;

fs::path whole_path(const fs::path& path) {
  std::error_code failed;
  const fs::path whole = fs::absolute(path, failed);
  return failed ? path : whole.lexically_normal();
}

/// Whether a model is what finish() makes of one file: what it is stored as relies on that.
bool is_finished_file(const model::Model& model) {
  if (model.files.size() != 1) return false;
  std::uint64_t bodies = 0;
  for (std::size_t i = 0; i < model.objects.size(); ++i) {
    const model::Object& object = model.objects[i];
    if (object.file != 0 || object.first_body != bodies || object.place >= model.objects.size() ||
        (object.parent != model::GroupId::none &&
         model::index(object.parent) >= model.groups.size()))
      return false;
    if (i > 0 && !(model.objects[i - 1].id < object.id)) return false;
    bodies += object.body_count;
  }
  const auto has_parts = [&](const model::Group& group) {
    return (group.parent == model::GroupId::none ||
            model::index(group.parent) < model.groups.size()) &&
           (group.attributes == model::Group::kNoAttributes ||
            group.attributes < model.group_attributes.size());
  };
  return bodies == model.bodies.size() && std::ranges::all_of(model.groups, has_parts) &&
         std::ranges::all_of(model.bodies, [&](const model::Body& body) {
           return model::index(body.shape) < model.shapes.size();
         });
}

/// Returns a vector in blocks, each packed by pack(items).
template <class T, class Pack>
Result<std::vector<Blob>> packed(const std::vector<T>& items, Pack&& pack,
                                 const parallel::Context& context) {
  return parallel::transform(
      context, {.name = "blocks of the project", .n = block_count(items.size())},
      [&](std::size_t b) -> Result<Blob> {
        return pack(std::span(items).subspan(b * kBlock, items_of_block(items.size(), b)));
      });
}

/// Returns the blocks of shapes; `places` say where the shared ones are.
Result<std::vector<Blob>> packed_shapes(const std::vector<model::Shape>& shapes,
                                        std::span<const PackedShape> places,
                                        const parallel::Context& context) {
  std::vector<std::size_t> first_shared{0};
  for (std::size_t i = 0, shared = 0; i < shapes.size(); ++i) {
    if (is_shared(shapes[i])) ++shared;
    if (i + 1 == shapes.size() || (i + 1) % kBlock == 0) first_shared.push_back(shared);
  }
  return parallel::transform(
      context, {.name = "blocks of the project", .n = block_count(shapes.size())},
      [&](std::size_t b) -> Result<Blob> {
        return pack_shapes(std::span(shapes).subspan(b * kBlock, items_of_block(shapes.size(), b)),
                           places.subspan(first_shared[b], first_shared[b + 1] - first_shared[b]));
      });
}

/// Stores files in a transaction.
class FileStore {
 public:
  FileStore(Database& database, const parallel::Context& context)
      : database_(database), context_(context) {}

  Status run(std::span<const FileToStore> files) {
    Result<std::vector<FileRow>> rows = read_rows(database_);
    if (!rows) return rows.error();
    rows_ = std::move(*rows);
    Result<std::vector<FileRow>> targets = find_targets(files);
    if (!targets) return targets.error();
    Result<ShapePacks> packs = ShapePacks::open(database_);
    if (!packs) return packs.error();
    for (std::size_t f = 0; f < files.size(); ++f)
      if (const Status status = store(files[f], (*targets)[f], *packs); !status) return status;
    if (replaces_)
      if (const Status status = sweep_packs(database_, context_); !status) return status;
    return write_labels(database_);
  }

 private:
  Result<std::vector<FileRow>> find_targets(std::span<const FileToStore> files);
  struct KindOfBlocks {
    BlockKind kind{};
    std::vector<Blob> blocks;
  };
  Status store(const FileToStore& file, FileRow& row, ShapePacks& packs);
  Result<std::vector<KindOfBlocks>> pack_all(const model::Model& model,
                                             std::span<const PackedShape> places);
  Status make_way(std::span<const FileRow> targets);

  Database& database_;
  const parallel::Context& context_;
  std::vector<FileRow> rows_;
  bool replaces_ = false;
};

/// Returns the row that each file takes, its path and place in it.
Result<std::vector<FileRow>> FileStore::find_targets(std::span<const FileToStore> files) {
  std::int64_t position = rows_.empty() ? 0 : rows_.back().position + 1;
  std::vector<FileRow> targets;
  std::set<std::int64_t> taken;
  std::set<fs::path> paths;
  for (const FileToStore& file : files) {
    if (!is_finished_file(file.model))
      return Error{ErrorCode::usage, "is not the finished model of one file", file.path.string(),
                   "read each file by io::read_models()"};
    FileRow row;
    row.file.path = whole_path(file.path);
    if (!paths.insert(row.file.path).second)
      return Error{ErrorCode::usage, "is given twice", file.path.string(), "give it once"};
    const auto same = std::ranges::find_if(rows_, [&](const FileRow& one) {
      return file.replaces ? one.file.id == *file.replaces : one.file.path == row.file.path;
    });
    if (same != rows_.end()) {
      row.file.id = same->file.id;
      row.position = same->position;
      replaces_ = true;
    } else if (file.replaces) {
      return Error{ErrorCode::usage, "the file that it replaces is not in the project",
                   file.path.string(), "list the files: strake project list"};
    } else {
      row.position = position++;
    }
    if (row.file.id != 0 && !taken.insert(row.file.id).second)
      return Error{ErrorCode::usage, "two files replace one", file.path.string(),
                   "let each replace another"};
    targets.push_back(std::move(row));
  }
  for (const FileRow& row : rows_)
    if (!taken.contains(row.file.id) && paths.contains(row.file.path))
      return Error{ErrorCode::usage, "is in the project already", row.file.path.string(),
                   "replace that one, or remove it first"};
  if (const Status status = make_way(targets); !status) return status.error();
  return targets;
}

/// Frees the paths of files that are replaced: two may change places.
Status FileStore::make_way(std::span<const FileRow> targets) {
  Result<Statement> statement =
      database_.prepare("UPDATE file SET path = '//' || id, label = '//' || id WHERE id = ?1");
  if (!statement) return statement.error();
  for (const FileRow& row : targets) {
    if (row.file.id == 0) continue;
    if (const Status status = statement->bind(1, row.file.id).run(); !status) return status;
  }
  return {};
}

Status FileStore::store(const FileToStore& file, FileRow& row, ShapePacks& packs) {
  const model::Model& model = file.model;
  const Result<std::vector<PackedShape>> places = packs.add(model.shapes, context_);
  if (!places) return places.error();
  row.file.given = file.given;
  row.name = model.files.front().label;
  row.file.options = file.options;
  row.file.content = file.content;
  row.file.source = model.files.front();
  // Until all are there, when they get theirs.
  row.file.source.label = fmt::format("//new {}", row.position);
  row.file.objects = model.objects.size();
  row.file.bodies = model.bodies.size();
  row.shapes = model.shapes.size();
  row.groups = model.groups.size();
  row.group_attributes = model.group_attributes.size();
  row.map = file.map;
  Result<std::vector<KindOfBlocks>> all = pack_all(model, *places);
  if (!all) return all.error();
  std::vector<Hash128> hashes;
  for (const KindOfBlocks& kind : *all)
    for (const Blob& blob : kind.blocks) hashes.push_back(BlobReader::raw_hash(blob));
  row.blocks = hash_of_blocks(hashes);

  if (row.file.id != 0)
    if (const Status status = remove_blocks(database_, row.file.id); !status) return status;
  if (const Status status = write_row(database_, row); !status) return status;
  for (const KindOfBlocks& kind : *all) {
    const Status status = write_blocks(database_, row.file.id, kind.kind, kind.blocks);
    if (!status) return status;
  }
  return {};
}

/// Returns the blocks of a file, in the order in which they are read again.
Result<std::vector<FileStore::KindOfBlocks>> FileStore::pack_all(
    const model::Model& model, std::span<const PackedShape> places) {
  std::vector<KindOfBlocks> all;
  const auto add = [&](BlockKind kind, Result<std::vector<Blob>> blocks) -> Status {
    if (!blocks) return blocks.error();
    all.push_back({kind, std::move(*blocks)});
    return {};
  };
  const auto diagnostics = [&]() -> Result<std::vector<Blob>> {
    Result<Blob> blob = pack_diagnostics(model.diagnostics);
    if (!blob) return blob.error();
    return std::vector<Blob>{std::move(*blob)};
  };
  Status status = add(BlockKind::objects, packed(model.objects, pack_objects, context_));
  if (status) status = add(BlockKind::bodies, packed(model.bodies, pack_bodies, context_));
  if (status) status = add(BlockKind::shapes, packed_shapes(model.shapes, places, context_));
  if (status) status = add(BlockKind::groups, packed(model.groups, pack_groups, context_));
  if (status)
    status =
        add(BlockKind::group_attributes, packed(model.group_attributes, pack_attributes, context_));
  if (status) status = add(BlockKind::diagnostics, diagnostics());
  if (!status) return status.error();
  return all;
}

Status remove(Database& database, std::span<const std::int64_t> files,
              const parallel::Context& context) {
  Result<Statement> statement = database.prepare("DELETE FROM file WHERE id = ?1");
  if (!statement) return statement.error();
  for (const std::int64_t file : files) {
    if (const Status status = statement->bind(1, file).run(); !status) return status;
    if (database.changes() != 1)
      return Error{ErrorCode::usage, fmt::format("there is no file {}", file),
                   database.file().string(), "list the files: strake project list"};
  }
  if (const Status status = sweep_packs(database, context); !status) return status;
  return write_labels(database);
}

}  // namespace

Status store_files(Project& project, std::span<const FileToStore> files,
                   const parallel::Context& context) {
  try {
    return FileStore(project.database(), context).run(files);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

Status remove_files(Project& project, std::span<const std::int64_t> files,
                    const parallel::Context& context) {
  try {
    return remove(project.database(), files, context);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

}  // namespace strake::project
