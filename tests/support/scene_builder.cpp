// SPDX-License-Identifier: Apache-2.0
#include "support/scene_builder.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace strake::test {

using geometry::Part;
using geometry::Vec3i;
using geometry::Vec3l;

namespace {

void add_edges(Part& part) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = part.triangles[t][k], b = part.triangles[t][(k + 1) % 3];
      edges[{std::min(a, b), std::max(a, b)}].push_back(t);
      balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  std::vector<geometry::PartEdge> part_edges;
  std::vector<std::uint32_t> edge_triangles;
  for (auto& [ends, triangles] : edges) {
    std::sort(triangles.begin(), triangles.end());
    part_edges.push_back(
        {ends.first, ends.second, static_cast<std::uint32_t>(edge_triangles.size())});
    edge_triangles.insert(edge_triangles.end(), triangles.begin(), triangles.end());
    if (triangles.size() == 1) part.flags.open = true;
    if (triangles.size() != 2) part.flags.non_manifold = true;
    if (balance[ends] != 0) part.kind = geometry::PartKind::sheet;
  }
  part_edges.push_back({0, 0, static_cast<std::uint32_t>(edge_triangles.size())});
  part.edges = std::move(part_edges);
  part.edge_triangles = std::move(edge_triangles);
}

void add_shells(Part& part) {
  std::vector<std::uint32_t> shells(part.triangles.size(), geometry::kNoIndex);
  for (std::uint32_t seed = 0; seed < part.triangles.size(); ++seed) {
    if (shells[seed] != geometry::kNoIndex) continue;
    shells[seed] = part.shell_count;
    for (bool grown = true; grown;) {
      grown = false;
      for (std::size_t e = 0; e + 1 < part.edges.size(); ++e) {
        const std::uint32_t first = part.edges[e].first_triangle;
        const std::uint32_t last = part.edges[e + 1].first_triangle;
        bool in = false;
        for (std::uint32_t i = first; i < last; ++i)
          in = in || shells[part.edge_triangles[i]] == part.shell_count;
        for (std::uint32_t i = first; in && i < last; ++i)
          if (shells[part.edge_triangles[i]] == geometry::kNoIndex) {
            shells[part.edge_triangles[i]] = part.shell_count;
            grown = true;
          }
      }
    }
    ++part.shell_count;
  }
  part.shells = std::move(shells);
}

}  // namespace

geometry::Part make_part(const HandPart& hand) {
  Part part;
  part.vertices = hand.vertices;
  part.triangles = hand.triangles;
  part.faces = hand.faces;
  if (!hand.chains.empty()) {
    part.kind = geometry::PartKind::wire;
    part.chain_first.push_back(0);
    for (const auto& chain : hand.chains) {
      part.vertices.insert(part.vertices.end(), chain.begin(), chain.end());
      part.chain_first.push_back(static_cast<std::uint32_t>(part.vertices.size()));
    }
  } else {
    add_edges(part);
    add_shells(part);
  }
  for (const Vec3i& v : part.vertices) part.box.include(v);
  return part;
}

HandPart hand_box(const Vec3i& lo, const Vec3i& hi) {
  HandPart box;
  for (unsigned k = 0; k < 8; ++k)
    box.vertices.push_back(
        {(k & 1U) != 0 ? hi.x : lo.x, (k & 2U) != 0 ? hi.y : lo.y, (k & 4U) != 0 ? hi.z : lo.z});
  const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (std::uint32_t f = 0; f < 6; ++f) {
    const auto& q = quads[f];
    box.triangles.push_back({q[0], q[1], q[2]});
    box.triangles.push_back({q[0], q[2], q[3]});
    box.faces.insert(box.faces.end(), {f, f});
  }
  return box;
}

SceneBuilder::SceneBuilder()
    : model_(std::make_unique<model::Model>()), scene_(std::make_unique<model::Scene>()) {
  scene_->model = model_.get();
  scene_->first_body.push_back(0);
  model_->files.push_back({.label = "hand", .format = "hand", .unit = "um", .up_axis = "z"});
}

SceneBuilder& SceneBuilder::primitive(std::uint32_t shape, const geometry::Primitive& value) {
  scene_->shapes[shape].parts[0].primitive = value;
  return *this;
}

void SceneBuilder::begin_object() {
  model::Object object;
  object.id = object.name = std::to_string(model_->objects.size());
  object.first_body = static_cast<std::uint32_t>(model_->bodies.size());
  model_->objects.push_back(object);
  scene_->first_body.push_back(static_cast<std::uint32_t>(scene_->bodies.size()));
}

void SceneBuilder::add_body(std::uint32_t shape, const Vec3l& origin, std::uint8_t alpha) {
  model::Body body;
  body.color.alpha = alpha;
  scene_->bodies.push_back({shape, static_cast<std::uint32_t>(model_->bodies.size()),
                            model::ObjectId{static_cast<std::uint32_t>(model_->objects.size() - 1)},
                            origin});
  model_->bodies.push_back(body);
  ++model_->objects.back().body_count;
  ++scene_->first_body.back();
}

SceneBuilder& SceneBuilder::object(std::initializer_list<HandBody> bodies) {
  return object(std::vector<HandBody>(bodies));
}

SceneBuilder& SceneBuilder::object(const std::vector<HandBody>& bodies) {
  begin_object();
  for (const HandBody& hand : bodies) {
    model::GridShape shape;
    for (const HandPart& part : hand.parts) {
      shape.parts.push_back(make_part(part));
      shape.box.include(shape.parts.back().box);
    }
    scene_->shapes.push_back(std::move(shape));
    add_body(static_cast<std::uint32_t>(scene_->shapes.size() - 1), hand.origin, hand.alpha);
  }
  return *this;
}

SceneBuilder& SceneBuilder::instance(std::uint32_t of_object, const Vec3l& offset) {
  begin_object();
  const std::uint32_t first = scene_->first_body[of_object];
  const std::uint32_t last = scene_->first_body[of_object + 1];
  for (std::uint32_t b = first; b < last; ++b) {
    const model::GridBody body = scene_->bodies[b];
    add_body(body.grid_shape, body.origin + offset, model_->bodies[body.body].color.alpha);
  }
  return *this;
}

}  // namespace strake::test
