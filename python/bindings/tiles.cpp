// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/tiles.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "python/bindings/bindings.hpp"
#include "python/bindings/clash.hpp"
#include "python/bindings/clash_plan.hpp"
#include "python/bindings/model.hpp"
#include "python/bindings/run.hpp"
#include "strake/io/importer.hpp"
#include "tiles/tiled_clash.hpp"

namespace nb = nanobind;

namespace strake::python {

namespace {

using Path = std::filesystem::path;

/// A clash run over files that are cut into tiles.
struct Cut {
  ClashRequest request;
  tiles::CutRun run;
  std::optional<tiles::FileReader> reader;
};

/// The scene of an outline: its objects have no bodies.
model::Scene scene_without_bodies(const model::Model& model) {
  model::Scene scene;
  scene.model = &model;
  scene.first_body.assign(model.objects.size() + 1, 0);
  return scene;
}

/// Returns the facts of all objects, in their order.
RequestFacts in_order(const tiles::Outline& outline, const std::vector<RequestFacts>& by_given) {
  RequestFacts all;
  for (const tiles::Outline::File& file : outline.files) all.append(by_given[file.given]);
  return all;
}

Status cut_files(Cut& made, std::uint64_t max_bytes, const parallel::Context& context) {
  const Result<ClashPlanner> planner = ClashPlanner::of(made.request);
  if (!planner) return planner.error();
  tiles::CutRun& run = made.run;
  run.scene = planner->scene_options();
  std::vector<RequestFacts> facts(made.reader->files().size());
  Result<tiles::Outline> outline = tiles::outline_of(
      *made.reader, run.scene, {},
      [&](const model::Scene& scene, std::size_t given) -> Status {
        Result<RequestFacts> of_file = planner->facts(scene, context);
        if (!of_file) return of_file.error();
        facts[given] = std::move(*of_file);
        return {};
      },
      context);
  if (!outline) return outline.error();
  run.outline = std::move(*outline);
  RequestFacts all = in_order(run.outline, facts);
  if (run.outline.renamed && planner->selects(all)) return same_names();
  const model::Scene scene = scene_without_bodies(run.outline.model);
  Result<rules::Plan> plan = planner->plan(scene, std::move(all), context);
  if (!plan) return plan.error();
  run.plan = std::move(*plan);
  tiles::cut(run, max_bytes);
  return {};
}

std::shared_ptr<Cut> cut(const std::vector<Path>& paths, std::optional<double> unit_mm,
                         std::optional<int> up_axis, bool on_map, const Path& importers,
                         const ClashRequest& request, std::uint64_t max_bytes, const Path& folder,
                         const RunOptions& options) {
  const auto made = std::make_shared<Cut>();
  made->request = request;
  made->reader.emplace(reader_of(paths, unit_mm, up_axis, on_map, importers, folder));
  run_status(options, "cut", [&](const parallel::Context& context) {
    return cut_files(*made, max_bytes, context);
  });
  return made;
}

void write(const std::shared_ptr<Cut>& cut, const Path& folder,
           const std::vector<std::size_t>& numbers, const RunOptions& options) {
  for (const std::size_t k : numbers)
    if (k >= cut->run.cells.size()) throw nb::index_error("no tile has this number");
  run_status(options, "write tiles", [&](const parallel::Context& context) {
    const Status written = tiles::write_tiles(cut->run, *cut->reader, folder, numbers, context);
    cut->reader->forget();
    return written;
  });
}

void find_in_tile(const Path& tile, const Path& found, const RunOptions& options) {
  run_status(options, "find clashes", [&](const parallel::Context& context) {
    return tiles::find_in_tile(tile, found, context);
  });
}

/// The cut is used up.
std::shared_ptr<ClashRun> join(const std::shared_ptr<Cut>& cut, const std::vector<Path>& found,
                               const RunOptions& options) {
  if (found.size() != cut->run.cells.size())
    throw nb::index_error("not as many results as there are tiles");
  return run(options, "join",
             [&](const parallel::Context& context) -> Result<std::shared_ptr<ClashRun>> {
               const Result<ClashPlanner> planner = ClashPlanner::of(cut->request);
               if (!planner) return planner.error();
               Result<clash::Findings> findings = tiles::join_found(cut->run, found, context);
               if (!findings) return findings.error();
               tiles::Outline& outline = cut->run.outline;
               const auto model = std::make_shared<LoadedModel>(std::move(outline.model));
               return run_of(model, cut->request, *planner, std::move(*findings),
                             std::move(outline.loading));
             });
}

std::vector<std::pair<std::size_t, std::uint64_t>> sizes(const Cut& cut) {
  std::vector<std::pair<std::size_t, std::uint64_t>> sizes;
  for (const tiles::CutCell& cell : cut.run.cells)
    sizes.emplace_back(cell.objects.size(), cell.bytes);
  return sizes;
}

}  // namespace

tiles::FileReader reader_of(const std::vector<Path>& paths, std::optional<double> unit_mm,
                            std::optional<int> up_axis, bool on_map, const Path& importers,
                            const Path& folder) {
  io::ReadOptions how{.unit_mm = unit_mm, .up_axis = {}, .encoding = {}, .on_map = on_map};
  if (up_axis) how.up_axis = static_cast<io::UpAxis>(*up_axis);
  std::vector<io::FileToRead> files;
  for (const Path& path : paths) files.push_back({path, how});
  Result<io::ImportSettings> settings = io::import_settings_of_environment();
  if (settings) settings->folders.insert(settings->folders.begin(), importers);
  return {std::move(files), std::move(settings), folder};
}

Error same_names() {
  return {ErrorCode::usage, "two of the files have one name, and objects are picked by selections",
          "files", "give the files different names: a selection may ask for them"};
}

void bind_tiles(nb::module_& module) {
  nb::class_<Cut>(module, "Cut")
      .def_prop_ro("sizes", &sizes)
      .def_prop_ro("objects", [](const Cut& cut) { return cut.run.outline.extents.size(); });
  module.def("cut", &cut, nb::arg("paths"), nb::arg("unit_mm").none(), nb::arg("up_axis").none(),
             nb::arg("on_map"), nb::arg("importers"), nb::arg("request"), nb::arg("max_bytes"),
             nb::arg("folder"), nb::arg("options"));
  module.def("tile_file", &tiles::tile_file, nb::arg("folder"), nb::arg("tile"));
  module.def("write_tiles", &write, nb::arg("cut"), nb::arg("folder"), nb::arg("tiles"),
             nb::arg("options"));
  module.def("find_in_tile", &find_in_tile, nb::arg("tile"), nb::arg("found"), nb::arg("options"));
  module.def("join_tiles", &join, nb::arg("cut"), nb::arg("found"), nb::arg("options"));
}

}  // namespace strake::python
