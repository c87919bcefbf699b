// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/model.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "core/output_format.hpp"
#include "io/mesh/tessellated_shapes.hpp"
#include "io/model_writers.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/diagnostics.hpp"
#include "python/bindings/run.hpp"
#include "python/bindings/selection.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/io/importer.hpp"
#include "strake/io/reader.hpp"

namespace nb = nanobind;

namespace strake::python {

Result<std::shared_ptr<const model::Scene>> LoadedModel::scene(const model::SceneOptions& options,
                                                               const parallel::Context& context) {
  constexpr std::size_t kMaxKept = 2;
  const auto is_wanted = [&](const Kept& kept) {
    const model::SceneOptions& o = kept.options;
    return o.sag_mm == options.sag_mm && o.physical == options.physical &&
           o.obstruction == options.obstruction && o.insulation == options.insulation &&
           o.weld_mm == options.weld_mm;
  };
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = std::ranges::find_if(kept_, is_wanted); found != kept_.end()) {
      std::rotate(kept_.begin(), found, found + 1);
      return kept_.front().scene;
    }
  }
  Result<model::Scene> made = model::make_scene(model_, options, context);
  if (!made) return made.error();
  auto scene = std::make_shared<const model::Scene>(std::move(*made));
  const std::lock_guard lock(mutex_);
  kept_.insert(kept_.begin(), Kept{options, scene});
  if (kept_.size() > kMaxKept) kept_.pop_back();
  return scene;
}

namespace {

constexpr std::array<std::string_view, 3> kCategories{"physical", "obstruction", "insulation"};

/// What is not asked of a model, but of one of its objects.
const model::Object& object_at(const LoadedModel& model, std::size_t i) {
  if (i >= model.model().objects.size()) throw nb::index_error("no object has this number");
  return model.model().objects[i];
}

/// The category of an object: that of its bodies, of several the first in the list of categories.
std::string category_of(const model::Model& model, const model::Object& object) {
  auto least = static_cast<std::uint8_t>(object.body_count == 0 ? 0 : kCategories.size() - 1);
  for (std::uint32_t b = 0; b < object.body_count; ++b)
    least =
        std::min(least, static_cast<std::uint8_t>(model.bodies[object.first_body + b].category));
  return std::string(kCategories.at(least));
}

/// What it states and inherits: the nearest statement counts.
nb::dict attributes_of(const model::Model& model, const model::Object& object) {
  nb::dict all;
  const auto add = [&](const model::Attributes& some) {
    for (const auto& [name, value] : some)
      if (!all.contains(name.c_str())) all[name.c_str()] = value;
  };
  add(object.attributes);
  for (model::GroupId g = object.parent; g != model::GroupId::none;
       g = model.groups[model::index(g)].parent)
    if (const std::uint32_t a = model.groups[model::index(g)].attributes;
        a != model::Group::kNoAttributes)
      add(model.group_attributes[a]);
  return all;
}

/// id, name, path, file, category, attributes.
nb::tuple object_facts(const LoadedModel& loaded, std::size_t i) {
  const model::Object& object = object_at(loaded, i);
  const model::Model& model = loaded.model();
  return nb::make_tuple(object.id, object.name, model.path(object), model.files[object.file].label,
                        category_of(model, object), attributes_of(model, object));
}

Array<double> placements(const ModelPointer& loaded) {
  const std::vector<model::Body>& bodies = loaded->model().bodies;
  std::vector<double> rows;
  rows.reserve(bodies.size() * 12);
  for (const model::Body& body : bodies)
    for (int k = 0; k < 3; ++k) {
      const geometry::Vec3d& row = body.placement.linear.row[static_cast<std::size_t>(k)];
      for (const double x : {row.x, row.y, row.z, body.placement.translation[k]}) rows.push_back(x);
    }
  return array_of(std::move(rows), {bodies.size(), 3, 4});
}

Array<std::uint32_t> object_of_body(const ModelPointer& loaded) {
  std::vector<std::uint32_t> owner(loaded->model().bodies.size());
  std::uint32_t number = 0;
  for (const model::Object& object : loaded->model().objects) {
    std::fill_n(owner.begin() + object.first_body, object.body_count, number);
    ++number;
  }
  const std::size_t size = owner.size();
  return array_of(std::move(owner), {size});
}

constexpr model::SceneOptions kEverything{.obstruction = true, .insulation = true};

Array<double> boxes(const ModelPointer& loaded, const RunOptions& options) {
  const auto scene = run(options, "boxes", [&](const parallel::Context& context) {
    return loaded->scene(kEverything, context);
  });
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const std::size_t objects = loaded->model().objects.size();
  std::vector<double> corners(objects * 6, kNone);
  for (std::size_t o = 0; o < objects; ++o) {
    geometry::Box3l box = geometry::empty_box<std::int64_t>();
    for (const model::GridBody& body : scene->bodies_of(model::ObjectId(o)))
      box.include(body.box(scene->shapes[body.grid_shape]));
    if (box.empty()) continue;
    const geometry::Vec3d lo = geometry::to_mm(box.lo), hi = geometry::to_mm(box.hi);
    const std::array six{lo.x, lo.y, lo.z, hi.x, hi.y, hi.z};
    std::copy(six.begin(), six.end(), corners.begin() + static_cast<std::ptrdiff_t>(o * 6));
  }
  return array_of(std::move(corners), {objects, 2, 3});
}

/// All triangles of an object, in world millimetres.
std::pair<Array<double>, Array<std::uint32_t>> mesh_of(const ModelPointer& loaded, std::size_t i,
                                                       double sag_mm) {
  const model::Object& object = object_at(*loaded, i);
  io::TessellationCache shapes(loaded->model(), sag_mm);
  std::vector<double> vertices;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t b = 0; b < object.body_count; ++b) {
    const io::TessellatedShape shape = shapes.place(loaded->model().bodies[object.first_body + b]);
    if (shape.mesh == nullptr) continue;
    const auto base = static_cast<std::uint32_t>(vertices.size() / 3);
    for (const geometry::Vec3d& local : shape.mesh->vertices) {
      const geometry::Vec3d v = shape.placement * local;
      vertices.insert(vertices.end(), {v.x, v.y, v.z});
    }
    // A mirrored body keeps its outward side.
    const bool mirrored = shape.placement.linear.determinant() < 0;
    for (const geometry::Triangle& t : shape.mesh->triangles)
      triangles.insert(triangles.end(), {base + t[0], base + (mirrored ? t[2] : t[1]),
                                         base + (mirrored ? t[1] : t[2])});
  }
  const std::size_t corners = vertices.size() / 3, faces = triangles.size() / 3;
  return {array_of(std::move(vertices), {corners, 3}), array_of(std::move(triangles), {faces, 3})};
}

Array<bool> select(const ModelPointer& loaded, const std::vector<std::string>& selections,
                   const RunOptions& options) {
  const Picked picked = run(options, "select", [&](const parallel::Context& context) {
    const auto scene = loaded->scene({}, context);
    return scene ? pick({selections, {}}, **scene, context) : Result<Picked>(scene.error());
  });
  return array_of_bits(picked.objects);
}

ModelPointer load(const std::vector<std::filesystem::path>& paths, std::optional<double> unit_mm,
                  std::optional<int> up_axis, bool on_map, const std::filesystem::path& importers,
                  const RunOptions& options) {
  io::ReadOptions how{.unit_mm = unit_mm, .up_axis = {}, .encoding = {}, .on_map = on_map};
  if (up_axis) how.up_axis = static_cast<io::UpAxis>(*up_axis);
  std::vector<io::FileToRead> files;
  for (const std::filesystem::path& path : paths) files.push_back({path, how});
  return std::make_shared<LoadedModel>(
      run(options, "read", [&](const parallel::Context& context) -> Result<model::Model> {
        Result<io::ImportSettings> settings = io::import_settings_of_environment();
        if (!settings) return io::read_models(files, context);  // tells of the fault as needed
        settings->folders.insert(settings->folders.begin(), importers);
        return io::read_models(files, *settings, context);
      }));
}

void save(const ModelPointer& loaded, const std::filesystem::path& path,
          const RunOptions& options) {
  const auto writer = value_or_raise(find_writer(io::model_writers(), path.string()));
  run_status(options, "write", [&](const parallel::Context& context) {
    return writer.write(loaded->model(), path, {}, context);
  });
}

nb::list files_of(const LoadedModel& loaded) {
  nb::list files;
  for (const model::SourceFile& file : loaded.model().files)
    files.append(nb::make_tuple(file.label, file.format, file.unit, file.up_axis, file.bytes));
  return files;
}

nb::list column(const LoadedModel& loaded, std::string model::Object::* member) {
  nb::list values;
  for (const model::Object& object : loaded.model().objects)
    values.append(nb::cast(object.*member));
  return values;
}

}  // namespace

void bind_model(nb::module_& module) {
  nb::class_<RunOptions>(module, "RunOptions")
      .def(
          "__init__",
          [](RunOptions* self, std::optional<unsigned> threads, nb::object progress) {
            new (self) RunOptions{threads, std::move(progress)};
          },
          nb::arg("threads").none(), nb::arg("progress").none());
  nb::class_<LoadedModel>(module, "Model")
      .def("__len__", [](const LoadedModel& m) { return m.model().objects.size(); })
      .def_prop_ro("bodies", [](const LoadedModel& m) { return m.model().bodies.size(); })
      .def_prop_ro("files", &files_of)
      .def_prop_ro("ids", [](const LoadedModel& m) { return column(m, &model::Object::id); })
      .def_prop_ro("names", [](const LoadedModel& m) { return column(m, &model::Object::name); })
      .def_prop_ro("diagnostics",
                   [](const LoadedModel& m) { return listed(m.model().diagnostics); })
      .def("object", &object_facts, nb::arg("i"));
  module.def("load", &load, nb::arg("paths"), nb::arg("unit_mm").none(), nb::arg("up_axis").none(),
             nb::arg("on_map"), nb::arg("importers"), nb::arg("options"));
  module.def("save", &save, nb::arg("model"), nb::arg("path"), nb::arg("options"));
  module.def("placements", &placements, nb::arg("model"));
  module.def("object_of_body", &object_of_body, nb::arg("model"));
  module.def("boxes", &boxes, nb::arg("model"), nb::arg("options"));
  module.def("mesh", &mesh_of, nb::arg("model"), nb::arg("i"), nb::arg("sag_mm"));
  module.def("select", &select, nb::arg("model"), nb::arg("selections"), nb::arg("options"));
}

}  // namespace strake::python
