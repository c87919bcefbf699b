// SPDX-License-Identifier: Apache-2.0
#include "strake/model/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/seeded_hash.hpp"
#include "model/scene/grid_shape.hpp"
#include "model/scene/instancing.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/marks.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::model {
namespace {

using geometry::Mat3d;

constexpr double kMaxWeldMm = 1000;

/// Returns which seams of a body are closed: those that its numbers cannot distinguish, before
/// wider ones that are requested.
geometry::Seams seams_of(const Model& model, const Body& body, const SceneOptions& options) {
  if (!std::holds_alternative<geometry::TriangleMesh>(model.shapes[index(body.shape)])) return {};
  const auto on_grid = [](double units) {
    return static_cast<std::int64_t>(std::min(units, kMaxWeldMm * geometry::kGridPerMm));
  };
  const std::int64_t own = on_grid(std::ceil(contact_distance(body.precision_um)));
  const std::int64_t within =
      options.weld_mm >= 0 ? on_grid(options.weld_mm * geometry::kGridPerMm) : own;
  return {within, std::min(own, within)};
}

// Only shares the work out. Blocks of objects are about as long.
constexpr std::size_t kBodiesPerBlock = 4096;

/// A shape under one linear part, with its seams closed alike, and the first body that uses it.
/// There are few precisions: steps of float32 and of decimals.
struct Use {
  ShapeId shape{};
  geometry::Seams seams;
  std::uint32_t body = 0;
  std::uint32_t listed = 0;  ///< its number among those listed
};

/// The uses of the bodies listed, in order of first appearance.
struct Uses {
  std::vector<Use> all;
  std::vector<std::uint32_t> of;  ///< by body
};

/// How many bodies have a use, counted once somebody asks, as few shapes have anything to report.
class BodyCounts {
 public:
  explicit BodyCounts(const Uses& uses) : uses_(uses) {}

  std::uint32_t of(std::size_t use) {
    if (counts_.empty()) {
      counts_.resize(uses_.all.size());
      for (const std::uint32_t of_body : uses_.of) ++counts_[of_body];
    }
    return counts_[use];
  }

 private:
  const Uses& uses_;
  std::vector<std::uint32_t> counts_;
};

/// Returns the bits of a number, with negative zero as zero: the two place alike.
std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value + 0.0); }

std::size_t hash_of(const SeededHash& hash, const Body& body, const geometry::Seams& seams) {
  std::array<std::uint64_t, 12> words{index(body.shape), static_cast<std::uint64_t>(seams.within),
                                      static_cast<std::uint64_t>(seams.first)};
  std::size_t at = 2;
  for (const geometry::Vec3d& row : body.placement.linear.row)
    for (int k = 0; k < 3; ++k) words[++at] = bits(row[k]);
  return hash.of(std::as_bytes(std::span(words)));
}

bool same_linear(const Mat3d& a, const Mat3d& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      if (bits(a.row[i][k]) != bits(b.row[i][k])) return false;
  return true;
}

bool wanted(Category category, const SceneOptions& options) {
  switch (category) {
    case Category::physical:
      return options.physical;
    case Category::obstruction:
      return options.obstruction;
    case Category::insulation:
      return options.insulation;
  }
  return false;
}

/// Adds a diagnostic whose text is only made when it will be kept.
template <class Message>
void report(Diagnostics& diagnostics, Severity severity, std::string_view code, const Model& model,
            ObjectId id, Message&& message) {
  if (diagnostics.count(code) >= Diagnostics::kMaxPerCode) {
    diagnostics.add(severity, code, {}, {});
    return;
  }
  const Object& object = model.object(id);
  const std::string_view file =
      object.file < model.files.size() ? std::string_view(model.files[object.file].label) : "";
  const std::string& name = object.name.empty() ? object.id : object.name;
  diagnostics.add(severity, code, message(),
                  file.empty() ? name : fmt::format("{}: {}", file, name));
}

/// Whether a surface ends somewhere: an edge has an odd number of triangles. One that does not end
/// is a sheet only because its triangles do not all face the same way.
bool ends_somewhere(const geometry::Part& part) {
  for (std::size_t e = 0; e + 1 < part.edges.size(); ++e)
    if ((part.edges[e + 1].first_triangle - part.edges[e].first_triangle) % 2 != 0) return true;
  return false;
}

/// `counted` takes a code, a count and its words for one and for many.
template <class Counted>
void report_weld(const geometry::RepairCounts& findings, const Counted& counted) {
  if (findings.welded_corners == 0) return;
  const double mm = findings.largest_weld * geometry::kMmPerGrid;
  const std::string apart =
      mm < 1 ? fmt::format("up to {:.3g} um", mm * 1000) : fmt::format("up to {:.3f} mm", mm);
  const bool closed = findings.welded_shells > 0;
  const std::string what = closed ? "so that a surface closes" : "so that edges of a surface meet";
  counted(Severity::note, "mesh-welded", findings.welded_corners,
          fmt::format("a corner {} beside another or an edge counts as on it, {}", apart, what),
          fmt::format("{{}} corners {} beside others or edges count as on them, {}", apart, what));
}

/// Reports what is notable about a shape, for the first object that uses it, with the number of
/// further bodies that use it: `count_bodies()` returns how many do.
template <class Count>
void report_findings(const GridShapeResult& made, Count&& count_bodies, const Model& model,
                     ObjectId id, Diagnostics& diagnostics) {
  const auto counted = [&](Severity severity, std::string_view code, std::uint64_t count,
                           std::string_view one, std::string_view many) {
    if (count != 0)
      report(diagnostics, severity, code, model, id, [&] {
        std::string text = fmt::format(fmt::runtime(count == 1 ? one : many), count);
        const std::uint32_t bodies = count_bodies();
        if (bodies > 1)
          text += fmt::format("; likewise in {} more {} of the same shape", bodies - 1,
                              bodies == 2 ? "body" : "bodies");
        return text;
      });
  };
  counted(Severity::note, "mesh-degenerate", made.findings.degenerate_triangles,
          "a triangle without area was left out", "{} triangles without area were left out");
  counted(Severity::note, "mesh-cut", made.findings.cut_triangles,
          "a triangle was cut where corners of others lie on its edges, to match them",
          "{} triangles were cut where corners of others lie on their edges, to match them");
  report_weld(made.findings, counted);
  counted(Severity::note, "mesh-duplicate", made.findings.duplicate_triangles,
          "a repeated triangle was left out", "{} repeated triangles were left out");
  counted(Severity::warning, "mesh-turned", made.findings.turned_triangles,
          "a triangle of a closed surface faced the other way than the others and is turned",
          "{} triangles of closed surfaces faced the other way than the others and are turned");
  counted(Severity::warning, "mesh-nested", made.findings.nested_shells,
          "a closed shell inside solid material was left out",
          "{} closed shells inside solid material were left out");
  counted(Severity::warning, "mesh-two-sided", made.findings.two_sided_shells,
          "a closed skin is drawn from both sides and counts as the solid inside it",
          "{} closed skins are drawn from both sides and count as the solids inside them");
  counted(Severity::skipped, "mesh-bad-triangle", made.bad_triangles,
          "a triangle with a vertex that is missing or has no place was left out",
          "{} triangles with a vertex that is missing or has no place were left out");
  counted(Severity::skipped, "polyline-bad-point", made.bad_points,
          "a point that has no place was left out", "{} points that have no place were left out");
  std::uint64_t inverted = 0, open = 0, mixed = 0, non_manifold = 0;
  for (const geometry::Part& part : made.shape.parts) {
    inverted += part.flags.inverted ? 1U : 0U;
    if (part.flags.open) ++(ends_somewhere(part) ? open : mixed);
    non_manifold += part.flags.non_manifold ? 1U : 0U;
  }
  counted(Severity::warning, "mesh-inverted", inverted,
          "a solid had its faces pointing inwards; they were flipped",
          "{} solids had their faces pointing inwards; they were flipped");
  counted(Severity::note, "mesh-open", open, "a surface does not close and counts as a sheet",
          "{} surfaces do not close and count as sheets");
  counted(Severity::warning, "mesh-mixed-winding", mixed,
          "a surface closes, but its triangles do not all face the same way: it counts as a sheet, "
          "and what lies within it is not found",
          "{} surfaces close, but their triangles do not all face the same way: they count as "
          "sheets, and what lies within them is not found");
  counted(Severity::note, "mesh-non-manifold", non_manifold,
          "a part has edges with more than two triangles",
          "{} parts have edges with more than two triangles");
}

/// The state that the assembly of a scene passes along.
struct SceneAssembly {
  const Model& model;
  const SceneOptions& options;
  Scene scene;
};

bool has_shape(const Model& model, std::uint32_t body) {
  return body < model.bodies.size() && index(model.bodies[body].shape) < model.shapes.size();
}

/// Notes what the model itself lacks.
void note_lacking(SceneAssembly& assembly) {
  const Model& model = assembly.model;
  Scene& scene = assembly.scene;
  for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
    const Object& object = model.objects[o];
    if (object.incomplete)
      scene.lacking.push_back(
          {ObjectId{o}, object.body_count == 0 ? "object-skipped" : "object-incomplete"});
    for (std::uint32_t b = object.first_body; b - object.first_body < object.body_count; ++b) {
      if (has_shape(model, b)) continue;
      report(scene.diagnostics, Severity::skipped, "body-without-shape", model, ObjectId{o},
             [] { return std::string("a body refers to a shape that does not exist"); });
      scene.lacking.push_back({ObjectId{o}, "body-without-shape"});
    }
  }
}

/// Lists the wanted bodies object by object, and where those of each object begin.
Status list_bodies(SceneAssembly& assembly, const parallel::Context& context) {
  const Model& model = assembly.model;
  Scene& scene = assembly.scene;
  parallel::Marks lacking(1), unwanted(1);
  // Calls take(body) for each wanted body of an object, and other(body) for those that are not.
  const auto each = [&](std::size_t o, auto&& take, auto&& other) {
    const Object& object = model.objects[o];
    for (std::uint32_t b = object.first_body; b - object.first_body < object.body_count; ++b) {
      if (!has_shape(model, b))
        lacking.set(0);
      else if (wanted(model.bodies[b].category, assembly.options))
        take(b);
      else
        other(b);
    }
  };
  const parallel::Region objects{
      .name = "list bodies", .n = model.objects.size(), .grain = kBodiesPerBlock};
  auto listed = parallel::count_fill<GridBody>(
      context, objects,
      [&](std::size_t o) {
        std::size_t count = 0;
        each(o, [&](std::uint32_t) { ++count; }, [&](std::uint32_t) { unwanted.set(0); });
        if (model.objects[o].incomplete) lacking.set(0);
        return count;
      },
      [&](std::size_t o, std::span<GridBody> out) {
        const ObjectId object{static_cast<std::uint32_t>(o)};
        std::size_t at = 0;
        each(o, [&](std::uint32_t b) { out[at++] = {0, b, object, {}}; }, [](std::uint32_t) {});
      });
  if (!listed) return listed.error();
  if (lacking.is_set(0)) note_lacking(assembly);
  if (unwanted.is_set(0)) {
    const auto left_out = parallel::reduce(
        context, objects, std::uint64_t{0},
        [&](std::uint64_t& count, std::size_t o) {
          each(o, [](std::uint32_t) {}, [&](std::uint32_t) { ++count; });
        },
        [](std::uint64_t& into, std::uint64_t count) { into += count; });
    if (!left_out) return left_out.error();
    scene.left_out = *left_out;
  }
  scene.bodies = std::move(listed->values);
  auto first = parallel::transform(
      context, {.name = "first bodies", .n = listed->offsets.size(), .grain = kBodiesPerBlock},
      [&](std::size_t o) { return static_cast<std::uint32_t>(listed->offsets[o]); });
  if (!first) return first.error();
  scene.first_body = std::move(*first);
  return {};
}

/// Numbers the distinct (shape, linear part, seams) of the listed bodies in order of first
/// appearance.
Result<Uses> number_uses(const SceneAssembly& assembly, const parallel::Context& context) {
  const Model& model = assembly.model;
  const std::vector<GridBody>& bodies = assembly.scene.bodies;
  const auto body = [&](std::size_t i) -> const Body& { return model.bodies[bodies[i].body]; };
  const auto seams = [&](std::size_t i) { return seams_of(model, body(i), assembly.options); };
  const SeededHash hash;
  auto kinds = parallel::distinct(
      context, "shapes under linear parts", bodies.size(),
      [&](std::size_t i) -> std::uint64_t { return hash_of(hash, body(i), seams(i)); },
      [&](std::size_t i, std::size_t j) {
        return body(i).shape == body(j).shape && seams(i) == seams(j) &&
               same_linear(body(i).placement.linear, body(j).placement.linear);
      });
  if (!kinds) return kinds.error();
  auto uses = parallel::transform(
      context, {.name = "uses", .n = kinds->first.size(), .grain = kBodiesPerBlock},
      [&](std::size_t k) {
        const std::uint32_t i = kinds->first[k];
        return Use{body(i).shape, seams(i), bodies[i].body, i};
      });
  if (!uses) return uses.error();
  return Uses{std::move(*uses), std::move(kinds->of)};
}

/// Returns a rough number of triangles, by which the heaviest shapes are known.
double estimated_cost(const Shape& shape) {
  if (const auto* mesh = std::get_if<geometry::TriangleMesh>(&shape))
    return static_cast<double>(mesh->triangles.size());
  if (const auto* lines = std::get_if<geometry::Polylines>(&shape))
    return static_cast<double>(lines->points.size());
  return 100;
}

Result<std::vector<GridShapeResult>> make_shapes(const SceneAssembly& assembly,
                                                 const std::vector<Use>& uses,
                                                 const parallel::Context& context) {
  const Model& model = assembly.model;
  // Small shapes go in blocks, the heaviest block first. Between 4 and 64 no difference can be seen
  // (decision 0073).
  constexpr std::size_t kGrain = 16;
  const parallel::Region blocks{.n = uses.size(), .grain = kGrain};
  std::vector<double> costs(blocks.blocks(), 0);
  for (std::size_t i = 0; i < uses.size(); ++i)
    costs[i / kGrain] += estimated_cost(model.shapes[index(uses[i].shape)]);
  const std::vector<std::uint32_t> order = parallel::longest_first(costs);
  const parallel::Region region{
      .name = "shapes on the grid", .n = uses.size(), .grain = kGrain, .order = order};
  return parallel::transform_with(
      context, region, [] { return GridShapeBuilder(); },
      [&](GridShapeBuilder& builder, std::size_t i) {
        GridShapeResult made = builder.make(
            model.shapes[index(uses[i].shape)], model.bodies[uses[i].body].placement.linear,
            {.sag_mm = assembly.options.sag_mm, .seams = uses[i].seams});
        made.shape.shape = uses[i].shape;
        return made;
      });
}

/// A body of which something is to be said, by its number among those listed.
struct OddBody {
  std::uint32_t listed = 0;
  std::uint32_t use = 0;
  bool has_place = false;
};

/// Notes what a body lacks for the faults of its shape or its place.
void note_odd(SceneAssembly& assembly, const OddBody& odd, const GridShapeResult& shape) {
  const Model& model = assembly.model;
  Scene& scene = assembly.scene;
  const ObjectId object = scene.bodies[odd.listed].object;
  if (shape.bad_triangles > 0) scene.lacking.push_back({object, "mesh-bad-triangle"});
  if (shape.bad_points > 0) scene.lacking.push_back({object, "polyline-bad-point"});
  if (odd.has_place) return;
  const std::string_view code = shape.fault.empty() ? "body-unplaceable"
                                : shape.vanished    ? kVanished
                                                    : "shape-unplaceable";
  scene.lacking.push_back({object, code});
  report(scene.diagnostics, Severity::skipped, code, model, object, [&] {
    return shape.fault.empty()
               ? std::string(
                     "a body has no place: its translation is not finite or beyond a million "
                     "kilometres")
               : fmt::format("a body has no place: {}", shape.fault);
  });
}

/// Takes bodies without a place out.
void leave_out(Scene& scene, std::span<const OddBody> odd) {
  if (std::ranges::all_of(odd, &OddBody::has_place)) return;
  std::size_t kept = 0;
  auto next = odd.begin();
  std::ranges::fill(scene.first_body, 0U);
  for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
    while (next != odd.end() && next->listed < i) ++next;
    if (next != odd.end() && next->listed == i && !next->has_place) continue;
    scene.bodies[kept++] = scene.bodies[i];
    ++scene.first_body[index(scene.bodies[i].object) + 1];
  }
  scene.bodies.resize(kept);
  for (std::size_t o = 1; o < scene.first_body.size(); ++o)
    scene.first_body[o] += scene.first_body[o - 1];
}

/// Places the bodies of the shapes that were made, each with the first that is equal; the others
/// and the unplaceable are reported.
Status place_bodies(SceneAssembly& assembly, const Uses& uses,
                    const std::vector<GridShapeResult>& made, const parallel::Distinct& kinds,
                    const parallel::Context& context) {
  const Model& model = assembly.model;
  Scene& scene = assembly.scene;
  const auto odd = parallel::collect<OddBody>(
      context, {.name = "place bodies", .n = scene.bodies.size(), .grain = kBodiesPerBlock},
      [&](std::size_t i, std::vector<OddBody>& out) {
        GridBody& body = scene.bodies[i];
        const std::uint32_t use = uses.of[i];
        const GridShapeResult& shape = made[use];
        const auto origin = geometry::snap(model.bodies[body.body].placement.translation);
        const bool has_place = shape.fault.empty() && origin;
        if (!has_place || shape.bad_triangles > 0 || shape.bad_points > 0)
          out.push_back({static_cast<std::uint32_t>(i), use, has_place});
        if (!has_place) return;
        body.grid_shape = kinds.of[use];
        body.origin = *origin + shape.shape.base;
        const std::uint32_t first = kinds.first[body.grid_shape];
        if (first != use)
          body.origin = body.origin + translation_between(made[first].shape, shape.shape);
      });
  if (!odd) return odd.error();
  BodyCounts counts(uses);
  auto next = odd->begin();
  const auto note_until = [&](std::size_t listed) {
    for (; next != odd->end() && next->listed < listed; ++next)
      note_odd(assembly, *next, made[next->use]);
  };
  for (std::size_t use = 0; use < uses.all.size(); ++use) {
    const std::uint32_t listed = uses.all[use].listed;
    note_until(listed);
    report_findings(
        made[use], [&] { return counts.of(use); }, model, scene.bodies[listed].object,
        scene.diagnostics);
  }
  note_until(scene.bodies.size());
  leave_out(scene, *odd);
  std::ranges::sort(scene.lacking);
  const auto repeated = std::ranges::unique(scene.lacking);
  scene.lacking.erase(repeated.begin(), repeated.end());
  return {};
}

}  // namespace

double contact_distance(float precision_um) {
  static_assert(geometry::kGridPerMm == 1000, "a grid unit is a micrometre");
  // Two ulp are four of the half spacings that a source states.
  return std::max(3.0, 4 * static_cast<double>(precision_um));
}

Result<Scene> make_scene(const Model& model, const SceneOptions& options,
                         const parallel::Context& context) {
  if (!(options.sag_mm > 0) || !std::isfinite(options.sag_mm))
    return Error{ErrorCode::usage, "the sag must be a positive length", "", "give one like 0.5mm"};
  if (!(options.weld_mm <= kMaxWeldMm))
    return Error{ErrorCode::usage, "the weld distance must be a length up to a metre", "",
                 "leave it out to have it derived from the sources"};
  SceneAssembly assembly{model, options, {}};
  if (const Status listed = list_bodies(assembly, context); !listed) return listed.error();
  const Result<Uses> uses = number_uses(assembly, context);
  if (!uses) return uses.error();
  Result<std::vector<GridShapeResult>> shapes = make_shapes(assembly, uses->all, context);
  if (!shapes) return shapes.error();
  std::vector<GridShapeResult>& made = *shapes;
  const Result<parallel::Distinct> kinds = find_equal_shapes(made, context);
  if (!kinds) return kinds.error();
  if (const Status placed = place_bodies(assembly, *uses, made, *kinds, context); !placed)
    return placed.error();
  Scene& scene = assembly.scene;
  scene.model = &model;
  scene.sag_mm = options.sag_mm;
  scene.weld_mm = options.weld_mm;
  scene.shapes.reserve(kinds->first.size());
  for (const std::uint32_t first : kinds->first)
    scene.shapes.push_back(std::move(made[first].shape));
  return std::move(assembly.scene);
}

}  // namespace strake::model
