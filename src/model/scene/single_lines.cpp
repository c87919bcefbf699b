// SPDX-License-Identifier: Apache-2.0
#include "strake/model/single_lines.hpp"

// Decision 0103 says why pipes become wires before hidden lines are found.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "core/number.hpp"
#include "core/units.hpp"
#include "geometry/numeric/trig.hpp"
#include "model/scene/grid_shape.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::model {
namespace {

using geometry::Vec3d;

constexpr std::uint32_t kNoShape = 0xffffffffU;

/// A nominal size and the outer diameter that pipes of it have, mm (EN 10220, series 1).
struct NominalSize {
  int dn = 0;
  double diameter_mm = 0;
};
constexpr std::array<NominalSize, 22> kNominalSizes{
    {{6, 10.2},    {8, 13.5},    {10, 17.2},   {15, 21.3}, {20, 26.9},   {25, 33.7},
     {32, 42.4},   {40, 48.3},   {50, 60.3},   {65, 76.1}, {80, 88.9},   {100, 114.3},
     {125, 139.7}, {150, 168.3}, {200, 219.1}, {250, 273}, {300, 323.9}, {350, 355.6},
     {400, 406.4}, {450, 457},   {500, 508},   {600, 610}}};

/// A primitive that may be a piece of pipe: its axis in its own frame, and the radii at its ends.
struct PipePiece {
  std::vector<Vec3d> axis;
  double first_radius = 0, last_radius = 0;
  bool surely = false;  ///< whatever lies beside it
};

/// Appends the arc in the middle of a bend.
void add_arc(const geometry::CircularTorusPrimitive& torus, std::vector<Vec3d>& axis) {
  constexpr double kSagMm = 0.1;
  // The sagitta of a chord over an angle a is about R a² / 8.
  const double step = std::clamp(std::sqrt(8 * kSagMm / torus.centre_radius), 0.02, 0.4);
  const double steps = std::max(2.0, std::ceil(torus.angle / step));
  for (double k = 0; k <= steps; ++k) {
    const geometry::SinCos at = geometry::sin_cos(torus.angle * k / steps);
    axis.push_back({torus.centre_radius * at.cos, torus.centre_radius * at.sin, 0});
  }
}

std::optional<PipePiece> piece_of(const geometry::Primitive& primitive) {
  if (const auto* const c = std::get_if<geometry::CylinderPrimitive>(&primitive)) {
    if (!(c->radius > 0 && c->height > 0)) return std::nullopt;
    return PipePiece{{{0, 0, c->height / -2}, {0, 0, c->height / 2}},
                     c->radius,
                     c->radius,
                     c->height >= 2 * c->radius};
  }
  if (const auto* const t = std::get_if<geometry::CircularTorusPrimitive>(&primitive)) {
    if (!(t->tube_radius > 0 && t->centre_radius > 0 && t->angle > 0) ||
        geometry::is_full_turn(t->angle))
      return std::nullopt;
    PipePiece piece{{}, t->tube_radius, t->tube_radius, true};
    add_arc(*t, piece.axis);
    return piece;
  }
  if (const auto* const s = std::get_if<geometry::SnoutPrimitive>(&primitive)) {
    if (!(s->bottom_radius > 0 && s->top_radius > 0 && s->height > 0)) return std::nullopt;
    const Vec3d top{s->offset_x / 2, s->offset_y / 2, s->height / 2};
    return PipePiece{{-top, top}, s->bottom_radius, s->top_radius, false};
  }
  return std::nullopt;
}

/// An end of a piece of pipe in the model, mm.
struct PipeEnd {
  Vec3d at;
  double radius = 0;
};

/// A body that may be a piece of pipe.
struct Candidate {
  std::uint32_t body = 0;  ///< of the scene
  std::array<PipeEnd, 2> ends;
  bool surely = false;
};

std::optional<Candidate> candidate_of(const Scene& scene, std::uint32_t b, double max_mm) {
  const Body& body = scene.model->bodies[scene.bodies[b].body];
  const auto* const primitive =
      std::get_if<geometry::Primitive>(&scene.model->shapes[index(body.shape)]);
  if (primitive == nullptr || body.category != Category::physical) return std::nullopt;
  const auto piece = piece_of(*primitive);
  if (!piece) return std::nullopt;
  const double scale = geometry::largest_scale(body.placement.linear);
  // A placement is exact but for rounding, and so is what a pipe of just that diameter measures.
  constexpr double kRounding = 1 + 1e-6;
  if (!(2 * scale * std::max(piece->first_radius, piece->last_radius) <= max_mm * kRounding))
    return std::nullopt;
  return Candidate{b,
                   {PipeEnd{body.placement * piece->axis.front(), piece->first_radius * scale},
                    PipeEnd{body.placement * piece->axis.back(), piece->last_radius * scale}},
                   piece->surely};
}

/// The ends of pieces of pipe, found by place.
class PipeEnds {
 public:
  void add(const PipeEnd& end) { ends_.push_back({cell_of(end.at), end}); }
  void sort() {
    std::ranges::sort(ends_, {}, [](const Entry& e) {
      return std::tuple(e.cell, e.end.at.x, e.end.at.y, e.end.at.z, e.end.radius);
    });
  }

  /// Returns whether an end meets one of these, of the same diameter.
  [[nodiscard]] bool meets(const PipeEnd& end) const {
    const Cell middle = cell_of(end.at);
    for (std::int64_t x = -1; x <= 1; ++x)
      for (std::int64_t y = -1; y <= 1; ++y)
        for (std::int64_t z = -1; z <= 1; ++z) {
          const Cell cell{std::get<0>(middle) + x, std::get<1>(middle) + y,
                          std::get<2>(middle) + z};
          for (const Entry& e : std::ranges::equal_range(ends_, cell, {}, &Entry::cell))
            if (meet(end, e.end)) return true;
        }
    return false;
  }

 private:
  /// Ends meet that are no farther apart, mm: models of pipes are not drawn more exactly.
  static constexpr double kWithinMm = 2;
  using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
  struct Entry {
    Cell cell;
    PipeEnd end;
  };

  static Cell cell_of(const Vec3d& at) {
    const auto number = [](double mm) { return std::llround(mm / kWithinMm); };
    return {number(at.x), number(at.y), number(at.z)};
  }
  static bool meet(const PipeEnd& a, const PipeEnd& b) {
    const Vec3d apart = a.at - b.at;
    return dot(apart, apart) <= kWithinMm * kWithinMm &&
           std::fabs(a.radius - b.radius) <= 0.02 * std::max(a.radius, b.radius);
  }

  std::vector<Entry> ends_;
};

/// Returns which candidates are pieces of pipe: those that surely are, and those that lie between
/// such of the same diameters, as a piece between two bends does.
std::vector<bool> pieces_among(const std::vector<Candidate>& candidates) {
  std::vector<bool> is_piece(candidates.size());
  PipeEnds ends;
  const auto take = [&](std::size_t i) {
    is_piece[i] = true;
    for (const PipeEnd& end : candidates[i].ends) ends.add(end);
  };
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (candidates[i].surely) take(i);
  // A reducer may have short pieces on both sides; longer rows of short pieces are no pipes.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    ends.sort();
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (!is_piece[i] && std::ranges::all_of(candidates[i].ends,
                                              [&](const PipeEnd& end) { return ends.meets(end); }))
        found.push_back(i);
    if (found.empty()) break;
    for (const std::size_t i : found) take(i);
  }
  return is_piece;
}

/// Makes the axis of a piece of pipe a shape on the grid; one without parts where that fails.
GridShape axis_shape(const Scene& scene, std::uint32_t b, GridShapeBuilder& builder) {
  const GridBody& on_grid = scene.bodies[b];
  const Body& body = scene.model->bodies[on_grid.body];
  const auto piece =
      piece_of(std::get<geometry::Primitive>(scene.model->shapes[index(body.shape)]));
  geometry::Polylines lines;
  lines.points = piece->axis;
  lines.first.push_back(static_cast<std::uint32_t>(lines.points.size()));
  GridShape shape = builder.make(Shape(std::move(lines)), body.placement.linear, {}).shape;
  shape.shape = scene.shapes[on_grid.grid_shape].shape;
  shape.single_line = true;
  return shape;
}

}  // namespace

Result<std::optional<SingleLineOptions>> parse_single_line(std::string_view text) {
  if (text == "off") return std::optional<SingleLineOptions>();
  if (text.starts_with("DN")) {
    const auto dn = parse_integer(text.substr(2));
    for (const NominalSize& size : kNominalSizes)
      if (dn == size.dn) return std::optional(SingleLineOptions{size.diameter_mm * 1.01});
  } else if (const Result<double> diameter = parse_distance_mm(text); diameter && *diameter > 0) {
    return std::optional(SingleLineOptions{*diameter});
  }
  return Error{ErrorCode::usage,
               fmt::format("'{}' is neither an outer diameter nor a nominal size", text),
               {},
               "write off, a diameter up to which pipes are single lines, as 60mm, or a nominal "
               "size from DN6 to DN600, as DN50"};
}

Result<SingleLines> pipes_as_lines(const Scene& scene, const SingleLineOptions& options,
                                   const parallel::Context& context) {
  const auto candidates = parallel::collect<Candidate>(
      context, {.name = "pipes", .n = scene.bodies.size(), .grain = 1024},
      [&](std::size_t b, std::vector<Candidate>& out) {
        if (auto candidate =
                candidate_of(scene, static_cast<std::uint32_t>(b), options.largest_diameter_mm))
          out.push_back(*candidate);
      });
  if (!candidates) return candidates.error();
  SingleLines result{scene, 0};
  const std::vector<bool> is_piece = pieces_among(*candidates);
  std::vector<std::uint32_t> axis_of(scene.shapes.size(), kNoShape);
  GridShapeBuilder builder;
  for (std::size_t i = 0; i < candidates->size(); ++i) {
    if (!is_piece[i]) continue;
    const std::uint32_t b = (*candidates)[i].body, old = scene.bodies[b].grid_shape;
    if (axis_of[old] == kNoShape) {
      axis_of[old] = static_cast<std::uint32_t>(result.scene.shapes.size());
      result.scene.shapes.push_back(axis_shape(scene, b, builder));
    }
    const GridShape& axis = result.scene.shapes[axis_of[old]];
    if (axis.parts.empty()) continue;  // too short for the grid
    GridBody& body = result.scene.bodies[b];
    body.origin = body.origin - scene.shapes[old].base + axis.base;
    body.grid_shape = axis_of[old];
    ++result.bodies;
  }
  return result;
}

}  // namespace strake::model
