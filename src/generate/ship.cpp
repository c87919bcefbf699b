// SPDX-License-Identifier: Apache-2.0
#include "strake/generate/ship.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <ostream>
#include <string>
#include <utility>

#include "generate/ship_plan.hpp"

namespace strake::generate {
namespace {

using geometry::Placement;
using geometry::Vec3d;

/// Returns the rotation of a quaternion of any length, whose entries are rational.
constexpr geometry::Mat3d rotation(double w, double x, double y, double z) {
  const double n = w * w + x * x + y * y + z * z;
  return {
      {Vec3d{(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n},
       Vec3d{2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n},
       Vec3d{2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n,
             (w * w - x * x - y * y + z * z) / n}}};
}

/// Returns lanes and levels that suit a number of objects, about 75 objects to a room, the length
/// growing fastest. Small ships have several candidates: the one that needs the least thinning out
/// wins.
std::vector<ShipPlan> candidate_plans(const ShipOptions& options) {
  constexpr std::uint64_t kSmall = 6000;
  constexpr int kSlender = 3;
  const double rooms = static_cast<double>(options.objects) / 75;
  int size = 1;
  while ((size + 1.0) * (size + 1.0) * (size + 1.0) * 3 <= rooms) ++size;
  if (options.kind == ShipKind::slender) size = std::clamp(size / 2, 1, kSlender);
  const int more = options.objects < kSmall ? 1 : 0;
  std::vector<ShipPlan> plans;
  for (int levels = size; levels <= size + more; ++levels)
    for (int lanes = std::max(2, size); lanes <= std::max(2, size) + more; ++lanes) {
      ShipPlan plan;
      plan.seed = options.seed;
      plan.kind = options.kind;
      plan.imported = options.imported_detail;
      plan.imported_triangles = options.imported_triangles;
      plan.lanes = lanes;
      plan.levels = levels;
      plans.push_back(plan);
    }
  return plans;
}

ShipBuilder build(const ShipPlan& plan) {
  ShipBuilder builder;
  const Steel steel = build_steel(plan, builder);
  build_runs(plan, steel, builder);
  build_ballast(plan, builder);
  build_rooms(plan, steel, builder);
  build_weather_deck(plan, steel, builder);
  return builder;
}

/// Builds the shortest ship of a plan's lanes and levels that has enough objects.
ShipBuilder build_enough(ShipPlan plan, std::uint64_t objects, const std::stop_token& stop) {
  plan.bays = 1;
  while (true) {
    ShipBuilder builder = build(plan);
    const std::uint64_t count = builder.objects().size();
    if (count >= objects || stop.stop_requested()) return builder;
    // It aims a little short, so that it arrives from below.
    const std::uint64_t missing =
        (objects - count) * static_cast<std::uint64_t>(plan.bays) * 20 / (count * 21 + 1);
    plan.bays += std::max(1, static_cast<int>(missing));
  }
}

Result<ShipBuilder> build_best(const ShipOptions& options, const std::stop_token& stop) {
  ShipBuilder best;
  for (const ShipPlan& plan : candidate_plans(options)) {
    ShipBuilder builder = build_enough(plan, options.objects, stop);
    if (stop.stop_requested())
      return Error{ErrorCode::cancelled, "cancelled while generating", "", ""};
    if (best.objects().empty() || builder.objects().size() < best.objects().size())
      best = std::move(builder);
  }
  return best;
}

/// Chooses which objects stay: spare ones are dropped first, evenly spread over the ship; if they
/// are too few, the last built are dropped too, except those that must stay.
std::vector<bool> choose_kept(const ShipBuilder& builder, std::uint64_t wanted) {
  const std::vector<ShipObject>& objects = builder.objects();
  std::vector<bool> kept(objects.size(), true);
  std::uint64_t excess = objects.size() - wanted;
  const auto spare = static_cast<std::uint64_t>(std::count_if(
      objects.begin(), objects.end(), [](const ShipObject& b) { return info(b.kind).optional; }));
  const std::uint64_t drop = std::min(excess, spare);
  std::uint64_t candidates_done = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!info(objects[i].kind).optional) continue;
    // Bresenham: exactly `drop` of the `spare` fall, at even distances.
    kept[i] = (candidates_done + 1) * drop / spare == candidates_done * drop / spare;
    ++candidates_done;
  }
  excess -= drop;
  for (std::size_t i = objects.size(); excess > 0 && i-- > 0;)
    if (kept[i] && !objects[i].stays) kept[i] = false, --excess;
  return kept;
}

/// Returns a key that sorts as the ids do: code, bay, lane, level, number, all of fixed width.
std::uint64_t id_key(const ShipObject& built, const std::vector<std::uint8_t>& rank) {
  return (static_cast<std::uint64_t>(rank[static_cast<std::size_t>(built.kind)]) << 56U) |
         (static_cast<std::uint64_t>(built.cell.bay) << 40U) |
         (static_cast<std::uint64_t>(built.cell.lane) << 32U) |
         (static_cast<std::uint64_t>(built.cell.level) << 24U) | built.number;
}

std::vector<std::uint8_t> code_ranks() {
  std::vector<std::uint8_t> order(kKinds.size()), rank(kKinds.size());
  std::iota(order.begin(), order.end(), std::uint8_t{0});
  std::sort(order.begin(), order.end(),
            [](std::uint8_t a, std::uint8_t b) { return kKinds[a].code < kKinds[b].code; });
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<std::uint8_t>(i);
  return rank;
}

/// Returns the kept objects in the order of their ids.
std::vector<Handle> id_order(const ShipBuilder& builder, const std::vector<bool>& kept) {
  const std::vector<std::uint8_t> rank = code_ranks();
  std::vector<std::pair<std::uint64_t, Handle>> keyed;
  for (Handle h = 0; h < builder.objects().size(); ++h)
    if (kept[h]) keyed.emplace_back(id_key(builder.objects()[h], rank), h);
  std::sort(keyed.begin(), keyed.end());
  std::vector<Handle> order;
  order.reserve(keyed.size());
  for (const auto& [key, handle] : keyed) order.push_back(handle);
  return order;
}

std::string id_of(const ShipObject& built) {
  return fmt::format("{}-B{:04}-L{:02}-D{:02}-{:04}", info(built.kind).code, built.cell.bay,
                     built.cell.lane, built.cell.level, built.number);
}

/// Makes zone, deck and discipline groups as objects request them.
class GroupTree {
 public:
  explicit GroupTree(model::Model& model) : model_(model) {
    model_.groups.push_back({"SHIP-SECTION", model::GroupId::none});
  }
  model::GroupId of(const ShipObject& built) {
    const std::uint32_t zone = built.cell.bay / 4U;
    const auto z = group({zone, kAny, kAny}, model::GroupId{0}, [&] {
      return fmt::format("ZONE-{:02} FR {}-{}", zone + 1, zone * 16, zone * 16 + 15);
    });
    const std::uint32_t level = built.cell.level;
    const auto d = group({zone, level, kAny}, z, [&] {
      return level == 0 ? std::string("DOUBLE-BOTTOM") : fmt::format("DECK-{:02}", level);
    });
    const auto discipline = static_cast<std::uint32_t>(info(built.kind).discipline);
    return group({zone, level, discipline}, d,
                 [&] { return std::string(kDisciplines[discipline].name); });
  }

 private:
  static constexpr std::uint32_t kAny = 0xffffffffU;
  template <class Name>
  model::GroupId group(const std::array<std::uint32_t, 3>& key, model::GroupId parent, Name name) {
    const auto [place, fresh] =
        known_.try_emplace(key, static_cast<std::uint32_t>(model_.groups.size()));
    if (fresh) model_.groups.push_back({name(), parent});
    return model::GroupId{place->second};
  }
  model::Model& model_;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> known_;
};

Placement placement_of(const AxisFrame& frame, bool turned) {
  Placement placement;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      placement.linear.row[i][static_cast<int>(j)] = frame.m[3 * i + j];
  placement.translation = {static_cast<double>(frame.t.x) / 1000,
                           static_cast<double>(frame.t.y) / 1000,
                           static_cast<double>(frame.t.z) / 1000};
  // A general one: quaternion 9, 2, -3, 5 over 119.
  return turned ? Placement{rotation(9, 2, -3, 5), {}} * placement : placement;
}

model::Model assemble(ShipBuilder& builder, const std::vector<Handle>& order,
                      const ShipOptions& options) {
  model::Model model;
  model.files.push_back({"ship", "generated", "mm", "z", 0, 0});
  GroupTree groups(model);
  model.objects.reserve(order.size());
  model.bodies.reserve(order.size());
  for (const Handle handle : order) {
    const ShipObject& built = builder.objects()[handle];
    const KindInfo& kind = info(built.kind);
    const DisciplineInfo& discipline = kDisciplines[static_cast<std::size_t>(kind.discipline)];
    model::Object object;
    object.id = id_of(built);
    object.name = object.id;
    object.parent = groups.of(built);
    object.first_body = static_cast<std::uint32_t>(model.bodies.size());
    object.body_count = 1;
    object.attributes = {{"discipline", std::string(discipline.name)},
                         {"system", std::string(kind.system)},
                         {"weight_kg", fmt::format("{:.2f}", builder.volumes_mm3()[built.shape] *
                                                                 discipline.kg_per_mm3)}};
    model.objects.push_back(std::move(object));
    model.bodies.push_back({model::ShapeId{built.shape}, 0,
                            placement_of(built.frame, options.turned), kind.color,
                            model::Category::physical});
  }
  model.shapes = builder.take_shapes();
  return model;
}

Truth assemble_truth(const ShipBuilder& builder, const std::vector<Handle>& order) {
  std::vector<std::uint32_t> place(builder.objects().size(), kNothing);
  for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  Truth truth;
  truth.reasons.assign(why_texts().begin(), why_texts().end());
  for (const DeclaredPair& pair : builder.pairs()) {
    const auto [a, b] = std::minmax(place[pair.a], place[pair.b]);
    if (b == kNothing) continue;
    truth.pairs.push_back({model::ObjectId{a}, model::ObjectId{b}, pair.cls,
                           static_cast<std::uint8_t>(pair.why), pair.d_mm});
  }
  std::sort(truth.pairs.begin(), truth.pairs.end(), [](const TruthPair& p, const TruthPair& q) {
    return std::pair(p.a, p.b) < std::pair(q.a, q.b);
  });
  for (std::uint32_t i = 0; i < order.size(); ++i)
    if (builder.objects()[order[i]].inside_out) truth.inside_out.push_back(model::ObjectId{i});
  return truth;
}

/// Leaves out shapes that no body uses any more.
void drop_unused_shapes(model::Model& model) {
  std::vector<std::uint32_t> place(model.shapes.size(), kNothing);
  std::vector<model::Shape> used;
  for (model::Body& body : model.bodies) {
    std::uint32_t& to = place[model::index(body.shape)];
    if (to == kNothing) {
      to = static_cast<std::uint32_t>(used.size());
      used.push_back(std::move(model.shapes[model::index(body.shape)]));
    }
    body.shape = model::ShapeId{to};
  }
  model.shapes = std::move(used);
}

/// Rotates a mesh and rounds it to whole micrometres again.
geometry::TriangleMesh rotated(const geometry::TriangleMesh& mesh, const geometry::Mat3d& by) {
  constexpr double kMicrometres = 1000;
  geometry::TriangleMesh result = mesh;
  for (Vec3d& vertex : result.vertices) {
    const Vec3d um = by * vertex * kMicrometres;
    vertex = {std::round(um.x) / kMicrometres, std::round(um.y) / kMicrometres,
              std::round(um.z) / kMicrometres};
  }
  return result;
}

/// Gives every eighth body a mesh of its own: its shape is rotated, which the rounding makes unlike
/// any other, and its placement rotates it back. The truth holds, since nothing moves by more than
/// a micrometre.
void make_unlike(model::Model& model, std::uint64_t seed) {
  constexpr std::size_t kEvery = 8;
  constexpr int kWidest = 40;
  for (std::size_t b = 0; b < model.bodies.size(); b += kEvery) {
    model::Body& body = model.bodies[b];
    const auto* const mesh =
        std::get_if<geometry::TriangleMesh>(&model.shapes[model::index(body.shape)]);
    if (mesh == nullptr) continue;
    Random random = Random(seed).at(61).at(b);
    const auto part = [&] { return static_cast<double>(random.between(-kWidest, kWidest)); };
    const double x = part(), y = part(), z = part();
    const geometry::Mat3d turn = rotation(kWidest, x, y, z);
    model.shapes.emplace_back(rotated(*mesh, turn));
    body.shape = model::ShapeId{static_cast<std::uint32_t>(model.shapes.size() - 1)};
    body.placement.linear = body.placement.linear * rotation(kWidest, -x, -y, -z);
  }
}

Status check(const ShipOptions& options) {
  if (options.objects < ShipOptions::kMinObjects || options.objects > ShipOptions::kMaxObjects)
    return Error{ErrorCode::usage,
                 fmt::format("a ship of {} objects cannot be built", options.objects), "--objects",
                 fmt::format("give a number from {} to {}", ShipOptions::kMinObjects,
                             ShipOptions::kMaxObjects)};
  if (options.imported_triangles < ShipOptions::kMinTriangles ||
      options.imported_triangles > ShipOptions::kMaxTriangles)
    return Error{
        ErrorCode::usage,
        fmt::format("an imported mesh of {} triangles cannot be made", options.imported_triangles),
        "--imported-triangles",
        fmt::format("give a number from {} to {}", ShipOptions::kMinTriangles,
                    ShipOptions::kMaxTriangles)};
  return {};
}

}  // namespace

Result<Ship> generate_ship(const ShipOptions& options, const parallel::Context& context) {
  if (const Status status = check(options); !status) return status.error();
  Result<ShipBuilder> builder = build_best(options, context.stop);
  if (!builder) return builder.error();
  const auto room = static_cast<std::uint64_t>(
      std::ranges::count(builder->objects(), ObjectKind::imported, &ShipObject::kind));
  if (room < options.imported_detail)
    return Error{ErrorCode::usage,
                 fmt::format("the deck of a ship of {} objects has no room for {} imported ones",
                             options.objects, options.imported_detail),
                 "--imported-detail", fmt::format("give {} at most, or more objects", room)};
  if (const Status status = builder->make_late_shapes(context.stop); !status) return status.error();
  const std::vector<bool> kept = choose_kept(*builder, options.objects);
  const std::vector<Handle> order = id_order(*builder, kept);
  Ship ship;
  ship.options = options;
  ship.model = assemble(*builder, order, options);
  ship.truth = assemble_truth(*builder, order);
  if (options.kind == ShipKind::unlike) make_unlike(ship.model, options.seed);
  drop_unused_shapes(ship.model);
  return ship;
}

namespace {

std::string_view class_text(clash::Class cls) {
  switch (cls) {
    case clash::Class::hit:
      return "HIT";
    case clash::Class::contact:
      return "CONTACT";
    case clash::Class::clearance_violation:
      return "CLEARANCE_VIOLATION";
    default:
      return "NO_HIT";
  }
}

/// Returns the settings that are not the usual ones.
std::string unusual_settings(const ShipOptions& options) {
  std::string text;
  if (options.kind != ShipKind::usual)
    text = fmt::format(", \"ship\": \"{}\"", kShipKinds[static_cast<std::size_t>(options.kind)]);
  if (options.imported_detail > 0)
    text += fmt::format(", \"imported_detail\": {}, \"imported_triangles\": {}",
                        options.imported_detail, options.imported_triangles);
  return text;
}

void write_head(const Ship& ship, fmt::memory_buffer& text) {
  std::array<std::uint64_t, 4> counts{};
  for (const TruthPair& pair : ship.truth.pairs) ++counts[static_cast<std::size_t>(pair.cls)];
  fmt::format_to(std::back_inserter(text),
                 "{{\n  \"schema_version\": 1,\n"
                 "  \"generator\": {{\"kind\": \"ship\", \"objects\": {}, \"seed\": {}, "
                 "\"turned\": {}{}}},\n"
                 "  \"settings\": {{\"clearance_mm\": {}, \"touch_gap_mm\": 1, "
                 "\"touch_overlap_mm\": 1, \"thickness_cap\": true}},\n"
                 "  \"counts\": {{\"HIT\": {}, \"CONTACT\": {}, \"CLEARANCE_VIOLATION\": {}}},\n",
                 ship.options.objects, ship.options.seed, ship.options.turned,
                 unusual_settings(ship.options), Truth::kClearanceMm, counts[3], counts[2],
                 counts[1]);
}

}  // namespace

void write_truth(const Ship& ship, std::ostream& out) {
  constexpr std::size_t kFlush = 1U << 20U;
  fmt::memory_buffer text;
  const auto flush = [&] {
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  };
  const auto id = [&](model::ObjectId object) -> const std::string& {
    return ship.model.object(object).id;  // letters, digits and dashes: nothing to escape
  };
  write_head(ship, text);
  fmt::format_to(std::back_inserter(text), "  \"inside_out\": [");
  const char* separator = "\n";
  for (const model::ObjectId object : ship.truth.inside_out) {
    fmt::format_to(std::back_inserter(text), "{}    \"{}\"", separator, id(object));
    separator = ",\n";
  }
  fmt::format_to(std::back_inserter(text), "\n  ],\n  \"pairs\": [");
  separator = "\n";
  for (const TruthPair& pair : ship.truth.pairs) {
    fmt::format_to(std::back_inserter(text),
                   "{}    {{\"a\": \"{}\", \"b\": \"{}\", \"class\": \"{}\", \"d_mm\": {}, "
                   "\"why\": \"{}\"}}",
                   separator, id(pair.a), id(pair.b), class_text(pair.cls), pair.d_mm,
                   ship.truth.reasons[pair.why]);
    separator = ",\n";
    if (text.size() > kFlush) flush();
  }
  fmt::format_to(std::back_inserter(text), "\n  ]\n}}\n");
  flush();
}

}  // namespace strake::generate
