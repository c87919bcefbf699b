// SPDX-License-Identifier: Apache-2.0
#include "tiles/tile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <variant>

#include "project/codec/blob.hpp"
#include "project/model/columns.hpp"
#include "project/model/file_blocks.hpp"
#include "project/model/shape_block.hpp"
#include "strake/parallel/for_each.hpp"
#include "tiles/blob_file.hpp"

namespace strake::tiles {
namespace {

using project::BlobReader;
using project::BlobWriter;
using project::FilePlace;

constexpr std::size_t kSectionBlobs = 5;

std::filesystem::path section_file(const std::filesystem::path& tile, std::uint32_t file) {
  return std::filesystem::path(tile).replace_extension(fmt::format("file{}", file));
}

Hash128 hash_of_section(std::span<const Blob> blobs) {
  std::array<Hash128, kSectionBlobs> hashes;
  for (std::size_t b = 0; b < kSectionBlobs; ++b) hashes[b] = BlobReader::raw_hash(blobs[b]);
  return project::hash_of_blocks(hashes);
}

/// Some objects of a file, with their bodies and the shapes of these.
class Extract {
 public:
  Extract(const model::Model& model, std::span<const std::uint32_t> objects) : model_(model) {
    objects_.reserve(objects.size());
    for (const std::uint32_t o : objects) add(model.objects[o]);
  }

  [[nodiscard]] std::uint64_t bodies() const { return bodies_.size(); }
  [[nodiscard]] std::uint64_t shapes() const { return shapes_.size(); }

  [[nodiscard]] Result<std::vector<Blob>> pack() const {
    std::vector<Hash128> hashes;
    for (const model::Shape* const shape : shared_) hashes.push_back(project::shape_hash(*shape));
    std::vector<project::PackedShape> packed(shared_.size());
    for (std::uint32_t s = 0; s < packed.size(); ++s) packed[s].number = s;
    BlobWriter of_shared;
    of_shared.number(hashes.size());
    for (const Hash128& hash : hashes) of_shared.hash(hash);
    std::array<Result<Blob>, kSectionBlobs> made{
        project::pack_objects(objects_), project::pack_bodies(bodies_),
        project::pack_shapes(shapes_, packed), project::pack_meshes(shared_, hashes),
        of_shared.finish()};
    std::vector<Blob> blobs;
    for (Result<Blob>& blob : made) {
      if (!blob) return blob.error();
      blobs.push_back(std::move(*blob));
    }
    return blobs;
  }

 private:
  void add(const model::Object& object) {
    model::Object& mine = objects_.emplace_back();
    mine.id = object.id;
    mine.incomplete = object.incomplete;
    mine.body_count = object.body_count;
    mine.first_body = static_cast<std::uint32_t>(bodies_.size());
    mine.place = static_cast<std::uint32_t>(objects_.size() - 1);
    for (std::uint32_t b = object.first_body; b < object.first_body + object.body_count; ++b) {
      model::Body body = model_.bodies[b];
      const auto next = static_cast<std::uint32_t>(shapes_.size());
      const auto [at, is_new] = numbers_.try_emplace(index(body.shape), next);
      if (is_new) take(model_.shapes[index(body.shape)]);
      body.shape = model::ShapeId{at->second};
      bodies_.push_back(body);
    }
  }

  void take(const model::Shape& shape) {
    if (!project::is_shared(shape)) {
      shapes_.push_back(shape);
      return;
    }
    shapes_.emplace_back(geometry::TriangleMesh{});  // it is packed with the shared ones
    shared_.push_back(&shape);
  }

  const model::Model& model_;
  std::vector<model::Object> objects_;
  std::vector<model::Body> bodies_;
  std::vector<model::Shape> shapes_;
  std::vector<const model::Shape*> shared_;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_;
};

void write_cell(BlobWriter& out, const clash::Cell& cell) {
  for (const geometry::Vec3l& corner : {cell.lo, cell.hi})
    for (int k = 0; k < 3; ++k) out.integer(corner[k]);
}

clash::Cell read_cell(BlobReader& in) {
  clash::Cell cell;
  for (geometry::Vec3l* const corner : {&cell.lo, &cell.hi})
    for (int k = 0; k < 3; ++k) (*corner)[k] = in.integer();
  return cell;
}

void write_scene(BlobWriter& out, const model::SceneOptions& scene) {
  out.real(scene.sag_mm);
  out.real(scene.weld_mm);
  out.flags({scene.physical, scene.obstruction, scene.insulation});
}

model::SceneOptions read_scene(BlobReader& in) {
  model::SceneOptions scene;
  scene.sag_mm = in.real();
  scene.weld_mm = in.real();
  const std::vector<bool> flags = in.flags();
  if (flags.size() != 3) {
    in.refuse("categories lack");
    return scene;
  }
  scene.physical = flags[0];
  scene.obstruction = flags[1];
  scene.insulation = flags[2];
  return scene;
}

void write_sections(BlobWriter& out, const std::vector<Section>& sections) {
  out.number(sections.size());
  for (const Section& s : sections) {
    for (const std::uint64_t n :
         {std::uint64_t{s.file}, std::uint64_t{s.first}, std::uint64_t{s.last}, s.bodies, s.shapes})
      out.number(n);
    out.hash(s.hash);
  }
}

std::vector<Section> read_sections(BlobReader& in) {
  std::vector<Section> sections;
  for (std::uint64_t n = in.number(); n > 0 && !in.failed(); --n) {
    Section& s = sections.emplace_back();
    for (std::uint32_t* const part : {&s.file, &s.first, &s.last})
      *part = static_cast<std::uint32_t>(in.number());
    s.bodies = in.number();
    s.shapes = in.number();
    s.hash = in.hash();
  }
  return sections;
}

/// Whether sections follow each other and fill the objects of a tile.
bool are_sound(const Tile& tile) {
  constexpr std::uint64_t kMost = 1U << 31U;
  std::uint32_t at = 0;
  for (const Section& s : tile.sections) {
    if (s.first != at || s.last < s.first || s.file >= tile.model.files.size() ||
        s.bodies > kMost || s.shapes > kMost)
      return false;
    at = s.last;
  }
  return at == tile.objects.size();
}

/// Puts the geometry of a section behind that of the model.
Status append_section(const std::filesystem::path& file, const Section& section,
                      model::Model& model, const parallel::Context& context) {
  Result<std::vector<Blob>> blobs = read_blobs(file, kSectionBlobs, context);
  if (!blobs) return blobs.error();
  if (hash_of_section(*blobs) != section.hash) return lost(file);
  const std::string what = file.string();
  FilePlace place;
  place.file = section.file;
  place.objects = section.last - section.first;
  place.first_body = static_cast<std::uint32_t>(model.bodies.size());
  place.bodies = static_cast<std::uint32_t>(section.bodies);
  place.first_shape = static_cast<std::uint32_t>(model.shapes.size());
  place.shapes = static_cast<std::uint32_t>(section.shapes);
  place.first_object = static_cast<std::uint32_t>(model.objects.size());
  model.objects.resize(model.objects.size() + place.objects);
  model.bodies.resize(model.bodies.size() + place.bodies);
  model.shapes.resize(model.shapes.size() + place.shapes);
  const auto range = project::unpack_objects((*blobs)[0], what, place,
                                             std::span(model.objects).subspan(place.first_object));
  if (!range) return range.error();
  if (range->first != 0 || range->last != place.bodies) return lost(file);
  if (Status s = project::unpack_bodies((*blobs)[1], what, place,
                                        std::span(model.bodies).subspan(place.first_body));
      !s)
    return s;
  const auto shared =
      project::unpack_shapes((*blobs)[2], what, std::span(model.shapes).subspan(place.first_shape));
  if (!shared) return shared.error();
  Result<BlobReader> of_shared = BlobReader::open((*blobs)[4], what);
  if (!of_shared) return of_shared.error();
  std::vector<Hash128> hashes;
  for (std::uint64_t n = of_shared->number(); n > 0 && !of_shared->failed(); --n)
    hashes.push_back(of_shared->hash());
  if (Status s = of_shared->finish(); !s) return s;
  auto meshes = project::unpack_meshes((*blobs)[3], hashes, what);
  if (!meshes) return meshes.error();
  for (const project::SharedShape& shape : *shared) {
    if (shape.from.number >= meshes->size()) return lost(file);
    model.shapes[place.first_shape + shape.at] = std::move((*meshes)[shape.from.number]);
  }
  return {};
}

/// The first blob of a head; those of the tests follow.
Result<Tile> read_start(const Blob& blob, const std::string& what) {
  Result<BlobReader> in = BlobReader::open(blob, what);
  if (!in) return in.error();
  Tile tile;
  tile.cell = read_cell(*in);
  tile.scene = read_scene(*in);
  for (std::string& label : in->texts()) {
    model::SourceFile& file = tile.model.files.emplace_back();
    file.label = std::move(label);
  }
  tile.objects = project::read_steps(*in);
  tile.sections = read_sections(*in);
  if (!in->failed() && !are_sound(tile)) in->refuse("its sections do not fit");
  if (const Status status = in->finish(); !status) return status.error();
  return tile;
}

/// Writes tiles section by section.
class TileWriter {
 public:
  TileWriter(const TilesToWrite& what, const parallel::Context& context)
      : what_(what), context_(context), sections_(what.tiles.size()) {}

  Status run() {
    for (std::uint32_t f = 0; f < what_.outline.files.size(); ++f)
      if (Status s = write_file(f); !s) return s;
    return parallel::for_each(context_, {.name = "write tiles", .n = what_.tiles.size()},
                              [&](std::size_t k) { return write_head_of(k); });
  }

 private:
  Status write_file(std::uint32_t f) {
    const Outline::File& file = what_.outline.files[f];
    const Result<const model::Model*> model = what_.reader.read(file.given, context_);
    if (!model) return model.error();
    const bool several = what_.outline.files.size() > 1;
    if ((*model)->objects.size() != file.objects || (several && hash_of_ids(**model) != file.names))
      return Error{ErrorCode::input, "changed while it was cut",
                   what_.reader.files()[file.given].path.string(), "start the run again"};
    return parallel::for_each(
        context_, {.name = "cut a file", .n = what_.tiles.size()}, [&](std::size_t k) -> Status {
          const std::span<const std::uint32_t> all = what_.objects_of(what_.tiles[k]);
          const auto first = std::ranges::lower_bound(all, file.first);
          const auto last = std::ranges::lower_bound(all, file.first + file.objects);
          if (first == last) return {};
          std::vector<std::uint32_t> objects(first, last);
          for (std::uint32_t& o : objects) o -= file.first;
          Result<Section> section =
              write_section(tile_file(what_.folder, what_.tiles[k]), f, **model, objects);
          if (!section) return section.error();
          section->first = static_cast<std::uint32_t>(first - all.begin());
          section->last = static_cast<std::uint32_t>(last - all.begin());
          sections_[k].push_back(*section);
          return {};
        });
  }

  [[nodiscard]] Status write_head_of(std::size_t k) const {
    const std::size_t number = what_.tiles[k];
    Result<Tile> tile = what_.head_of(number);
    if (!tile) return tile.error();
    const std::span<const std::uint32_t> objects = what_.objects_of(number);
    tile->objects.assign(objects.begin(), objects.end());
    tile->sections = sections_[k];
    tile->model.files = what_.outline.model.files;
    return write_head(tile_file(what_.folder, number), *tile);
  }

  const TilesToWrite& what_;
  const parallel::Context& context_;
  std::vector<std::vector<Section>> sections_;
};

}  // namespace

Result<Section> write_section(const std::filesystem::path& tile, std::uint32_t file,
                              const model::Model& model, std::span<const std::uint32_t> objects) {
  const Extract extract(model, objects);
  const Result<std::vector<Blob>> blobs = extract.pack();
  if (!blobs) return blobs.error();
  if (const Status s = write_blobs(section_file(tile, file), *blobs); !s) return s.error();
  Section section;
  section.file = file;
  section.bodies = extract.bodies();
  section.shapes = extract.shapes();
  section.hash = hash_of_section(*blobs);
  return section;
}

Status write_head(const std::filesystem::path& file, const Tile& tile) {
  BlobWriter out;
  write_cell(out, tile.cell);
  write_scene(out, tile.scene);
  std::vector<std::string> labels;
  for (const model::SourceFile& source : tile.model.files) labels.push_back(source.label);
  out.texts(labels);
  project::write_steps(out, tile.objects);
  write_sections(out, tile.sections);
  Result<Blob> start = out.finish();
  if (!start) return start.error();
  std::vector<Blob> blobs{std::move(*start)};
  blobs.insert(blobs.end(), tile.tasks.begin(), tile.tasks.end());
  return write_blobs(file, blobs);
}

Result<Tile> read_tile(const std::filesystem::path& file, const parallel::Context& context) {
  Result<std::vector<Blob>> blobs = read_blobs(file, 1, context);
  if (!blobs) return blobs.error();
  Result<Tile> tile = read_start(blobs->front(), file.string());
  if (!tile) return lost(file);
  std::ranges::move(std::span(*blobs).subspan(1), std::back_inserter(tile->tasks));
  for (const Section& section : tile->sections) {
    const std::filesystem::path part = section_file(file, section.file);
    if (const Status s = append_section(part, section, tile->model, context); !s)
      return s.error().code == ErrorCode::input ? lost(part) : s.error();
  }
  return tile;
}

std::filesystem::path tile_file(const std::filesystem::path& folder, std::size_t tile) {
  return folder / fmt::format("tile{:06}.strake-tile", tile);
}

Hash128 hash_of(std::span<const std::uint32_t> objects) {
  return hash_bytes(std::as_bytes(objects));
}

Status write_tiles(const TilesToWrite& what, const parallel::Context& context) {
  return TileWriter(what, context).run();
}

}  // namespace strake::tiles
