// SPDX-License-Identifier: Apache-2.0
#include "tiles/tiled_view.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "hlr/incremental/solve_part.hpp"
#include "hlr/parts/join_parts.hpp"
#include "hlr/results/object_fates.hpp"
#include "hlr/sections/section_planes.hpp"
#include "project/codec/blob.hpp"
#include "project/views/drawing_codec.hpp"
#include "strake/geometry/grid.hpp"
#include "tiles/view_task.hpp"

namespace strake::tiles {
namespace {

using project::BlobReader;
using project::BlobWriter;

/// So far the meshes that a view makes may reach beyond those of the scene, grid units.
constexpr std::int64_t kRoom = 4000;

template <class T>
std::vector<T> of_objects(const std::vector<T>& all, std::span<const std::uint32_t> objects) {
  std::vector<T> some;
  if (all.empty()) return some;
  some.reserve(objects.size());
  for (const std::uint32_t o : objects) some.push_back(all[o]);
  return some;
}

/// Returns for each body of some objects whether the view has its shape finer than the scene.
std::vector<bool> finer_bodies(const CutView& cut, std::span<const std::uint32_t> objects) {
  const model::Scene& scene = cut.outline.scene;
  std::vector<bool> finer;
  if (cut.whole.tessellation.finer.empty()) return finer;
  for (const std::uint32_t o : objects) {
    const model::Object& object = cut.outline.model.objects[o];
    const std::size_t first = finer.size();
    finer.resize(first + object.body_count);
    for (const model::GridBody& body : scene.bodies_of(model::ObjectId{o}))
      finer[first + (body.body - object.first_body)] =
          cut.whole.tessellation.is_finer(body.grid_shape);
  }
  return finer;
}

/// Names the objects that a report of a view may tell of, as the eye lies in their boxes.
void name_objects(const CutView& cut, std::span<const std::uint32_t> objects, ViewTask& task) {
  const auto& perspective = cut.view.perspective;
  if (!perspective) return;
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    if (!cut.whole.boxes[objects[i]].contains({perspective->eye, perspective->eye})) continue;
    task.named.push_back(i);
    task.names.push_back(cut.outline.model.objects[objects[i]].name);
  }
}

ViewTask task_of(const CutView& cut, const hlr::ViewPart& part) {
  ViewTask task;
  task.view = cut.view;
  task.options = cut.options;
  task.options.hatches = of_objects(cut.options.hatches, part.objects);
  task.options.uncut = of_objects(cut.options.uncut, part.objects);
  task.box = cut.whole.drawn.box;
  task.longest_side = static_cast<double>(cut.whole.drawn.longest_side);
  if (cut.sections) task.hatches = of_objects(cut.sections->hatches, part.objects);
  task.made_for_view = cut.whole.tessellation.any;
  task.finer = finer_bodies(cut, part.objects);
  task.to_solve = part.to_solve;
  name_objects(cut, part.objects, task);
  return task;
}

/// Returns the plan of a view for the shapes of a tile.
model::ViewTessellation plan_of(const model::Scene& scene, const ViewTask& task) {
  model::ViewTessellation plan{.finer = {}, .any = task.made_for_view};
  if (task.finer.empty()) return plan;
  plan.finer.resize(scene.shapes.size());
  for (const model::GridBody& body : scene.bodies)
    if (task.finer[body.body]) plan.finer[body.grid_shape] = true;
  return plan;
}

/// Solves the lines that a view requests.
Result<hlr::Drawing> solve(const model::Scene& scene, const ViewTask& task,
                           const parallel::Context& context) {
  const hlr::WholeView whole{.box = task.box,
                             .longest_side = task.longest_side,
                             .tessellation = plan_of(scene, task),
                             .hatches = task.hatches,
                             .to_solve = task.to_solve};
  const std::vector<bool> drawn(task.to_solve.size(), true);
  Result<hlr::Drawing> drawing =
      hlr::solve_part({scene, drawn, task.view, task.options, &whole}, context);
  if (!drawing) return drawing;
  drawing->view = task.view;
  Result<hlr::Account> account = hlr::account_of(scene, task.to_solve, *drawing, context);
  if (!account) return account.error();
  drawing->account = std::move(*account);
  return drawing;
}

Result<Blob> encode_counts(const hlr::PartCounts& counts, std::span<const std::uint32_t> objects) {
  BlobWriter out;
  out.hash(hash_of(objects));
  for (const auto* const column : {&counts.pieces, &counts.curved_edges, &counts.curves})
    out.column(std::span(*column));
  return out.finish();
}

/// What was solved in a tile, of which the drawing is decoded when it is requested.
class SolvedTile {
 public:
  /// The path must outlive this. Errors: input where it is not of that tile (kLost).
  static Result<SolvedTile> open(const std::filesystem::path& file,
                                 std::span<const std::uint32_t> objects,
                                 const parallel::Context& context) {
    Result<std::vector<Blob>> blobs = read_blobs(file, 2, context);
    if (!blobs) return blobs.error();
    SolvedTile tile(std::move(*blobs), file);
    Result<BlobReader> in = BlobReader::open(tile.blobs_.front(), file.string());
    if (!in) return in.error().code == ErrorCode::input ? lost(file) : in.error();
    const bool fits = in->hash() == hash_of(objects);
    for (auto* const column :
         {&tile.counts_.pieces, &tile.counts_.curved_edges, &tile.counts_.curves})
      *column = in->column<std::uint32_t>();
    if (!fits || !in->finish()) return lost(file);
    return tile;
  }

  [[nodiscard]] const hlr::PartCounts& counts() const { return counts_; }

  [[nodiscard]] Result<hlr::Drawing> drawing(std::size_t objects,
                                             const parallel::Context& context) const {
    Result<BlobReader> in = BlobReader::open(blobs_[1], file_.string());
    if (!in) return in.error().code == ErrorCode::input ? lost(file_) : in.error();
    Result<hlr::Drawing> drawing = project::read_drawing(*in, context);
    if (!drawing) return drawing;
    if (!in->finish() || drawing->account.fates.size() != objects) return lost(file_);
    return drawing;
  }

 private:
  SolvedTile(std::vector<Blob> blobs, const std::filesystem::path& file)
      : blobs_(std::move(blobs)), file_(file) {}

  std::vector<Blob> blobs_;
  const std::filesystem::path& file_;
  hlr::PartCounts counts_;
};

/// Fills what a drawing has of the view and of all that is drawn.
void fill_head(const CutView& cut, const Diagnostics& diagnostics, hlr::Drawing& drawing) {
  drawing.view = cut.view;
  drawing.options = cut.options;
  drawing.weld_mm = cut.outline.scene.weld_mm;
  drawing.sag_mm = cut.whole.sag_mm;
  drawing.contact_distance_mm =
      cut.sections ? cut.sections->contact_distance_mm
                   : static_cast<double>(cut.whole.drawn.contact) * geometry::kMmPerGrid;
  if (cut.sections) {
    drawing.hatches = cut.sections->hatches;
    drawing.counters.uncut_objects = cut.sections->uncut_objects;
    drawing.diagnostics = cut.sections->diagnostics;
  }
  drawing.diagnostics.append(diagnostics);
  hlr::report_defects(cut.outline.model, drawing.account, drawing.diagnostics);
}

}  // namespace

Result<Keep> kept_for(const hlr::View& view) {
  const auto planes = hlr::section_planes(view.sections);
  if (!planes) return planes.error();
  Keep keep{.places = true};
  if (!planes->empty())
    keep.whole = [planes = *planes](const geometry::Box3l& box) {
      const geometry::Box3l outer = box.inflated(kRoom);
      return std::ranges::any_of(planes, [&](const hlr::SectionPlane& plane) {
        return plane.least(outer) < 0 && plane.greatest(outer) >= 0;
      });
    };
  return keep;
}

Status check_tiled_view(const hlr::Options& options) {
  if (!options.flush_seams)
    return Error{ErrorCode::usage,
                 "drawings by tiles have the flush seams: which edges these are is not known from "
                 "their neighbours alone",
                 "flush_seams", "draw on one machine, or with flush seams"};
  return {};
}

Status cut_view(CutView& cut, std::uint64_t max_bytes, const parallel::Context& context) {
  cut.outline.scene.model = &cut.outline.model;
  const model::Scene& scene = cut.outline.scene;
  if (cut.drawn.empty()) cut.drawn.assign(scene.model->objects.size(), true);
  if (!cut.view.sections.empty()) {
    auto sections = hlr::prepare_sections({scene, cut.drawn, cut.view, cut.options}, context);
    if (!sections) return sections.error();
    cut.sections = std::move(*sections);
  }
  auto whole = hlr::whole_extent(scene, cut.drawn, cut.view, cut.options, context);
  if (!whole) return whole.error();
  cut.whole = std::move(*whole);
  std::vector<std::uint32_t> bytes;
  bytes.reserve(cut.outline.extents.size());
  for (const Extent& extent : cut.outline.extents) bytes.push_back(extent.bytes);
  auto parts = hlr::split_view({cut.view, cut.options, cut.whole.drawn.box, cut.whole.boxes, bytes},
                               max_bytes, context);
  if (!parts) return parts.error();
  cut.parts = std::move(*parts);
  return {};
}

Status write_view_tiles(const CutView& cut, FileReader& reader, const std::filesystem::path& folder,
                        std::span<const std::size_t> tiles, const parallel::Context& context) {
  const auto objects_of = [&](std::size_t k) {
    return std::span<const std::uint32_t>(cut.parts[k].objects);
  };
  const auto head_of = [&](std::size_t k) -> Result<Tile> {
    Result<Blob> task = encode_task(task_of(cut, cut.parts[k]));
    if (!task) return task.error();
    Tile tile;
    tile.scene = cut.scene;
    tile.tasks.push_back(std::move(*task));
    return tile;
  };
  return write_tiles(TilesToWrite{cut.outline, reader, folder, tiles, objects_of, head_of},
                     context);
}

Status solve_tile(const std::filesystem::path& tile, const std::filesystem::path& solved,
                  const parallel::Context& context) {
  Result<Tile> read = read_tile(tile, context);
  if (!read) return read.error();
  if (read->tasks.size() != 1) return lost(tile);
  const Result<ViewTask> task = decode_task(read->tasks.front(), read->model, tile.string());
  if (!task) return lost(tile);
  for (std::size_t i = 0; i < task->named.size(); ++i)
    read->model.objects[task->named[i]].name = task->names[i];
  const Result<model::Scene> scene = model::make_scene(read->model, read->scene, context);
  if (!scene) return scene.error();
  const Result<hlr::Drawing> drawing = solve(*scene, *task, context);
  if (!drawing) return drawing.error();
  Result<Blob> counts =
      encode_counts(hlr::count_lines(*drawing, read->objects.size()), read->objects);
  if (!counts) return counts.error();
  BlobWriter out;
  project::write(out, *drawing);
  Result<Blob> lines = out.finish();
  if (!lines) return lines.error();
  return write_blobs(solved, std::array{std::move(*counts), std::move(*lines)});
}

Result<hlr::Drawing> join_solved(const CutView& cut, std::span<const std::filesystem::path> solved,
                                 const parallel::Context& context) {
  hlr::PartJoin join(cut.outline.model.objects.size());
  for (std::size_t k = 0; k < solved.size(); ++k) {
    const auto tile = SolvedTile::open(solved[k], cut.parts[k].objects, context);
    if (!tile) return tile.error();
    if (!join.expect(tile->counts(), cut.parts[k].objects)) return lost(solved[k]);
  }
  if (const Status room = join.make_room(cut.options, context); !room) return room.error();
  // All tiles say the same of the eye, and where the middle of the whole is.
  Diagnostics diagnostics;
  geometry::Vec3l origin;
  for (std::size_t k = 0; k < solved.size(); ++k) {
    const hlr::ViewPart& part = cut.parts[k];
    const auto tile = SolvedTile::open(solved[k], part.objects, context);
    if (!tile) return tile.error();
    Result<hlr::Drawing> drawing = tile->drawing(part.objects.size(), context);
    if (!drawing) return drawing.error();
    if (!join.add(*drawing, tile->counts(), part.objects, part.to_solve)) return lost(solved[k]);
    diagnostics = std::move(drawing->diagnostics);
    origin = drawing->origin;
  }
  Result<hlr::Drawing> whole = std::move(join).finish(cut.outline.scene, cut.drawn, context);
  if (!whole) return whole;
  whole->origin = origin;
  fill_head(cut, diagnostics, *whole);
  return whole;
}

}  // namespace strake::tiles
