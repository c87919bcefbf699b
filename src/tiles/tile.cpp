// SPDX-License-Identifier: Apache-2.0
#include "tiles/tile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "project/codec/blob.hpp"
#include "project/model/columns.hpp"
#include "strake/parallel/for_each.hpp"
#include "tiles/kept/blob_file.hpp"

namespace strake::tiles {
namespace {

using project::BlobReader;
using project::BlobWriter;

std::filesystem::path section_file(const std::filesystem::path& tile, std::uint32_t file) {
  return std::filesystem::path(tile).replace_extension(fmt::format("file{}", file));
}

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
  constexpr std::uint64_t kMax = 1U << 31U;
  std::uint32_t at = 0;
  for (const Section& s : tile.sections) {
    if (s.first != at || s.last < s.first || s.file >= tile.model.files.size() || s.bodies > kMax ||
        s.shapes > kMax)
      return false;
    at = s.last;
  }
  return at == tile.objects.size();
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
    const Result<const model::Model*> model = what_.reader.read_again(file.given, context_);
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
          Result<Section> section = write_section(
              section_file(tile_file(what_.folder, what_.tiles[k]), f), **model, objects, {});
          if (!section) return section.error();
          section->file = f;
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
    if (const Status s = append_section(part, section, tile->model, context); !s) return s.error();
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
