// SPDX-License-Identifier: Apache-2.0
// A crowd of objects that a seed makes and edits.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/clash_model.hpp"
#include "support/edited_rules.hpp"
#include "support/random_primitives.hpp"

namespace strake::test {

class EditedModel {
 public:
  explicit EditedModel(std::uint64_t seed) : draw_(seed) {
    for (int i = 0; i < 24; ++i) add();
    change_rules();
  }

  std::vector<EditedObject> objects;
  /// Labels of files, by EditedObject::file; none may be another's.
  std::array<std::string, 3> labels{"a.obj", "b.obj", "c.obj"};
  EditedRules rules;

  /// Makes one to three edits.
  void edit() {
    for (std::uint64_t n = 1 + draw_.below(3); n > 0; --n) edit_once();
  }

  /// Gives a file a new name, or two files each other's: its objects stay what they are.
  void rename_files() {
    const std::size_t file = draw_.below(labels.size());
    if (draw_.one_in(4)) return std::swap(labels[file], labels[draw_.below(labels.size())]);
    // Most keep their place among the files, as revisions do.
    const char first =
        draw_.one_in(3) ? static_cast<char>('a' + draw_.below(26)) : labels[file].front();
    labels[file] = first + name() + ".obj";
  }

  /// Makes the inputs; labels are numbered anew each time.
  [[nodiscard]] EditedInputs inputs() {
    EditedInputs in;
    ClashModel built;
    built.model.files.clear();
    std::array<std::string, 3> in_order_of_labels = labels;
    std::ranges::sort(in_order_of_labels);
    for (const std::string& label : in_order_of_labels)
      built.model.files.push_back({label, "OBJ", "mm", "z", 1, 0});
    std::map<std::pair<std::uint32_t, std::string>, const EditedObject*> of;
    for (const EditedObject& o : objects) {
      const auto file = static_cast<std::uint32_t>(
          std::ranges::find(in_order_of_labels, labels[o.file]) - in_order_of_labels.begin());
      of[{file, o.id}] = &o;
      built.object(o.id);
      built.model.objects.back().file = file;
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
    for (const model::Object& o : in.model->objects) {
      in_order.push_back(of.at({o.file, o.id}));
      in.identities.push_back(std::to_string(in_order.back()->file) + "/" + o.id);
    }
    EditedRuleMaker(rules, shuffling_).make_rules(in_order, in);
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
    rules.min_volume = draw_.one_in(4);
    rules.clearance_mm = draw_.one_in(2) ? 0 : 20;
    rules.depth_mm = 2.0 + static_cast<double>(draw_.below(4));
    rules.engine.keep_for_changes = true;
    rules.engine.volumes = draw_.one_in(3) ? clash::Volumes::on : clash::Volumes::off;
    rules.engine.curves = draw_.one_in(3) ? clash::Curves::on : clash::Curves::off;
    rules.engine.contacts = draw_.one_in(2) ? clash::Contacts::count : clash::Contacts::list;
    rules.engine.max_regions = draw_.one_in(4) ? 0 : 1 + draw_.below(4);
  }

  PrimitiveDraw draw_;
  std::mt19937 shuffling_{5};
  std::uint64_t next_name_ = 0;
};

}  // namespace strake::test
