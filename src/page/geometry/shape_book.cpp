// SPDX-License-Identifier: Apache-2.0
#include "page/geometry/shape_book.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>

#include "geometry/primitives/lengths.hpp"
#include "geometry/primitives/tessellate.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::page {
namespace {

using geometry::Vec3d;

/// What a shape of the page is made of: a unit primitive, or a shape on the grid by its number.
using ShapeSource = std::variant<UnitPrimitive, std::uint32_t>;

/// A unit by its kind and its measures, whose bits are compared.
using UnitKey = std::pair<std::size_t, std::vector<std::uint64_t>>;

UnitKey key_of(const UnitPrimitive& unit) {
  UnitKey key{unit.unit.index(), {std::bit_cast<std::uint64_t>(unit.sag_mm)}};
  std::visit(
      [&](const auto& primitive) {
        for (const double length : geometry::lengths_of(primitive))
          key.second.push_back(std::bit_cast<std::uint64_t>(length));
      },
      unit.unit);
  return key;
}

std::uint32_t colour_of(const model::Color& color) {
  return std::uint32_t{color.red} << 16U | std::uint32_t{color.green} << 8U | color.blue;
}

std::array<float, 12> matrix_of(const geometry::Placement& placement) {
  std::array<float, 12> matrix{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c)
      matrix[4 * r + static_cast<std::size_t>(c)] = static_cast<float>(placement.linear.row[r][c]);
    matrix[4 * r + 3] = static_cast<float>(placement.translation[static_cast<int>(r)]);
  }
  return matrix;
}

/// Gives a number to each different shape, and places them.
class ShapeBook {
 public:
  ShapeBook(const model::Scene& scene, const Vec3d& origin_mm)
      : scene_(scene), origin_(origin_mm), of_grid_(scene.shapes.size()) {}

  void add(const model::GridBody& body) {
    const model::Body& source = scene_.model->bodies[body.body];
    const model::GridShape& shape = scene_.shapes[body.grid_shape];
    PageInstance instance{.object = model::index(body.object), .colour = colour_of(source.color)};
    const auto* const primitive =
        std::get_if<geometry::Primitive>(&scene_.model->shapes[model::index(shape.shape)]);
    if (primitive != nullptr && !std::holds_alternative<geometry::LinePrimitive>(*primitive)) {
      place(*primitive, source.placement, instance);
    } else {
      if (!is_drawn(shape)) return;
      std::optional<std::uint32_t>& number = of_grid_[body.grid_shape];
      if (!number) number = next(body.grid_shape);
      instance.shape = *number;
      instance.matrix = matrix_of({{}, geometry::to_mm(body.origin) - origin_});
    }
    instances_.push_back(instance);
  }

  /// Makes the meshes, of some shapes several.
  Result<PageShapes> finish(const parallel::Context& context) && {
    auto made =
        parallel::transform(context, {.name = "page shapes", .n = sources_.size(), .grain = 16},
                            [this](std::size_t s) { return meshes_of(sources_[s]); });
    if (!made) return made.error();
    PageShapes all;
    std::vector<std::uint32_t> first;
    for (std::vector<PageMesh>& meshes : *made) {
      first.push_back(static_cast<std::uint32_t>(all.meshes.size()));
      std::ranges::move(meshes, std::back_inserter(all.meshes));
    }
    first.push_back(static_cast<std::uint32_t>(all.meshes.size()));
    for (const PageInstance& instance : instances_)
      for (std::uint32_t mesh = first[instance.shape]; mesh < first[instance.shape + 1]; ++mesh) {
        all.instances.push_back(instance);
        all.instances.back().shape = mesh;
      }
    return all;
  }

 private:
  static bool is_drawn(const model::GridShape& shape) {
    return std::ranges::any_of(shape.parts, [](const geometry::Part& part) {
      return !part.triangles.empty() || part.chain_first.size() > 1;
    });
  }
  std::uint32_t next(ShapeSource source) {
    sources_.push_back(std::move(source));
    return static_cast<std::uint32_t>(sources_.size() - 1);
  }
  void place(const geometry::Primitive& primitive, const geometry::Placement& placement,
             PageInstance& instance) {
    UnitPrimitive unit = unit_of(primitive, placement.linear.determinant() < 0);
    instance.matrix =
        matrix_of({placement.linear * unit.from_unit, placement.translation - origin_});
    const auto [at, is_new] = of_unit_.try_emplace(key_of(unit), 0);
    if (is_new) at->second = next(std::move(unit));
    instance.shape = at->second;
  }
  [[nodiscard]] std::vector<PageMesh> meshes_of(const ShapeSource& source) const {
    if (const auto* const number = std::get_if<std::uint32_t>(&source))
      return page_meshes(scene_.shapes[*number]);
    const auto& unit = std::get<UnitPrimitive>(source);
    return page_meshes(geometry::tessellate(unit.unit, {}, unit.sag_mm).mesh);
  }

  const model::Scene& scene_;
  Vec3d origin_;
  std::vector<ShapeSource> sources_;
  std::map<UnitKey, std::uint32_t> of_unit_;
  std::vector<std::optional<std::uint32_t>> of_grid_;
  std::vector<PageInstance> instances_;
};

}  // namespace

Result<PageShapes> page_shapes(const model::Scene& scene, const ShownObjects& shown,
                               const Vec3d& origin_mm, const parallel::Context& context) {
  ShapeBook book(scene, origin_mm);
  for (const model::GridBody& body : scene.bodies)
    if (shown.of[model::index(body.object)] == ShownAs::shape) book.add(body);
  return std::move(book).finish(context);
}

}  // namespace strake::page
