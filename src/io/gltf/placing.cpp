// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/placing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "io/source/precision.hpp"
#include "strake/core/hash.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::io::gltf {
namespace {

using geometry::Placement;
using geometry::Vec3d;

/// Where a node is, and what it inherits.
struct NodePlace {
  Placement world;                              ///< in the file's frame
  double half_spacing_mm = 0;                   ///< of the numbers of the placement; 0: doubles
  model::GroupId group = model::GroupId::none;  ///< the group of its children
  const GltfFault* fault = nullptr;             ///< its own fault or an ancestor's
  bool counted = false;                         ///< its name or an ancestor's is only a number
};

/// One placement of a mesh.
struct MeshPlacement {
  Placement world;  ///< in the file's frame
  double half_spacing_mm = 0;
};

/// An object to be: a node with a mesh, or one of its instances.
struct Element {
  GltfNode& node;
  Instances* instances = nullptr;  ///< where it is one of them
  std::size_t instance = 0;
  bool counted = false;
  std::span<const MeshPlacement> places = {};
  const GltfFault* fault = nullptr;  ///< if set, it is skipped
};

/// What a visited node becomes, and then where in the model that begins.
struct Amount {
  std::size_t objects = 0, bodies = 0;
  bool instances = false;
  bool nameless = false;  ///< an object gets its id from its path
  bool noted = false;     ///< a diagnostic belongs to it

  void add(const Amount& more) {
    objects += more.objects;
    bodies += more.bodies;
    instances = instances || more.instances;
    nameless = nameless || more.nameless;
    noted = noted || more.noted;
  }
};

/// Visits that a worker takes at once where little is done for each.
constexpr std::size_t kVisitsPerRun = 16384;

/// Returns half the spacing of the numbers of a node, in the unit of the file. They are decimals,
/// but many writers write such as float32 has.
double half_spacing_of(const Placement& local) {
  if (!came_through_float32(local.translation)) return 0;
  return float32_half_spacing(largest_coordinate(std::array{local.translation}));
}

/// Returns a path that is not too long, else a hash of it and the end of its last name.
std::string shortened(std::string path, std::string_view name) {
  constexpr std::size_t kMax = 256;
  if (path.size() <= kMax) return path;
  if (name.size() > kMax / 2) name = name.substr(name.size() - kMax / 2);
  return fmt::format("{}/{}", Hasher().add(std::string_view(path)).value().text(), name);
}

/// Nodes with children are placed one after the other, parents first. The others, which are most,
/// are looked at three times: to count what they become, to write it where it belongs, and those
/// of which something is to be said, to say it.
class Placer {
 public:
  Placer(const PlacingInput& input, model::Model& model) : input_(input), model_(model) {}
  Status run();

 private:
  static constexpr std::uint32_t kLeaf = 0xffffffffU;

  [[nodiscard]] GltfNode& node_of(std::size_t visit) const {
    return input_.nodes[input_.visits[visit].node];
  }
  [[nodiscard]] const MeshShapes& mesh_of(const GltfNode& node) const {
    return input_.meshes[*node.mesh];
  }
  [[nodiscard]] const MeshShapes* mesh_of_valid(const GltfNode& node) const {
    return node.mesh && *node.mesh < input_.meshes.size() ? &mesh_of(node) : nullptr;
  }
  [[nodiscard]] NodePlace above(std::size_t visit) const {
    const std::uint32_t parent = input_.visits[visit].parent;
    return parent == kNoParent ? NodePlace{} : inner_[inner_of_[parent]];
  }
  [[nodiscard]] NodePlace place_of(std::size_t visit) const;
  [[nodiscard]] NodePlace compute_place(std::size_t visit) const;
  [[nodiscard]] std::optional<GltfFault> damage_of(const GltfNode& node,
                                                   const NodePlace& here) const;
  template <class Visit>
  void each_element(std::size_t visit, Visit&& element) const;
  template <class Visit>
  void each_instance(GltfNode& node, const NodePlace& here, Visit&& element) const;
  template <class Visit>
  void check_bounds(Element element, Visit&& visit) const;

  Status place_inner_nodes();
  [[nodiscard]] Amount amount_of(std::size_t visit) const;
  Status count_all();
  Status number_all();
  void add_groups();
  void make_paths();
  void write(std::size_t visit);
  void add_features(const MeshShapes* mesh, model::Object& object) const;
  void write_bodies(const Element& element, std::size_t first);
  void note(std::size_t visit);
  /// The visits in runs.
  [[nodiscard]] parallel::Region runs(std::string_view name) const {
    return {.name = name, .n = (amounts_.size() + kVisitsPerRun - 1) / kVisitsPerRun};
  }
  [[nodiscard]] std::span<Amount> amounts_of(std::size_t r) {
    const std::size_t first = r * kVisitsPerRun;
    return std::span(amounts_).subspan(first, std::min(kVisitsPerRun, amounts_.size() - first));
  }
  [[nodiscard]] std::string path_id(model::GroupId parent, const std::string& name) const;
  [[nodiscard]] model::GroupId parent_of(std::size_t visit) const {
    return amounts_[visit].instances ? instance_groups_[visit] : above(visit).group;
  }

  const PlacingInput& input_;
  model::Model& model_;
  std::vector<std::uint32_t> inner_of_;  ///< per visit; kLeaf: it has no children
  std::vector<NodePlace> inner_;
  std::vector<Amount> amounts_;                  ///< per visit
  std::vector<Amount> of_runs_;                  ///< what the visits of each run become
  Amount all_;                                   ///< what all become
  std::vector<model::GroupId> instance_groups_;  ///< per visit, if there are any
  std::vector<std::string> paths_;               ///< per group, '/' at the end, if needed
};

NodePlace Placer::compute_place(std::size_t visit) const {
  const GltfNode& node = node_of(visit);
  const bool root = input_.visits[visit].parent == kNoParent;
  NodePlace here = above(visit);
  here.half_spacing_mm =
      std::max(here.half_spacing_mm,
               input_.frame.unit_mm * scale_of(here.world.linear) * half_spacing_of(node.local));
  here.world = root ? node.local : here.world * node.local;
  here.counted = here.counted || node.counted;
  if (here.fault == nullptr) here.fault = node.fault();
  return here;
}

NodePlace Placer::place_of(std::size_t visit) const {
  return inner_of_[visit] == kLeaf ? compute_place(visit) : inner_[inner_of_[visit]];
}

Status Placer::place_inner_nodes() {
  const std::size_t visits = input_.visits.size();
  Result<std::vector<std::uint32_t>> leaves = parallel::unset_slots<std::uint32_t>(visits);
  if (!leaves) return leaves.error();
  inner_of_ = std::move(*leaves);
  if (Status made = parallel::for_each(input_.context,
                                       {.name = "glTF leaves", .n = visits, .grain = kVisitsPerRun},
                                       [&](std::size_t visit) { inner_of_[visit] = kLeaf; });
      !made)
    return made;
  inner_.reserve(input_.inner.size());
  for (const std::uint32_t visit : input_.inner) {
    inner_.push_back(compute_place(visit));
    inner_of_[visit] = static_cast<std::uint32_t>(inner_.size() - 1);
  }
  return {};
}

/// Returns why a node with a mesh is no usable object, if so.
std::optional<GltfFault> Placer::damage_of(const GltfNode& node, const NodePlace& here) const {
  if (here.fault != nullptr) return *here.fault;
  const MeshShapes& mesh = mesh_of(node);
  if (mesh.fault) return mesh.fault;
  if (mesh.parts.empty())
    return GltfFault{fmt::format("/meshes/{}", *node.mesh), "it has no triangles and no lines"};
  return std::nullopt;
}

/// Calls visit(element), skipped where one of its places is out of bounds.
template <class Visit>
void Placer::check_bounds(Element element, Visit&& visit) const {
  const geometry::Box3d& box = mesh_of(element.node).box;
  const bool finite = std::ranges::all_of(element.places, [&](const MeshPlacement& place) {
    return is_finite_at(box, input_.frame.placement(place.world));
  });
  if (finite) return visit(element);
  const GltfFault fault{fmt::format("/meshes/{}", *element.node.mesh),
                        "it is placed beyond all bounds"};
  element.fault = &fault;
  visit(element);
}

/// Calls element(Element) for each object that the node of a visit becomes.
template <class Visit>
void Placer::each_element(std::size_t visit, Visit&& element) const {
  GltfNode& node = node_of(visit);
  if (!node.mesh) return;
  const NodePlace here = place_of(visit);
  const std::optional<GltfFault> fault = damage_of(node, here);
  if (!fault && node.instancing().exists()) return each_instance(node, here, element);
  const MeshPlacement place{here.world, here.half_spacing_mm};
  const Element whole{.node = node, .counted = here.counted, .places = std::span(&place, 1)};
  if (!fault) return check_bounds(whole, element);
  Element skipped = whole;
  skipped.fault = &*fault;
  element(skipped);
}

template <class Visit>
void Placer::each_instance(GltfNode& node, const NodePlace& here, Visit&& element) const {
  Instances instances = read_instances(node, input_.accessors, input_.tables);
  if (!instances.fault && instances.placements.empty())
    instances.fault = GltfFault{fmt::format("/meshes/{}", *node.mesh), "it has no instances"};
  Element whole{.node = node, .counted = here.counted};
  if (instances.fault) {
    whole.fault = &*instances.fault;
    return element(whole);
  }
  const double scale_mm = input_.frame.unit_mm * scale_of(here.world.linear);
  std::vector<MeshPlacement> places;
  places.reserve(instances.placements.size());
  for (std::size_t i = 0; i < instances.placements.size(); ++i)
    places.push_back({here.world * instances.placements[i],
                      std::max(here.half_spacing_mm, scale_mm * instances.half_spacing(i))});
  whole.places = places;
  const GltfFault lost{"EXT_mesh_gpu_instancing", "it has no finite transformation"};
  for (std::size_t i = 0; i < places.size(); ++i) {
    Element one{.node = node,
                .instances = &instances,
                .instance = i,
                .counted = here.counted || instances.counted[i],
                .places = whole.places.subspan(i, 1)};
    if (!instances.lost[i]) {
      check_bounds(one, element);
      continue;
    }
    one.fault = &lost;
    element(one);
  }
}

Amount Placer::amount_of(std::size_t visit) const {
  Amount amount;
  each_element(visit, [&](const Element& element) {
    ++amount.objects;
    amount.instances = element.instances != nullptr;
    const std::string& id =
        element.instances != nullptr ? element.instances->ids[element.instance] : element.node.id;
    amount.nameless = amount.nameless || id.empty();
    if (element.fault == nullptr)
      amount.bodies += mesh_of(element.node).parts.size() * element.places.size();
    amount.noted = amount.noted || element.fault != nullptr || mesh_of(element.node).left_out.any();
  });
  return amount;
}

/// Determines what each visited node becomes, and what all of them do.
Status Placer::count_all() {
  Result<std::vector<Amount>> amounts =
      parallel::unset_slots<Amount>(input_.visits.size(), input_.context);
  if (!amounts) return amounts.error();
  amounts_ = std::move(*amounts);
  if (Status counted = parallel::for_each(
          input_.context, {.name = "count glTF objects", .n = amounts_.size(), .grain = 256},
          [&](std::size_t i) { amounts_[i] = amount_of(i); });
      !counted)
    return counted;
  Result<std::vector<Amount>> sums =
      parallel::transform(input_.context, runs("sum up glTF objects"), [&](std::size_t r) {
        Amount sum;
        for (const Amount& amount : amounts_of(r)) sum.add(amount);
        return sum;
      });
  if (!sums) return sums.error();
  of_runs_ = std::move(*sums);
  for (const Amount& sum : of_runs_) all_.add(sum);
  return {};
}

/// Makes of each amount where in the model it begins; the model gets its objects and bodies.
Status Placer::number_all() {
  const std::size_t objects = all_.objects, bodies = all_.bodies;
  if (std::max(objects, bodies) > std::numeric_limits<std::uint32_t>::max())
    return Error{ErrorCode::input, "has more bodies than can be numbered", input_.file,
                 "split the model"};
  std::size_t object = 0, body = 0;
  for (Amount& sum : of_runs_) {
    object += std::exchange(sum.objects, object);
    body += std::exchange(sum.bodies, body);
  }
  if (Status numbered = parallel::for_each(input_.context, runs("number glTF objects"),
                                           [&](std::size_t r) {
                                             std::size_t o = of_runs_[r].objects;
                                             std::size_t b = of_runs_[r].bodies;
                                             for (Amount& amount : amounts_of(r)) {
                                               o += std::exchange(amount.objects, o);
                                               b += std::exchange(amount.bodies, b);
                                             }
                                           });
      !numbered)
    return numbered;
  auto empty_objects = parallel::slots<model::Object>(objects, input_.context);
  if (!empty_objects) return empty_objects.error();
  auto empty_bodies = parallel::slots<model::Body>(bodies, input_.context);
  if (!empty_bodies) return empty_bodies.error();
  model_.objects = std::move(*empty_objects);
  model_.bodies = std::move(*empty_bodies);
  return {};
}

/// Adds a group for each node with children, and for the instances of a node.
void Placer::add_groups() {
  const auto add = [&](std::size_t visit) {
    const auto group = static_cast<model::GroupId>(model_.groups.size());
    model_.groups.push_back({node_of(visit).name, above(visit).group});
    return group;
  };
  const auto add_inner = [&](std::size_t visit) {
    GltfNode& node = node_of(visit);
    const model::GroupId group = add(visit);
    inner_[inner_of_[visit]].group = group;
    model_.set_attributes(group, node.mesh ? node.attributes : std::move(node.attributes));
  };
  if (!all_.instances) {
    for (const std::uint32_t visit : input_.inner) add_inner(visit);
    return;
  }
  instance_groups_.resize(amounts_.size());
  for (std::size_t visit = 0; visit < amounts_.size(); ++visit) {
    if (inner_of_[visit] != kLeaf) add_inner(visit);
    if (!amounts_[visit].instances) continue;
    instance_groups_[visit] = add(visit);
    if (inner_of_[visit] == kLeaf)
      model_.set_attributes(instance_groups_[visit], std::move(node_of(visit).attributes));
  }
}

/// Makes the path of each group: names from the root, with '/' behind each. One that is too long
/// for the many objects of a deep tree keeps its end behind a hash of the whole.
void Placer::make_paths() {
  if (!all_.nameless) return;
  paths_.resize(model_.groups.size());
  for (std::size_t g = 0; g < paths_.size(); ++g) {
    const model::Group& group = model_.groups[g];
    // Groups come after what they are in.
    const std::string above =
        group.parent == model::GroupId::none ? "" : paths_[model::index(group.parent)];
    paths_[g] = shortened(above + group.name, group.name) + "/";
  }
}

std::string Placer::path_id(model::GroupId parent, const std::string& name) const {
  if (parent == model::GroupId::none) return shortened(name, name);
  return shortened(paths_[model::index(parent)] + name, name);
}

void Placer::write(std::size_t visit) {
  std::size_t object_at = amounts_[visit].objects, body_at = amounts_[visit].bodies;
  const model::GroupId parent = parent_of(visit);
  each_element(visit, [&](const Element& element) {
    GltfNode& node = element.node;
    model::Object& object = model_.objects[object_at++];
    if (Instances* const instances = element.instances) {
      object.name = std::move(instances->names[element.instance]);
      object.id = std::move(instances->ids[element.instance]);
      if (!instances->attributes.empty())
        object.attributes = std::move(instances->attributes[element.instance]);
    } else {
      // These are not needed again: a node is visited once.
      object.name = node.children.empty() ? std::move(node.name) : node.name;
      object.id = std::move(node.id);
      object.attributes = std::move(node.attributes);
    }
    add_features(mesh_of_valid(node), object);
    object.positional_id = object.id.empty() && element.counted;
    if (object.id.empty()) object.id = path_id(parent, object.name);
    object.parent = parent;
    object.first_body = static_cast<std::uint32_t>(body_at);
    if (element.fault != nullptr) return;
    write_bodies(element, body_at);
    const std::size_t count = mesh_of(node).parts.size() * element.places.size();
    object.body_count = static_cast<std::uint32_t>(count);
    body_at += count;
  });
}

/// Adds what is said of the feature that a mesh is; an id of the node comes first.
void Placer::add_features(const MeshShapes* mesh, model::Object& object) const {
  if (mesh == nullptr || mesh->features.empty()) return;
  FeatureRow row;
  for (const auto& [table, number] : mesh->features) input_.tables.add_row(table, number, row);
  object.attributes.insert(object.attributes.end(), std::make_move_iterator(row.attributes.begin()),
                           std::make_move_iterator(row.attributes.end()));
}

void Placer::write_bodies(const Element& element, std::size_t first) {
  const MeshShapes& mesh = mesh_of(element.node);
  for (const MeshPlacement& place : element.places) {
    const Placement placement = input_.frame.placement(place.world);
    const float precision = precision_um(
        std::max(mesh.half_spacing_mm * scale_of(placement.linear), place.half_spacing_mm));
    for (const MeshShapes::ColoredShape& part : mesh.parts)
      model_.bodies[first++] = {part.shape, precision, placement, part.color,
                                model::Category::physical};
  }
}

/// Says what is skipped. A skipped object stays in the model, so that what lacks it is reported.
void Placer::note(std::size_t visit) {
  std::size_t object_at = amounts_[visit].objects;
  each_element(visit, [&](const Element& element) {
    model::Object& object = model_.objects[object_at++];
    if (element.fault == nullptr)
      return note_left_out(model_, object, mesh_of(element.node).left_out);
    object.incomplete = true;
    model_.diagnostics.add(
        Severity::skipped, "gltf-damaged-object",
        fmt::format("object '{}' is skipped: {}", object.name, element.fault->message),
        fmt::format("{}, {}", input_.file, element.fault->pointer));
  });
}

Status Placer::run() {
  if (Status placed = place_inner_nodes(); !placed) return placed;
  if (Status counted = count_all(); !counted) return counted;
  add_groups();
  make_paths();
  if (Status numbered = number_all(); !numbered) return numbered;
  if (Status placed = parallel::for_each(
          input_.context, {.name = "place glTF objects", .n = amounts_.size(), .grain = 256},
          [&](std::size_t i) { write(i); });
      !placed)
    return placed;
  for (std::size_t r = 0; r < of_runs_.size(); ++r) {
    if (!of_runs_[r].noted) continue;
    for (std::size_t i = 0; i < amounts_of(r).size(); ++i)
      if (amounts_of(r)[i].noted) note(r * kVisitsPerRun + i);
  }
  return {};
}

}  // namespace

bool is_finite_at(const geometry::Box3d& box, const Placement& placement) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3d p = placement * Vec3d{(corner & 1U) != 0 ? box.hi.x : box.lo.x,
                                      (corner & 2U) != 0 ? box.hi.y : box.lo.y,
                                      (corner & 4U) != 0 ? box.hi.z : box.lo.z};
    if (!geometry::is_finite(p)) return false;
  }
  return true;
}

Status place_nodes(const PlacingInput& input, model::Model& model) {
  return Placer(input, model).run();
}

}  // namespace strake::io::gltf
