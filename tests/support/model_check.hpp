// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "strake/model/model.hpp"

namespace strake::test {

/// What is wrong with a shape that a reader gave out, whatever the file: empty when nothing is.
[[nodiscard]] inline std::string shape_fault(const model::Shape& shape) {
  if (const auto* const mesh = std::get_if<geometry::TriangleMesh>(&shape)) {
    if (mesh->triangles.empty()) return "a mesh without triangles";
    if (!mesh->faces.empty() && mesh->faces.size() != mesh->triangles.size())
      return "faces that do not match the triangles";
    for (const geometry::Triangle& t : mesh->triangles)
      for (const std::uint32_t corner : t)
        if (corner >= mesh->vertices.size()) return "a corner that is no vertex";
    for (const geometry::Vec3d& v : mesh->vertices)
      if (!is_finite(v)) return "a vertex that is not finite";
  } else if (const auto* const lines = std::get_if<geometry::Polylines>(&shape)) {
    if (lines->first.empty() || lines->first.front() != 0 ||
        lines->first.back() != lines->points.size())
      return "chains that do not cover the points";
    for (std::size_t i = 0; i + 1 < lines->first.size(); ++i)
      if (lines->first[i] >= lines->first[i + 1]) return "an empty chain";
    for (const geometry::Vec3d& v : lines->points)
      if (!is_finite(v)) return "a point that is not finite";
  }
  return {};
}

/// What is wrong with a model that a reader gave out: empty when nothing is.
[[nodiscard]] inline std::string model_fault(const model::Model& model) {
  if (model.files.size() != 1) return "not one file";
  if (model.bodies.empty()) return "no bodies and yet no error";
  for (const model::Shape& shape : model.shapes)
    if (std::string fault = shape_fault(shape); !fault.empty()) return fault;
  for (std::size_t i = 0; i < model.groups.size(); ++i)
    if (model.groups[i].parent != model::GroupId::none && model::index(model.groups[i].parent) >= i)
      return "a group before its parent";
  for (const model::Object& object : model.objects) {
    if (object.body_count == 0 && !object.incomplete) return "an object without bodies";
    if (std::size_t{object.first_body} + object.body_count > model.bodies.size())
      return "an object with bodies that do not exist";
    if (object.parent != model::GroupId::none && model::index(object.parent) >= model.groups.size())
      return "an object in a group that does not exist";
    if (object.id.empty()) return "an object without an id";
  }
  float worst_um = 0;
  for (const model::Body& body : model.bodies) {
    if (model::index(body.shape) >= model.shapes.size()) return "a body without a shape";
    if (!std::isfinite(body.precision_um) || body.precision_um < 0)
      return "a body with a precision that is no length";
    worst_um = std::max(worst_um, body.precision_um);
  }
  if (model.files[0].precision_mm != static_cast<double>(worst_um) / 1000)
    return "a precision of the file that is not the worst of its bodies";
  return {};
}

}  // namespace strake::test
