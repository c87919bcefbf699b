// SPDX-License-Identifier: Apache-2.0
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "python/bindings/bindings.hpp"
#include "python/bindings/errors.hpp"
#include "python/bindings/model.hpp"

namespace nb = nanobind;

namespace strake::python {

namespace {

using Vertices = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Triangles = nb::ndarray<const std::uint32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Placement = std::array<double, 12>;

/// Builds a model of meshes that are in memory.
class ModelBuilder {
 public:
  explicit ModelBuilder(std::string label) {
    model_.files.push_back(
        {.label = std::move(label), .format = "arrays", .unit = "mm (given)", .up_axis = "z"});
  }

  /// Adds a shape and returns its number. `is_float` says that the numbers came as float32.
  std::uint32_t add_shape(const Vertices& vertices, const Triangles& triangles, bool is_float) {
    geometry::TriangleMesh mesh;
    mesh.vertices.reserve(vertices.shape(0));
    double farthest = 0;
    for (std::size_t v = 0; v < vertices.shape(0); ++v) {
      const geometry::Vec3d point{vertices(v, 0), vertices(v, 1), vertices(v, 2)};
      if (!geometry::is_finite(point)) fail("vertex", v, "is not finite");
      for (int k = 0; k < 3; ++k) farthest = std::max(farthest, std::fabs(point[k]));
      mesh.vertices.push_back(point);
    }
    mesh.triangles.reserve(triangles.shape(0));
    for (std::size_t t = 0; t < triangles.shape(0); ++t) {
      const geometry::Triangle corners{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
      for (const std::uint32_t corner : corners)
        if (corner >= mesh.vertices.size()) fail("triangle", t, "has a corner that is no vertex");
      mesh.triangles.push_back(corners);
    }
    model_.shapes.emplace_back(std::move(mesh));
    precision_um_.push_back(is_float ? half_spacing_um(farthest) : 0.0F);
    return static_cast<std::uint32_t>(model_.shapes.size() - 1);
  }

  struct Given {
    std::string name;
    std::vector<std::string> groups;  ///< names from the outermost
    model::Attributes attributes;
    std::optional<model::Color> color;
  };

  void add_object(Given given, std::uint32_t shape, const Placement& placement) {
    model::Body body;
    body.shape = model::ShapeId(shape);
    body.precision_um = precision_um_.at(shape);
    for (std::size_t k = 0; k < 3; ++k) {
      body.placement.linear.row[k] = {placement[4 * k], placement[4 * k + 1], placement[4 * k + 2]};
      body.placement.translation[static_cast<int>(k)] = placement[4 * k + 3];
    }
    if (!geometry::is_finite(body.placement))
      raise({ErrorCode::usage, "its placement is not finite", given.name, {}});
    if (given.color) body.color = *given.color;
    model::Object object;
    object.id = given.name;
    object.name = std::move(given.name);
    object.parent = group_of(given.groups);
    object.first_body = static_cast<std::uint32_t>(model_.bodies.size());
    object.body_count = 1;
    object.attributes = std::move(given.attributes);
    model_.bodies.push_back(body);
    model_.objects.push_back(std::move(object));
  }

  ModelPointer finish() {
    model::finish(model_);
    return std::make_shared<LoadedModel>(std::move(model_));
  }

 private:
  [[noreturn]] static void fail(const char* what, std::size_t i, const char* why) {
    raise({ErrorCode::usage, std::string(what) + " " + std::to_string(i) + " " + why, {}, {}});
  }

  /// What a float cannot tell, at the farthest coordinate.
  static float half_spacing_um(double mm) {
    const auto at = static_cast<float>(mm);
    const float spacing = std::nextafter(at, std::numeric_limits<float>::infinity()) - at;
    return spacing * 500;
  }

  model::GroupId group_of(const std::vector<std::string>& names) {
    model::GroupId parent = model::GroupId::none;
    for (const std::string& name : names) {
      const auto [found, is_new] =
          groups_.try_emplace({parent, name}, static_cast<model::GroupId>(model_.groups.size()));
      if (is_new) model_.groups.push_back({name, parent});
      parent = found->second;
    }
    return parent;
  }

  model::Model model_;
  std::vector<float> precision_um_;  ///< by shape
  std::map<std::pair<model::GroupId, std::string>, model::GroupId> groups_;
};

void add_object(ModelBuilder& builder, std::string name, std::vector<std::string> groups,
                model::Attributes attributes, std::optional<std::array<std::uint8_t, 4>> color,
                std::uint32_t shape, const Placement& placement) {
  std::optional<model::Color> given;
  if (color) given = model::Color{(*color)[0], (*color)[1], (*color)[2], (*color)[3]};
  builder.add_object({std::move(name), std::move(groups), std::move(attributes), given}, shape,
                     placement);
}

}  // namespace

void bind_given_meshes(nb::module_& module) {
  nb::class_<ModelBuilder>(module, "ModelBuilder")
      .def(nb::init<std::string>(), nb::arg("label"))
      .def("add_shape", &ModelBuilder::add_shape, nb::arg("vertices").noconvert(),
           nb::arg("triangles").noconvert(), nb::arg("is_float"))
      .def("add_object", &add_object, nb::arg("name"), nb::arg("groups"), nb::arg("attributes"),
           nb::arg("color").none(), nb::arg("shape"), nb::arg("placement"))
      .def("finish", &ModelBuilder::finish);
}

}  // namespace strake::python
