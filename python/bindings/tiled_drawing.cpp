// SPDX-License-Identifier: Apache-2.0
#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "python/bindings/bindings.hpp"
#include "python/bindings/draw_request.hpp"
#include "python/bindings/model.hpp"
#include "python/bindings/run.hpp"
#include "python/bindings/selection.hpp"
#include "python/bindings/tiles.hpp"
#include "tiles/tiled_view.hpp"

namespace nb = nanobind;

namespace strake::python {

namespace {

using Path = std::filesystem::path;

/// A drawing of files that are cut into tiles.
struct CutDrawing {
  DrawRequest request;
  DrawJob job;
  tiles::CutView cut;
  tiles::FileReader reader;
  Diagnostics diagnostics;
};

/// What selections pick, by selection.
using PickedByEach = std::vector<std::vector<bool>>;

/// What a request picks, file by file.
struct Picks {
  PickedByEach drawn, uncut;
};

Status cut_files(CutDrawing& made, std::uint64_t max_bytes, const parallel::Context& context) {
  const DrawRequest& request = made.request;
  const Result<tiles::Keep> keep = tiles::kept_for(made.job.view);
  if (!keep) return keep.error();
  made.cut.scene = scene_options(request);
  std::vector<Picks> picks(made.reader.files().size());
  const Pick uncut{request.uncut, {}};
  Result<tiles::Outline> outline = tiles::outline_of(
      made.reader, made.cut.scene, *keep,
      [&](const model::Scene& scene, std::size_t given) -> Status {
        Result<PickedByEach> drawn_here = picked_by_each(request.select, scene, context);
        if (!drawn_here) return drawn_here.error();
        Result<PickedByEach> uncut_here = picked_by_each(uncut, scene, context);
        if (!uncut_here) return uncut_here.error();
        picks[given] = {std::move(*drawn_here), std::move(*uncut_here)};
        return {};
      },
      context);
  if (!outline) return outline.error();
  made.cut.outline = std::move(*outline);
  made.cut.outline.scene.model = &made.cut.outline.model;
  if (made.cut.outline.renamed && !(request.select.is_everything() && uncut.is_everything()))
    return same_names();
  Picks all;
  for (const tiles::Outline::File& file : made.cut.outline.files) {
    append_picked(picks[file.given].drawn, all.drawn);
    append_picked(picks[file.given].uncut, all.uncut);
  }
  const model::Model& model = made.cut.outline.model;
  Result<std::vector<bool>> drawn = pick_some(request.select, all.drawn, model, "select");
  if (!drawn) return drawn.error();
  Result<std::vector<bool>> left = pick_some(uncut, all.uncut, model, "uncut");
  if (!left) return left.error();
  if (const Status status = fit_job(request, made.cut.outline.scene, std::move(*drawn),
                                    std::move(*left), made.job, made.diagnostics, context);
      !status)
    return status;
  made.cut.view = made.job.view;
  made.cut.options = made.job.options;
  made.cut.drawn = made.job.drawn;
  return tiles::cut_view(made.cut, max_bytes, context);
}

/// Errors: usage, for what is looked up in the model when lines are on paper, or changes the model.
Status check_request(const DrawRequest& request, const DrawJob& job) {
  const auto refused = [](const char* argument) {
    return Error{ErrorCode::usage, "this is not drawn by tiles", argument,
                 "draw on one machine, or leave it out"};
  };
  if (job.conventions.centre_lines) return refused("centre_lines");
  if (!request.hatches.empty()) return refused("hatch");
  if (!request.styles.empty()) return refused("style");
  if (job.single_line) return refused("single_line");
  return {};
}

std::shared_ptr<CutDrawing> cut(const std::vector<Path>& paths, std::optional<double> unit_mm,
                                std::optional<int> up_axis, bool on_map, const Path& importers,
                                const DrawRequest& request, std::uint64_t max_bytes,
                                const Path& folder, const RunOptions& options) {
  Result<DrawJob> job = job_of(request);
  if (!job) raise(job.error());
  check(check_request(request, *job));
  check(tiles::check_tiled_view(job->options));
  const auto made = std::make_shared<CutDrawing>(
      CutDrawing{request,
                 std::move(*job),
                 {},
                 reader_of(paths, unit_mm, up_axis, on_map, importers, folder),
                 {}});
  run_status(options, "cut", [&](const parallel::Context& context) {
    return cut_files(*made, max_bytes, context);
  });
  return made;
}

void write(const std::shared_ptr<CutDrawing>& made, const Path& folder,
           const std::vector<std::size_t>& numbers, const RunOptions& options) {
  for (const std::size_t k : numbers)
    if (k >= made->cut.parts.size()) throw nb::index_error("no tile has this number");
  run_status(options, "write tiles", [&](const parallel::Context& context) {
    const Status written =
        tiles::write_view_tiles(made->cut, made->reader, folder, numbers, context);
    made->reader.forget();
    return written;
  });
}

void solve(const Path& tile, const Path& solved, const RunOptions& options) {
  run_status(options, "hidden lines", [&](const parallel::Context& context) {
    return tiles::solve_tile(tile, solved, context);
  });
}

/// Returns a model that has names alone.
model::Model names_of(model::Model model) {
  model.bodies = {};
  model.shapes = {};
  for (model::Object& object : model.objects) object.first_body = object.body_count = 0;
  return model;
}

/// The cut is used up.
std::shared_ptr<DrawRun> join(const std::shared_ptr<CutDrawing>& made,
                              const std::vector<Path>& solved, const RunOptions& options) {
  if (solved.size() != made->cut.parts.size())
    throw nb::index_error("not as many results as there are tiles");
  return run(
      options, "join", [&](const parallel::Context& context) -> Result<std::shared_ptr<DrawRun>> {
        const Result<hlr::Drawing> lines = tiles::join_solved(made->cut, solved, context);
        if (!lines) return lines.error();
        const auto run = std::make_shared<DrawRun>();
        run->diagnostics = std::move(made->diagnostics);
        made->cut.outline.scene = {};
        run->model = std::make_shared<LoadedModel>(names_of(std::move(made->cut.outline.model)));
        const Status put =
            put_on_paper(made->request, made->job, *lines, run->model->model(), *run, context);
        if (!put) return put.error();
        return run;
      });
}

std::vector<std::pair<std::size_t, std::uint64_t>> sizes(const CutDrawing& made) {
  std::vector<std::pair<std::size_t, std::uint64_t>> sizes;
  for (const hlr::ViewPart& part : made.cut.parts)
    sizes.emplace_back(part.objects.size(), part.bytes);
  return sizes;
}

}  // namespace

void bind_tiled_drawing(nb::module_& module) {
  nb::class_<CutDrawing>(module, "CutDrawing")
      .def_prop_ro("sizes", &sizes)
      .def_prop_ro("objects",
                   [](const CutDrawing& made) { return made.cut.outline.extents.size(); });
  module.def("cut_drawing", &cut, nb::arg("paths"), nb::arg("unit_mm").none(),
             nb::arg("up_axis").none(), nb::arg("on_map"), nb::arg("importers"), nb::arg("request"),
             nb::arg("max_bytes"), nb::arg("folder"), nb::arg("options"));
  module.def("write_drawing_tiles", &write, nb::arg("cut"), nb::arg("folder"), nb::arg("tiles"),
             nb::arg("options"));
  module.def("draw_in_tile", &solve, nb::arg("tile"), nb::arg("found"), nb::arg("options"));
  module.def("join_drawing_tiles", &join, nb::arg("cut"), nb::arg("found"), nb::arg("options"));
}

}  // namespace strake::python
