// SPDX-License-Identifier: Apache-2.0
#include "tiles/kept/section.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "project/codec/blob.hpp"
#include "project/model/blocks.hpp"
#include "project/model/file_blocks.hpp"
#include "project/model/shape_block.hpp"
#include "strake/parallel/transform.hpp"
#include "tiles/kept/blob_file.hpp"

namespace strake::tiles {
namespace {

using project::BlobReader;
using project::BlobWriter;

/// The blobs of a section; behind them stand packs of meshes.
enum BlobOf : std::size_t { kObjects, kBodies, kShapes, kHashes, kPacks };

Hash128 hash_of_section(std::span<const Blob> blobs) {
  std::vector<Hash128> hashes;
  hashes.reserve(blobs.size());
  for (const Blob& blob : blobs) hashes.push_back(BlobReader::raw_hash(blob));
  return project::hash_of_blocks(hashes);
}

/// Some objects of a file, with their bodies and the shapes of these.
class Extract {
 public:
  Extract(const model::Model& model, std::span<const std::uint32_t> objects,
          std::uint64_t bytes_of_pack)
      : model_(model) {
    objects_.reserve(objects.size());
    for (const std::uint32_t o : objects) add(model.objects[o]);
    begin_packs(bytes_of_pack);
  }

  [[nodiscard]] std::uint64_t bodies() const { return bodies_.size(); }
  [[nodiscard]] std::uint64_t shapes() const { return shapes_.size(); }

  [[nodiscard]] Result<std::vector<Blob>> pack(const parallel::Context& context) const {
    return parallel::transform(context, {.name = "pack geometry", .n = kPacks + packs()},
                               [&](std::size_t b) -> Result<Blob> {
                                 if (b == kObjects) return project::pack_objects(objects_);
                                 if (b == kBodies) return project::pack_bodies(bodies_);
                                 if (b == kShapes)
                                   return project::pack_shapes(shapes_, places_of_shared());
                                 if (b == kHashes) return pack_hashes();
                                 const std::size_t first = pack_begins_[b - kPacks];
                                 const std::size_t count = pack_begins_[b - kPacks + 1] - first;
                                 return project::pack_meshes(
                                     std::span(shared_).subspan(first, count),
                                     std::span(hashes_).subspan(first, count));
                               });
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

  void begin_packs(std::uint64_t bytes_of_pack) {
    std::uint64_t bytes = bytes_of_pack;
    for (const model::Shape* const shape : shared_) {
      if (bytes >= bytes_of_pack) {
        pack_begins_.push_back(hashes_.size());
        bytes = 0;
      }
      bytes += project::shape_bytes(*shape);
      hashes_.push_back(project::shape_hash(*shape));
    }
    pack_begins_.push_back(hashes_.size());
  }

  [[nodiscard]] std::size_t packs() const { return pack_begins_.size() - 1; }

  [[nodiscard]] std::vector<project::PackedShape> places_of_shared() const {
    std::vector<project::PackedShape> places;
    places.reserve(shared_.size());
    for (std::uint32_t p = 0; p < packs(); ++p)
      for (std::size_t s = pack_begins_[p]; s < pack_begins_[p + 1]; ++s)
        places.push_back({p, static_cast<std::uint32_t>(s - pack_begins_[p])});
    return places;
  }

  [[nodiscard]] Result<Blob> pack_hashes() const {
    BlobWriter out;
    out.number(packs());
    for (std::size_t p = 0; p < packs(); ++p) {
      out.number(pack_begins_[p + 1] - pack_begins_[p]);
      for (std::size_t s = pack_begins_[p]; s < pack_begins_[p + 1]; ++s) out.hash(hashes_[s]);
    }
    return out.finish();
  }

  const model::Model& model_;
  std::vector<model::Object> objects_;
  std::vector<model::Body> bodies_;
  std::vector<model::Shape> shapes_;
  std::vector<const model::Shape*> shared_;
  std::vector<Hash128> hashes_;           ///< of the shared ones
  std::vector<std::size_t> pack_begins_;  ///< which of these begin a pack; how many there are
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_;
};

/// Puts the blobs of a section behind what a model has.
class Appending {
 public:
  Appending(std::span<const Blob> blobs, std::string what, const Section& section,
            model::Model& model)
      : blobs_(blobs), what_(std::move(what)), model_(model) {
    place_.file = section.file;
    place_.objects = section.last - section.first;
    place_.bodies = static_cast<std::uint32_t>(section.bodies);
    place_.shapes = static_cast<std::uint32_t>(section.shapes);
    place_.first_object = static_cast<std::uint32_t>(model.objects.size());
    place_.first_body = static_cast<std::uint32_t>(model.bodies.size());
    place_.first_shape = static_cast<std::uint32_t>(model.shapes.size());
  }

  Status run() {
    model_.objects.resize(place_.first_object + place_.objects);
    model_.bodies.resize(place_.first_body + place_.bodies);
    model_.shapes.resize(place_.first_shape + place_.shapes);
    const auto range = project::unpack_objects(
        blobs_[kObjects], what_, place_, std::span(model_.objects).subspan(place_.first_object));
    if (!range) return range.error();
    if (range->first != 0 || range->last != place_.bodies) return refused();
    if (const Status s = project::unpack_bodies(
            blobs_[kBodies], what_, place_, std::span(model_.bodies).subspan(place_.first_body));
        !s)
      return s;
    return put_shapes();
  }

 private:
  [[nodiscard]] Error refused() const { return {ErrorCode::input, kLost, what_, ""}; }

  Status put_shapes() {
    const auto shared = project::unpack_shapes(
        blobs_[kShapes], what_, std::span(model_.shapes).subspan(place_.first_shape));
    if (!shared) return shared.error();
    const auto hashes = unpack_hashes();
    if (!hashes) return hashes.error();
    // They stand in the order of their packs, of which one is unpacked at a time.
    std::vector<model::Shape> pack;
    std::size_t unpacked = 0;
    for (const project::SharedShape& shape : *shared) {
      while (unpacked <= shape.from.pack) {
        if (unpacked == hashes->size()) return refused();
        auto next = project::unpack_meshes(blobs_[kPacks + unpacked], (*hashes)[unpacked], what_);
        if (!next) return next.error();
        pack = std::move(*next);
        ++unpacked;
      }
      if (unpacked != shape.from.pack + 1 || shape.from.number >= pack.size()) return refused();
      model_.shapes[place_.first_shape + shape.at] = std::move(pack[shape.from.number]);
    }
    return {};
  }

  /// Returns the hashes of the meshes of each pack, of which there are as many as blobs.
  [[nodiscard]] Result<std::vector<std::vector<Hash128>>> unpack_hashes() const {
    Result<BlobReader> in = BlobReader::open(blobs_[kHashes], what_);
    if (!in) return in.error();
    const std::uint64_t packs = in->number();
    if (packs != blobs_.size() - kPacks) in->refuse("packs lack");
    std::vector<std::vector<Hash128>> hashes;
    for (std::uint64_t p = 0; p < packs && !in->failed(); ++p) {
      std::vector<Hash128>& of_pack = hashes.emplace_back();
      for (std::uint64_t n = in->number(); n > 0 && !in->failed(); --n)
        of_pack.push_back(in->hash());
    }
    if (const Status s = in->finish(); !s) return s.error();
    return hashes;
  }

  std::span<const Blob> blobs_;
  std::string what_;
  model::Model& model_;
  project::FilePlace place_;
};

}  // namespace

Result<Section> write_section(const std::filesystem::path& to, const model::Model& model,
                              std::span<const std::uint32_t> objects,
                              const parallel::Context& context, std::uint64_t bytes_of_pack) {
  const Extract extract(model, objects, bytes_of_pack);
  const Result<std::vector<Blob>> blobs = extract.pack(context);
  if (!blobs) return blobs.error();
  if (const Status s = write_blobs(to, *blobs); !s) return s.error();
  Section section;
  section.last = static_cast<std::uint32_t>(objects.size());
  section.bodies = extract.bodies();
  section.shapes = extract.shapes();
  section.hash = hash_of_section(*blobs);
  return section;
}

Status append_section(const std::filesystem::path& from, const Section& section,
                      model::Model& model, const parallel::Context& context) {
  const Result<std::vector<Blob>> blobs = read_blobs(from, kPacks, context);
  if (!blobs) return blobs.error();
  if (hash_of_section(*blobs) != section.hash) return lost(from);
  const Status s = Appending(*blobs, from.string(), section, model).run();
  if (!s && s.error().code == ErrorCode::input) return lost(from);
  return s;
}

}  // namespace strake::tiles
