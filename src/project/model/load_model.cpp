// SPDX-License-Identifier: Apache-2.0
#include "project/model/load_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/importer/map_place.hpp"
#include "project/codec/blob.hpp"
#include "project/model/blocks.hpp"
#include "project/model/file_blocks.hpp"
#include "project/model/file_rows.hpp"
#include "project/model/shape_packs.hpp"
#include "project/model/stored_diagnostics.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {
namespace {

/// A block that is to be unpacked.
struct BlockTask {
  BlockKind kind{};
  std::uint32_t row = 0;
  std::uint32_t number = 0;  ///< among the blocks of its kind of the file
  Blob blob;
};

/// What a block says besides what it puts into the model.
struct BlockFindings {
  BodyRange bodies;                 ///< of objects
  std::vector<SharedShape> shared;  ///< of shapes
  Diagnostics diagnostics;
};

/// Puts a model together. What finish() did to each file alone is stored; it gives files their
/// order and labels, on which nothing else in it depends.
class ModelLoader {
 public:
  ModelLoader(Database& database, const parallel::Context& context)
      : database_(database), context_(context) {}

  Result<SignedModel> run() {
    const auto steps = {&ModelLoader::place_files,  &ModelLoader::read_all,
                        &ModelLoader::make_room,    &ModelLoader::unpack,
                        &ModelLoader::check_blocks, &ModelLoader::share_shapes};
    for (const auto step : steps)
      if (const Status status = (this->*step)(); !status) return status.error();
    join_diagnostics();
    return SignedModel{std::move(model_), std::move(shape_hashes_), hash_of_names(),
                       hashes_of_bodies()};
  }

 private:
  Status place_files();
  Status read_all();
  Status read_kind(std::uint32_t row, BlockKind kind, std::uint64_t items);
  Status make_room();
  Status unpack();
  Result<BlockFindings> unpack_block(const BlockTask& task);
  Status check_blocks();
  Status share_shapes();
  void join_diagnostics();
  [[nodiscard]] Diagnostics place_diagnostics() const;
  [[nodiscard]] Hash128 hash_of_names() const;
  [[nodiscard]] std::vector<clash::HashedBodies> hashes_of_bodies() const;
  [[nodiscard]] std::string name_of(const BlockTask& task) const {
    return block_name(database_, rows_[task.row], task.kind);
  }
  /// Returns where the items of a block lie, in the model or in the file.
  [[nodiscard]] std::size_t first_of(const BlockTask& task) const { return task.number * kBlock; }

  Database& database_;
  const parallel::Context& context_;
  std::vector<FileRow> rows_;
  std::vector<FilePlace> places_;        ///< of each row
  std::vector<std::uint32_t> by_label_;  ///< rows in the order of their labels
  FilePlace total_;                      ///< first_…: how many there are of all files
  std::vector<BlockTask> tasks_;
  std::vector<BlockFindings> findings_;
  model::Model model_;
  std::vector<Hash128> shape_hashes_;
};

/// Counts on; false where there are more than can be numbered.
bool add_to(std::uint32_t& sum, std::uint32_t more) {
  if (more > std::numeric_limits<std::uint32_t>::max() - 1 - sum) return false;
  sum += more;
  return true;
}

Status ModelLoader::place_files() {
  Result<std::vector<FileRow>> rows = read_sealed_rows(database_);
  if (!rows) return rows.error();
  rows_ = std::move(*rows);
  LabelledFiles files = labelled(rows_);
  model_.files = std::move(files.files);
  by_label_.resize(rows_.size());
  places_.resize(rows_.size());
  bool fits = true;
  // What comes in the order in which files are read.
  for (std::uint32_t r = 0; r < rows_.size(); ++r) {
    const FileRow& row = rows_[r];
    FilePlace& place = places_[r];
    place.file = files.number[r];
    if (model_.files[place.file].label != row.file.source.label)
      return database_.damaged("the labels of files are not those that they have");
    by_label_[place.file] = r;
    place.objects = static_cast<std::uint32_t>(row.file.objects);
    place.bodies = static_cast<std::uint32_t>(row.file.bodies);
    place.shapes = static_cast<std::uint32_t>(row.shapes);
    place.groups = static_cast<std::uint32_t>(row.groups);
    place.attributes = static_cast<std::uint32_t>(row.group_attributes);
    place.first_place = total_.first_place;
    place.first_shape = total_.first_shape;
    place.first_group = total_.first_group;
    place.first_attributes = total_.first_attributes;
    fits = fits && add_to(total_.first_place, place.objects) &&
           add_to(total_.first_shape, place.shapes) && add_to(total_.first_group, place.groups) &&
           add_to(total_.first_attributes, place.attributes);
  }
  // And in that of their labels.
  for (const std::uint32_t r : by_label_) {
    FilePlace& place = places_[r];
    place.first_object = total_.first_object;
    place.first_body = total_.first_body;
    fits = fits && add_to(total_.first_object, place.objects) &&
           add_to(total_.first_body, place.bodies);
  }
  if (!fits) return database_.damaged("it says that it has more objects than can be numbered");
  return {};
}

Status ModelLoader::read_kind(std::uint32_t row, BlockKind kind, std::uint64_t items) {
  Result<std::vector<Blob>> blocks = read_blocks(database_, rows_[row].file.id, kind, items);
  if (!blocks) return blocks.error();
  for (std::uint32_t number = 0; number < blocks->size(); ++number)
    tasks_.push_back({kind, row, number, std::move((*blocks)[number])});
  return {};
}

Status ModelLoader::read_all() {
  for (std::uint32_t r = 0; r < rows_.size(); ++r) {
    const FileRow& row = rows_[r];
    const std::size_t before = tasks_.size();
    const std::pair<BlockKind, std::uint64_t> kinds[] = {
        {BlockKind::objects, row.file.objects},
        {BlockKind::bodies, row.file.bodies},
        {BlockKind::shapes, row.shapes},
        {BlockKind::groups, row.groups},
        {BlockKind::group_attributes, row.group_attributes},
        {BlockKind::diagnostics, 1}};
    for (const auto& [kind, items] : kinds)
      if (const Status status = read_kind(r, kind, items); !status) return status;
    std::vector<Hash128> hashes;
    for (std::size_t t = before; t < tasks_.size(); ++t)
      hashes.push_back(BlobReader::raw_hash(tasks_[t].blob));
    if (hash_of_blocks(hashes) != row.blocks)
      return database_.damaged("the blocks of " + row.file.source.label +
                               " are not those that were stored");
  }
  return {};
}

Status ModelLoader::make_room() {
  const auto give = [&](auto& to, std::uint32_t count) -> Status {
    auto room = parallel::slots<typename std::remove_reference_t<decltype(to)>::value_type>(
        count, context_);
    if (!room) return room.error();
    to = std::move(*room);
    return {};
  };
  Status status = give(model_.objects, total_.first_object);
  if (status) status = give(model_.bodies, total_.first_body);
  if (status) status = give(model_.shapes, total_.first_shape);
  if (status) status = give(model_.groups, total_.first_group);
  if (status) status = give(model_.group_attributes, total_.first_attributes);
  return status;
}

Status ModelLoader::unpack() {
  auto findings =
      parallel::transform(context_, {.name = "model of the project", .n = tasks_.size()},
                          [&](std::size_t t) { return unpack_block(tasks_[t]); });
  if (!findings) return findings.error();
  findings_ = std::move(*findings);
  return {};
}

Result<BlockFindings> ModelLoader::unpack_block(const BlockTask& task) {
  const FilePlace& place = places_[task.row];
  const auto part = [&](auto& all, std::uint32_t first, std::uint32_t count) {
    return std::span(all).subspan(first + first_of(task), items_of_block(count, task.number));
  };
  BlockFindings found;
  Status status;
  switch (task.kind) {
    case BlockKind::objects: {
      const Result<BodyRange> bodies = unpack_objects(
          task.blob, name_of(task), place, part(model_.objects, place.first_object, place.objects));
      if (!bodies) return bodies.error();
      found.bodies = *bodies;
      break;
    }
    case BlockKind::shapes: {
      Result<std::vector<SharedShape>> shared = unpack_shapes(
          task.blob, name_of(task), part(model_.shapes, place.first_shape, place.shapes));
      if (!shared) return shared.error();
      found.shared = std::move(*shared);
      break;
    }
    case BlockKind::diagnostics: {
      Result<Diagnostics> diagnostics = unpack_diagnostics(task.blob, name_of(task));
      if (!diagnostics) return diagnostics.error();
      found.diagnostics = std::move(*diagnostics);
      break;
    }
    case BlockKind::bodies:
      status = unpack_bodies(task.blob, name_of(task), place,
                             part(model_.bodies, place.first_body, place.bodies));
      break;
    case BlockKind::groups:
      status = unpack_groups(task.blob, name_of(task), place,
                             part(model_.groups, place.first_group, place.groups));
      break;
    case BlockKind::group_attributes:
      status = unpack_attributes(
          task.blob, name_of(task),
          part(model_.group_attributes, place.first_attributes, place.attributes));
      break;
  }
  if (!status) return status.error();
  return found;
}

/// Blocks of objects go on where the one before ends, in their ids and their bodies.
Status ModelLoader::check_blocks() {
  std::vector<std::uint64_t> bodies(rows_.size(), 0);
  for (std::size_t t = 0; t < tasks_.size(); ++t) {
    const BlockTask& task = tasks_[t];
    if (task.kind != BlockKind::objects) continue;
    const std::size_t first = places_[task.row].first_object + first_of(task);
    const bool in_order =
        task.number == 0 || model_.objects[first - 1].id < model_.objects[first].id;
    if (!in_order || findings_[t].bodies.first != bodies[task.row])
      return database_.damaged(name_of(task) + " are not in order");
    bodies[task.row] = findings_[t].bodies.last;
  }
  for (std::size_t r = 0; r < rows_.size(); ++r)
    if (bodies[r] != places_[r].bodies)
      return database_.damaged("there are bodies of no object in " + rows_[r].file.source.label);
  return {};
}

/// Puts meshes and polylines where files have them. The last file that has a shape takes it.
Status ModelLoader::share_shapes() {
  Result<std::vector<UnpackedPack>> unpacked = unpack_all(database_, context_);
  if (!unpacked) return unpacked.error();
  std::vector<UnpackedPack>& packs = *unpacked;
  std::vector<std::vector<std::uint32_t>> uses;
  for (const UnpackedPack& pack : packs) uses.emplace_back(pack.shapes.size(), 0);
  for (std::size_t t = 0; t < tasks_.size(); ++t) {
    const std::size_t first = places_[tasks_[t].row].first_shape + first_of(tasks_[t]);
    for (SharedShape& shared : findings_[t].shared) {
      const auto pack = std::ranges::lower_bound(packs, shared.from.pack, {}, &UnpackedPack::id);
      if (pack == packs.end() || pack->id != shared.from.pack ||
          shared.from.number >= pack->shapes.size() ||
          pack->hashes[shared.from.number] == Hash128())
        return database_.damaged(name_of(tasks_[t]) + " are not in their packs");
      // From here on they are numbered in the model, and packs as they lie here.
      shared.at += static_cast<std::uint32_t>(first);
      shared.from.pack = static_cast<std::uint32_t>(pack - packs.begin());
      ++uses[shared.from.pack][shared.from.number];
    }
  }
  shape_hashes_.resize(model_.shapes.size());
  for (const BlockFindings& findings : findings_)
    for (const SharedShape& shared : findings.shared) {
      model::Shape& shape = packs[shared.from.pack].shapes[shared.from.number];
      shape_hashes_[shared.at] = packs[shared.from.pack].hashes[shared.from.number];
      if (--uses[shared.from.pack][shared.from.number] == 0)
        model_.shapes[shared.at] = std::move(shape);
      else
        model_.shapes[shared.at] = shape;
    }
  return {};
}

void ModelLoader::join_diagnostics() {
  std::vector<FileDiagnostics> files(rows_.size());
  for (std::size_t t = 0; t < tasks_.size(); ++t) {
    if (tasks_[t].kind != BlockKind::diagnostics) continue;
    const FileRow& row = rows_[tasks_[t].row];
    files[places_[tasks_[t].row].file] = {std::move(findings_[t].diagnostics), row.name,
                                          row.file.source.label, row.file.given};
  }
  model_.diagnostics = joined_diagnostics(files, place_diagnostics());
}

/// Files of a project lie in coordinates of their own.
Diagnostics ModelLoader::place_diagnostics() const {
  std::vector<io::FilePlace> places;
  for (const FileRow& row : rows_) places.push_back({row.file.given, row.map});
  std::ranges::sort(places, {}, &io::FilePlace::file);
  return io::place_diagnostics(places, false);
}

/// Objects are ordered by the labels of their files, then as their blocks are.
Hash128 ModelLoader::hash_of_names() const {
  std::vector<std::vector<Hash128>> blocks(rows_.size());
  for (const BlockTask& task : tasks_)
    if (task.kind == BlockKind::objects)
      blocks[task.row].push_back(BlobReader::raw_hash(task.blob));
  Hasher hasher;
  for (const std::uint32_t row : by_label_) {
    hasher.add(std::string_view(rows_[row].file.source.label)).add(rows_[row].file.objects);
    for (const Hash128& block : blocks[row]) hasher.add(block.high).add(block.low);
  }
  return hasher.value();
}

/// In the order of bodies.
std::vector<clash::HashedBodies> ModelLoader::hashes_of_bodies() const {
  std::vector<clash::HashedBodies> hashes;
  for (const BlockTask& task : tasks_) {
    if (task.kind != BlockKind::bodies) continue;
    const FilePlace& place = places_[task.row];
    hashes.push_back(
        {static_cast<std::uint32_t>(place.first_body + first_of(task)),
         WordHash().add(BlobReader::raw_hash(task.blob)).add(place.first_shape).value()});
  }
  std::ranges::sort(hashes, {}, &clash::HashedBodies::first);
  return hashes;
}

}  // namespace

Result<SignedModel> load_model(Database& database, const parallel::Context& context) {
  return ModelLoader(database, context).run();
}

}  // namespace strake::project
