// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "core/number.hpp"
#include "pictures/whole/class_colours.hpp"
#include "pictures/whole_run.hpp"
#include "strake/io/writer.hpp"

namespace strake::pictures {
namespace {

using model::GroupId;
using model::ObjectId;
using model::ShapeId;

/// Half of a marker's height: so much that it is found, and that it hides little.
constexpr double kMarkerMm = 60;

geometry::TriangleMesh octahedron() {
  geometry::TriangleMesh mesh;
  const double k = kMarkerMm;
  mesh.vertices = {{k, 0, 0}, {-k, 0, 0}, {0, k, 0}, {0, -k, 0}, {0, 0, k}, {0, 0, -k}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  mesh.sag_mm = 0;
  return mesh;
}

/// Builds the model of markers and of the objects that they are about.
class MarkerModel {
 public:
  explicit MarkerModel(const report::ClashContents& contents) : contents_(contents) {
    made_.files.emplace_back().label = "markers";
    made_.shapes.emplace_back(octahedron());
  }

  model::Model build() && {
    add_markers();
    add_objects();
    return std::move(made_);
  }

 private:
  static model::Color solid(const Colour& c) { return {c.red, c.green, c.blue}; }

  GroupId group(std::string name) {
    made_.groups.push_back({std::move(name)});
    return GroupId{static_cast<std::uint32_t>(made_.groups.size() - 1)};
  }

  void add_markers() {
    std::map<clash::Class, GroupId> of_class;
    for (const clash::Class cls :
         {clash::Class::hit, clash::Class::clearance_violation, clash::Class::contact})
      of_class[cls] = group(std::string(clash::name(cls)));
    for (const clash::Report& test : contents_.findings.tests)
      for (const clash::Pair& pair : test.pairs)
        if (pair.allowed < 0) add_marker(test, pair, of_class[pair.cls]);
  }

  void add_marker(const clash::Report& test, const clash::Pair& pair, GroupId parent) {
    const model::Model& model = contents_.model;
    const std::string key = clash::pair_key(test.name, model, pair.a, pair.b);
    model::Object marker;
    marker.id = key;
    marker.name = key;
    marker.parent = parent;
    marker.attributes = {{"key", key},
                         {"class", std::string(clash::name(pair.cls))},
                         {"d_mm", fixed(pair.d_mm, 3)},
                         {"test", test.name},
                         {"a", model.object(pair.a).id},
                         {"b", model.object(pair.b).id}};
    begin(std::move(marker));
    model::Body body;
    body.shape = ShapeId{0};
    body.placement.translation = pair.point_mm;
    body.color = solid(colour_of_class(pair.cls));
    add(body);
  }

  void add_objects() {
    const std::vector<clash::Class> worst = worst_classes(contents_);
    const GroupId parent = group("objects");
    const model::Model& model = contents_.model;
    for (std::uint32_t o = 0; o < worst.size(); ++o) {
      if (worst[o] == clash::Class::no_hit) continue;
      const model::Object& given = model.objects[o];
      model::Object object;
      object.id =
          model.files.size() > 1 ? model.files[given.file].label + ":" + given.id : given.id;
      object.name = given.name;
      object.parent = parent;
      object.attributes = {{"class", std::string(clash::name(worst[o]))}};
      begin(std::move(object));
      for (std::uint32_t b = 0; b < given.body_count; ++b) {
        model::Body body = model.bodies[given.first_body + b];
        if (body.category != model::Category::physical) continue;
        body.shape = shape(body.shape);
        body.color = light(colour_of_class(worst[o]));
        add(body);
      }
    }
  }

  /// A tone of a class for objects, which markers stand out of.
  static model::Color light(const Colour& c) {
    const auto mix = [](std::uint8_t channel) {
      constexpr unsigned kWhite = 255;
      return static_cast<std::uint8_t>((channel + kWhite) / 2);
    };
    return {mix(c.red), mix(c.green), mix(c.blue)};
  }

  void begin(model::Object object) {
    object.first_body = static_cast<std::uint32_t>(made_.bodies.size());
    made_.objects.push_back(std::move(object));
  }

  void add(const model::Body& body) {
    ++made_.objects.back().body_count;
    made_.bodies.push_back(body);
  }

  ShapeId shape(ShapeId given) {
    const auto next = ShapeId{static_cast<std::uint32_t>(made_.shapes.size())};
    const auto [at, added] = shapes_.emplace(given, next);
    if (added) made_.shapes.push_back(contents_.model.shapes[index(given)]);
    return at->second;
  }

  const report::ClashContents& contents_;
  model::Model made_;
  std::map<ShapeId, ShapeId> shapes_;
};

}  // namespace

Status write_markers(const report::ClashContents& contents, report::Sink sink,
                     const parallel::Context& context) {
  return io::put_glb(MarkerModel(contents).build(), sink, {}, context);
}

}  // namespace strake::pictures
