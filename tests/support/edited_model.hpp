// SPDX-License-Identifier: Apache-2.0
// A crowd of objects that a seed makes and edits, with sets and rules over them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "strake/clash/policy.hpp"
#include "support/clash_model.hpp"
#include "support/random_primitives.hpp"

namespace strake::test {

/// One body of an object.
struct EditedBody {
  model::Shape shape;
  geometry::Placement placement;
  model::Category category = model::Category::physical;
  float precision_um = 0;
};

/// An object and all that rules may know of it.
struct EditedObject {
  std::string id;
  std::uint32_t file = 0;
  std::vector<EditedBody> bodies;
  std::array<int, 2> labels{-1, -1};
  int discipline = -1;
  clash::Level level = clash::Level::hard;
  double insulation_mm = 0;
  bool in_a = true, in_b = true, incomplete = false;
  std::array<bool, 6> picks{};
  std::vector<int> refers, answers;
};

/// The kinds of rules that a test has; each has a name and a limit that may change.
struct EditedRules {
  bool matrix = false, labels = false, links = false, between = false, levels = false,
       allowed = false, by_volume = false, by_relation = false, grouped = false, named = false,
       clearances = false, list_exempted = false, reporting = false, least_volume = false;
  double clearance_mm = 20, depth_mm = 3;
  clash::EngineOptions engine;
};

/// A model as clash detection takes it.
struct EditedInputs {
  std::unique_ptr<model::Model> model = std::make_unique<model::Model>();
  model::Scene scene;
  clash::Sets sets;
  clash::Options options;
  clash::Policy policy;
};

class EditedModel {
 public:
  explicit EditedModel(std::uint64_t seed) : draw_(seed) {
    for (int i = 0; i < 24; ++i) add();
    change_rules();
  }

  std::vector<EditedObject> objects;
  EditedRules rules;

  /// Makes one to three edits.
  void edit() {
    for (std::uint64_t n = 1 + draw_.below(3); n > 0; --n) edit_once();
  }

  /// Makes the inputs; labels are numbered anew each time.
  [[nodiscard]] EditedInputs inputs() {
    EditedInputs in;
    ClashModel built;
    built.model.files.clear();
    for (const char* const label : {"a.obj", "b.obj", "c.obj"})
      built.model.files.push_back({label, "OBJ", "mm", "z", 1, 0});
    std::map<std::pair<std::uint32_t, std::string>, const EditedObject*> of;
    for (const EditedObject& o : objects) {
      of[{o.file, o.id}] = &o;
      built.object(o.id);
      built.model.objects.back().file = o.file;
      built.model.objects.back().incomplete = o.incomplete;
      for (const EditedBody& body : o.bodies) {
        built.body(body.shape, body.placement);
        built.model.bodies.back().category = body.category;
        built.model.bodies.back().precision_um = body.precision_um;
      }
    }
    finish(built.model);
    *in.model = std::move(built.model);
    std::vector<const EditedObject*> in_order;
    for (const model::Object& o : in.model->objects) in_order.push_back(of.at({o.file, o.id}));
    make_rules(in_order, in);
    model::SceneOptions scene = clash::scene_options(in.options);
    scene.obstruction = scene.insulation = true;
    in.scene = make_scene(*in.model, scene, {}).value();
    return in;
  }

  Draw& draw() { return draw_; }

 private:
  EditedBody body(const geometry::Vec3d& at) {
    EditedBody made;
    const double size = 10.0 * static_cast<double>(1 + draw_.below(6));
    const geometry::Vec3d half{size / 2, size / 2, size / 4};
    switch (draw_.below(7)) {
      case 0:
      case 1:
        made.shape = box_mesh(-half, half);
        break;
      case 2: {
        geometry::TriangleMesh open = box_mesh(-half, half);
        open.triangles.resize(open.triangles.size() - 1 - draw_.below(4));
        made.shape = open;
        break;
      }
      case 3:
        made.shape = geometry::Primitive(geometry::BoxPrimitive{size, size, size / 2});
        break;
      case 4:
        made.shape = geometry::Primitive(geometry::CylinderPrimitive{size / 3, size});
        break;
      case 5:
        made.shape = geometry::Primitive(geometry::SpherePrimitive{size});
        break;
      default:
        made.shape = geometry::Polylines{{-half, {}, half}, {0, 3}};
    }
    made.placement.translation = at;
    if (draw_.one_in(4)) made.placement.linear = PrimitiveDraw(draw_.below(3)).rotation();
    if (draw_.one_in(8)) made.category = model::Category::obstruction;
    if (draw_.one_in(8)) made.category = model::Category::insulation;
    if (draw_.one_in(10)) made.precision_um = static_cast<float>(draw_.below(2000));
    return made;
  }

  geometry::Vec3d place() {
    const auto step = [&] { return 10.0 * static_cast<double>(draw_.below(14)); };
    const double x = step(), y = step();
    return {x, y, step() / 2};
  }

  void reshape(EditedObject& o) {
    o.bodies.clear();
    const geometry::Vec3d at = place();
    for (std::uint64_t n = draw_.one_in(3) ? draw_.below(4) : 1; n > 0; --n)
      o.bodies.push_back(body(at + geometry::Vec3d{15.0 * static_cast<double>(n - 1), 0, 0}));
  }

  void attribute(EditedObject& o) {
    for (int& label : o.labels) label = static_cast<int>(draw_.below(6)) - 1;
    o.discipline = static_cast<int>(draw_.below(4)) - 1;
    o.level = static_cast<clash::Level>(draw_.below(4));
    o.insulation_mm = draw_.one_in(3) ? 5.0 * static_cast<double>(draw_.below(5)) : 0;
    o.in_a = !draw_.one_in(6);
    o.in_b = !draw_.one_in(6);
    o.incomplete = draw_.one_in(10);
    for (bool& pick : o.picks) pick = draw_.one_in(3);
    o.refers.clear();
    o.answers.clear();
    if (draw_.one_in(2)) o.refers.push_back(static_cast<int>(draw_.below(8)));
    for (std::uint64_t n = draw_.below(3); n > 0; --n)
      o.answers.push_back(static_cast<int>(draw_.below(8)));
  }

  void add() {
    EditedObject o;
    o.id = name();
    o.file = static_cast<std::uint32_t>(draw_.below(3));
    reshape(o);
    attribute(o);
    objects.push_back(std::move(o));
  }

  /// Names are never used twice, and land anywhere among the others.
  std::string name() {
    return std::to_string(draw_.below(1000)) + "-" + std::to_string(next_name_++);
  }

  void edit_once() {
    const std::uint64_t what = draw_.below(12);
    if (objects.size() < 4 || what < 2) return add();
    EditedObject& o = objects[draw_.below(objects.size())];
    switch (what) {
      case 2:
      case 3:
        std::swap(o, objects.back());
        objects.pop_back();
        break;
      case 4:
      case 5:
      case 6:
        for (EditedBody& b : o.bodies)
          b.placement.translation = b.placement.translation + geometry::Vec3d{10, 5, 0};
        break;
      case 7:
        reshape(o);
        break;
      case 8:
      case 9:
        attribute(o);
        break;
      case 10:
        o.id = name();
        break;
      default:
        if (draw_.one_in(3)) return change_rules();
        std::ranges::shuffle(objects, shuffling_);
    }
  }

  void change_rules() {
    for (bool* const rule : {&rules.matrix, &rules.labels, &rules.links, &rules.between,
                             &rules.levels, &rules.allowed, &rules.by_volume, &rules.by_relation,
                             &rules.grouped, &rules.named, &rules.clearances, &rules.list_exempted})
      *rule = draw_.one_in(2);
    rules.reporting = draw_.one_in(4);
    rules.least_volume = draw_.one_in(4);
    rules.clearance_mm = draw_.one_in(2) ? 0 : 20;
    rules.depth_mm = 2.0 + static_cast<double>(draw_.below(4));
    rules.engine.keep_for_changes = true;
    rules.engine.volumes = draw_.one_in(3) ? clash::Volumes::on : clash::Volumes::off;
    rules.engine.curves = draw_.one_in(3) ? clash::Curves::on : clash::Curves::off;
    rules.engine.contacts = draw_.one_in(2) ? clash::Contacts::count : clash::Contacts::list;
    rules.engine.most_regions = draw_.one_in(4) ? 0 : 1 + draw_.below(4);
  }

  using Objects = std::vector<const EditedObject*>;

  template <class T, class Of>
  static std::vector<T> each(const Objects& all, const Of& of) {
    std::vector<T> values;
    for (const EditedObject* const o : all) values.push_back(of(*o));
    return values;
  }
  static std::vector<bool> picked(const Objects& all, std::size_t pick) {
    return each<bool>(all, [&](const EditedObject& o) { return o.picks[pick]; });
  }

  /// Returns so many numbers in any order.
  std::vector<std::uint32_t> numbers(std::size_t n) {
    std::vector<std::uint32_t> all(n);
    std::iota(all.begin(), all.end(), 0U);
    std::ranges::shuffle(all, shuffling_);
    return all;
  }
  std::vector<Hash128> names_of(const std::vector<std::uint32_t>& numbered) const {
    std::vector<Hash128> names;
    if (!rules.named) return names;
    names.resize(numbered.size());
    for (std::size_t i = 0; i < numbered.size(); ++i) names[numbered[i]] = {7, i};
    return names;
  }

  clash::SameLabel same_label(const Objects& all, std::size_t which) {
    const std::vector<std::uint32_t> numbered = numbers(5);
    return {each<std::uint32_t>(all,
                                [&](const EditedObject& o) {
                                  const int label = o.labels[which];
                                  return label < 0 ? clash::kNoLabel
                                                   : numbered[static_cast<std::size_t>(label)];
                                }),
            names_of(numbered)};
  }

  clash::Linked linked(const Objects& all) {
    const std::vector<std::uint32_t> numbered = numbers(8);
    clash::Linked links{{{0}, {}}, {{0}, {}}, names_of(numbered)};
    const auto append = [&](clash::Linked::Lists& lists, const std::vector<int>& of) {
      std::vector<std::uint32_t> own;
      for (const int n : of) own.push_back(numbered[static_cast<std::size_t>(n)]);
      std::ranges::sort(own);
      own.erase(std::unique(own.begin(), own.end()), own.end());
      lists.numbers.insert(lists.numbers.end(), own.begin(), own.end());
      lists.first.push_back(static_cast<std::uint32_t>(lists.numbers.size()));
    };
    for (const EditedObject* const o : all) {
      append(links.refers_to, o->refers);
      append(links.answers_to, o->answers);
    }
    return links;
  }

  void make_rules(const Objects& all, EditedInputs& in) {
    clash::Options& options = in.options;
    options.engine = rules.engine;
    options.tolerances.clearance_mm = rules.clearance_mm;
    if (rules.clearances) {
      clash::ObjectClearances own{
          "INSU", each<double>(all, [](const EditedObject& o) { return o.insulation_mm; })};
      options.tolerances.object_clearances = std::make_shared<clash::ObjectClearances>(own);
    }
    if (rules.reporting)
      options.reporting.relations = {clash::Relation::separate, clash::Relation::interfere,
                                     clash::Relation::a_in_b};
    if (rules.least_volume) options.reporting.min_volume_mm3 = 500;
    in.sets.in_a = each<bool>(all, [](const EditedObject& o) { return o.in_a; });
    in.sets.in_b = each<bool>(all, [](const EditedObject& o) { return o.in_b; });
    if (rules.grouped) {
      const std::vector<std::uint32_t> numbered = numbers(3);
      in.sets.group =
          each<std::uint32_t>(all, [&](const EditedObject& o) { return numbered[o.file]; });
      in.sets.group_names = names_of(numbered);
    }
    clash::Policy& policy = in.policy;
    policy.list_exempted = rules.list_exempted;
    if (rules.matrix) make_matrix(all, policy);
    if (rules.labels)
      for (const std::size_t which : {0U, 1U})
        policy.exemptions.push_back({"label " + std::to_string(which), same_label(all, which)});
    if (rules.links) policy.exemptions.push_back({"links", linked(all)});
    if (rules.between)
      for (const std::size_t pick : {0U, 1U})
        policy.exemptions.push_back({"between " + std::to_string(pick),
                                     clash::Between{picked(all, pick), picked(all, pick + 1)}});
    if (rules.levels) make_levels(all, policy);
    if (rules.allowed) make_allowed(all, policy);
  }

  static void make_matrix(const Objects& all, clash::Policy& policy) {
    policy.tolerances.push_back({.clearance_mm = 40});
    clash::Matrix m;
    m.disciplines = {"hull", "pipe", "cable"};
    m.discipline = each<std::uint32_t>(
        all, [](const EditedObject& o) { return static_cast<std::uint32_t>(o.discipline); });
    constexpr std::uint32_t kUsual = clash::Matrix::kDefault, kNone = clash::Matrix::kNotChecked;
    m.cells = {kUsual, 0, kNone, 0, kUsual, 0, kNone, 0, kUsual};
    policy.matrix = m;
  }

  static void make_levels(const Objects& all, clash::Policy& policy) {
    clash::Levels levels;
    levels.object = each<clash::Level>(all, [](const EditedObject& o) { return o.level; });
    levels.left_out[1][2] = levels.left_out[2][1] = "soft and insulation";
    policy.levels = levels;
  }

  static clash::Allowed allowance(const char* rule, const Objects& all, std::size_t pick) {
    clash::Allowed allowed;
    allowed.rule = rule;
    allowed.a = picked(all, pick);
    allowed.b = picked(all, pick + 1);
    return allowed;
  }

  void make_allowed(const Objects& all, clash::Policy& policy) const {
    clash::Allowed deep = allowance("deep", all, 2);
    deep.max_depth_mm = rules.depth_mm;
    clash::Allowed here = allowance("here", all, 3);
    here.region_mm = geometry::Box3d{{0, 0, 0}, {90, 90, 90}};
    clash::Allowed rest = allowance("rest", all, 4);
    if (rules.by_volume) rest.max_volume_mm3 = 2000;
    if (rules.by_relation)
      deep.relations = {clash::Relation::abut_outside, clash::Relation::interfere};
    rest.max_depth_mm = 8;
    policy.allowed = {deep, here, rest, deep};
    policy.allowed.back().rule = "deep again";
  }

  PrimitiveDraw draw_;
  std::mt19937 shuffling_{5};
  std::uint64_t next_name_ = 0;
};

}  // namespace strake::test
