// SPDX-License-Identifier: Apache-2.0
#include "tiles/outline.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "clash/rules/options.hpp"
#include "io/importer/importing_reader.hpp"
#include "project/model/stored_diagnostics.hpp"

namespace strake::tiles {
namespace {

/// What a worker holds of a part, with the pairs that it makes, and of a triangle of a shape: on
/// ships of a million objects 600 bytes a part were measured.
constexpr double kBytesOfPart = 800, kBytesOfTriangle = 160;

/// Returns of each shape of a scene what one body of it takes, which shares it with the others.
std::vector<double> bytes_by_shape(const model::Scene& scene) {
  std::vector<double> bytes(scene.shapes.size(), 0);
  std::vector<std::uint32_t> uses(scene.shapes.size(), 0);
  for (const model::GridBody& body : scene.bodies) ++uses[body.grid_shape];
  for (std::size_t s = 0; s < bytes.size(); ++s) {
    std::size_t triangles = 0;
    for (const geometry::Part& part : scene.shapes[s].parts) triangles += part.triangles.size();
    bytes[s] = kBytesOfPart * static_cast<double>(scene.shapes[s].parts.size()) +
               kBytesOfTriangle * static_cast<double>(triangles) / std::max(uses[s], 1U);
  }
  return bytes;
}

/// Returns how far the true surface of a shape may stand out of its box.
std::int64_t sag_of(const model::GridShape& shape) {
  double largest = 0;
  for (const geometry::Part& part : shape.parts) largest = std::max(largest, part.sag);
  return static_cast<std::int64_t>(std::ceil(largest));
}

void append_extents(const model::Scene& scene, std::vector<Extent>& extents) {
  const std::vector<double> bytes = bytes_by_shape(scene);
  std::vector<std::int64_t> sags(scene.shapes.size());
  for (std::size_t s = 0; s < sags.size(); ++s) sags[s] = sag_of(scene.shapes[s]);
  for (std::uint32_t o = 0; o < scene.model->objects.size(); ++o) {
    Extent& extent = extents.emplace_back();
    double sum = 0;
    for (const model::GridBody& body : scene.bodies_of(model::ObjectId{o})) {
      const model::GridShape& shape = scene.shapes[body.grid_shape];
      if (shape.box.empty()) continue;
      const float precision = scene.model->bodies[body.body].precision_um;
      const auto step =
          static_cast<std::int64_t>(std::ceil(clash::coarse_step(clash::Options{}, precision)));
      extent.box.include(body.box(shape).inflated(sags[body.grid_shape] + step));
      sum += bytes[body.grid_shape];
    }
    extent.bytes = static_cast<std::uint32_t>(std::min(sum, 4e9));
  }
}

/// A file of which the geometry is gone.
struct Remains {
  model::Model model;
  std::vector<Extent> extents;
  model::Scene placed;  ///< with Keep::places
  std::vector<model::IncompleteObject> lacking;
  Diagnostics reading, scene;
  std::string label;
  std::uint64_t bytes = 0;
  std::size_t objects = 0, bodies = 0;
  Hash128 names;
  std::optional<io::MapPlace> map;
};

/// Returns files, groups and objects of a model.
model::Model names_of(const model::Model& model) {
  model::Model names;
  names.files = model.files;
  names.groups = model.groups;
  names.group_attributes = model.group_attributes;
  names.objects = model.objects;
  return names;
}

model::Model without_geometry(const model::Model& model) {
  model::Model rest = names_of(model);
  for (model::Object& object : rest.objects) object.first_body = object.body_count = 0;
  return rest;
}

/// Returns a model whose meshes and lines have nothing in them.
model::Model without_meshes(const model::Model& model) {
  model::Model rest = names_of(model);
  rest.bodies = model.bodies;
  rest.shapes.reserve(model.shapes.size());
  for (const model::Shape& shape : model.shapes) {
    if (std::holds_alternative<geometry::Primitive>(shape))
      rest.shapes.push_back(shape);
    else if (std::holds_alternative<geometry::Polylines>(shape))
      rest.shapes.emplace_back(geometry::Polylines{});
    else
      rest.shapes.emplace_back(geometry::TriangleMesh{});
  }
  return rest;
}

/// Takes all but the corners out of the shapes of a scene that need not stay whole.
model::Scene without_triangles(model::Scene scene, const Keep& keep) {
  std::vector<bool> whole(scene.shapes.size());
  for (const model::GridBody& body : scene.bodies) {
    const model::GridShape& shape = scene.shapes[body.grid_shape];
    if (keep.whole && !whole[body.grid_shape] && !shape.box.empty())
      whole[body.grid_shape] = keep.whole(body.box(shape));
  }
  for (std::size_t s = 0; s < whole.size(); ++s) {
    if (whole[s]) continue;
    for (geometry::Part& part : scene.shapes[s].parts) {
      geometry::Part rest;
      rest.vertices = std::move(part.vertices);
      rest.primitive = std::move(part.primitive);
      rest.sag = part.sag;
      part = std::move(rest);
    }
  }
  scene.diagnostics = {};
  scene.lacking = {};
  return scene;
}

/// Appends what was said of a file that has another label now.
void append_renamed(const Diagnostics& diagnostics, std::string_view was, std::string_view now,
                    Diagnostics& all) {
  Diagnostics renamed;
  for (Diagnostic one : diagnostics.kept()) {
    if (was != now && one.where.starts_with(was)) one.where.replace(0, was.size(), now);
    renamed.add(std::move(one));
  }
  for (const Diagnostics::Count& count : diagnostics.counts())
    if (count.count > Diagnostics::kMaxPerCode)
      renamed.count_more(count.code, count.count - Diagnostics::kMaxPerCode);
  all.append(renamed);
}

/// Puts files together as if they had been read at once.
class Gathering {
 public:
  Gathering(std::vector<Remains> remains, const std::vector<io::FileToRead>& files)
      : remains_(std::move(remains)), given_(files) {}

  Outline run() {
    number_shapes();
    join_names();
    join_objects();
    join_scenes();
    join_diagnostics();
    return std::move(all_);
  }

 private:
  /// Models are put behind each other as they were given, and only then in order.
  void number_shapes() {
    std::uint32_t before = 0;
    for (const Remains& file : remains_) {
      shapes_before_.push_back(before);
      before += static_cast<std::uint32_t>(file.model.shapes.size());
    }
  }

  void join_names() {
    if (remains_.size() == 1) {
      all_.model = std::move(remains_.front().model);
      order_ = {0};
      return;
    }
    std::vector<model::Model> models;
    for (std::size_t f = 0; f < remains_.size(); ++f) {
      // Files are put in order: until they are, each carries its number.
      remains_[f].model.files.front().bytes = f;
      models.push_back(std::move(remains_[f].model));
    }
    all_.model = model::join(models);
    for (model::SourceFile& file : all_.model.files) {
      order_.push_back(static_cast<std::uint32_t>(file.bytes));
      file.bytes = remains_[order_.back()].bytes;
    }
  }

  void join_objects() {
    for (const std::uint32_t f : order_) {
      Remains& file = remains_[f];
      const auto first = static_cast<std::uint32_t>(all_.extents.size());
      all_.files.push_back({f, first, static_cast<std::uint32_t>(file.extents.size()), file.names});
      for (model::IncompleteObject lacking : file.lacking) {
        lacking.object = model::ObjectId{index(lacking.object) + first};
        all_.lacking.push_back(lacking);
      }
      all_.extents.insert(all_.extents.end(), file.extents.begin(), file.extents.end());
      file.extents = {};
    }
  }

  /// Puts scenes together; the bodies of a model stand in the order of its objects.
  void join_scenes() {
    model::Scene& all = all_.scene;
    std::uint32_t objects = 0, bodies = 0;
    for (const std::uint32_t f : order_) {
      model::Scene& scene = remains_[f].placed;
      const auto shapes = static_cast<std::uint32_t>(all.shapes.size());
      const auto placed = static_cast<std::uint32_t>(all.bodies.size());
      for (model::GridShape& shape : scene.shapes) {
        shape.shape = model::ShapeId{index(shape.shape) + shapes_before_[f]};
        all.shapes.push_back(std::move(shape));
      }
      for (model::GridBody body : scene.bodies) {
        body.grid_shape += shapes;
        body.body += bodies;
        body.object = model::ObjectId{index(body.object) + objects};
        all.bodies.push_back(body);
      }
      for (std::size_t o = 0; o + 1 < scene.first_body.size(); ++o)
        all.first_body.push_back(scene.first_body[o] + placed);
      objects += static_cast<std::uint32_t>(remains_[f].objects);
      bodies += static_cast<std::uint32_t>(remains_[f].bodies);
      all.sag_mm = scene.sag_mm;
      all.weld_mm = scene.weld_mm;
      all.left_out += scene.left_out;
      scene = {};
    }
    all.first_body.push_back(static_cast<std::uint32_t>(all.bodies.size()));
    all.lacking = all_.lacking;
  }

  void join_diagnostics() {
    std::vector<project::FileDiagnostics> diagnostics;
    for (std::size_t f = 0; f < order_.size(); ++f) {
      const Remains& file = remains_[order_[f]];
      all_.renamed = all_.renamed || file.label != all_.model.files[f].label;
      diagnostics.push_back(
          {file.reading, file.label, all_.model.files[f].label, given_[order_[f]].path.string()});
    }
    const Diagnostics of_places = place_diagnostics();
    all_.model.diagnostics = diagnostics.size() == 1 && of_places.counts().empty()
                                 ? diagnostics.front().diagnostics
                                 : project::joined_diagnostics(diagnostics, of_places);
    all_.loading = all_.model.diagnostics;
    for (std::size_t f = 0; f < order_.size(); ++f)
      append_renamed(remains_[order_[f]].scene, remains_[order_[f]].label,
                     all_.model.files[f].label, all_.loading);
  }

  [[nodiscard]] Diagnostics place_diagnostics() const {
    std::vector<io::FilePlace> places;
    bool on_map = false;
    for (std::size_t f = 0; f < remains_.size(); ++f) {
      places.push_back({given_[f].path.string(), remains_[f].map});
      on_map = on_map || given_[f].options.on_map;
    }
    std::ranges::sort(places, {}, &io::FilePlace::file);
    return io::place_diagnostics(places, on_map);
  }

  std::vector<Remains> remains_;
  const std::vector<io::FileToRead>& given_;
  std::vector<std::uint32_t> shapes_before_;  ///< by file, as given
  std::vector<std::uint32_t> order_;          ///< which file is which of the model
  Outline all_;
};

}  // namespace

Hash128 hash_of_ids(const model::Model& model) {
  WordHash hash;
  hash.add(std::uint64_t{model.objects.size()});
  for (const model::Object& object : model.objects) hash.add(std::string_view(object.id));
  return hash.value();
}

Result<Outline> outline_of(FileReader& reader, const model::SceneOptions& options, const Keep& keep,
                           VisitScene visit_scene, const parallel::Context& context) {
  std::vector<Remains> remains;
  bool keeps_scenes = true;
  for (std::size_t f = 0; f < reader.files().size(); ++f) {
    const Result<const model::Model*> read = reader.read(f, context);
    if (!read) return read.error();
    const model::Model& model = **read;
    Result<model::Scene> scene = model::make_scene(model, options, context);
    if (!scene) return scene.error();
    if (const Status s = visit_scene(*scene, f); !s) return s.error();
    Remains& file = remains.emplace_back();
    append_extents(*scene, file.extents);
    file.lacking = std::move(scene->lacking);
    file.scene = std::move(scene->diagnostics);
    file.reading = model.diagnostics;
    // That is of the run and not of a file, and said once.
    if (file.reading.count(io::kSceneNotKept) > 0 && !std::exchange(keeps_scenes, false))
      file.reading.remove(io::kSceneNotKept);
    file.map = reader.map();
    file.label = model.files.front().label;
    file.bytes = model.files.front().bytes;
    // The model of an only file is kept until it is cut.
    if (reader.files().size() > 1) file.names = hash_of_ids(model);
    file.objects = model.objects.size();
    file.bodies = model.bodies.size();
    file.model = keep.places ? without_meshes(model) : without_geometry(model);
    if (keep.places) file.placed = without_triangles(std::move(*scene), keep);
    *scene = {};  // it is no longer needed, and keeping a file takes memory
    if (const Status s = reader.keep(f, context); !s) return s.error();
  }
  return Gathering(std::move(remains), reader.files()).run();
}

}  // namespace strake::tiles
