// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/writer/neutral_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "io/gltf/neutral/kept_diagnostics.hpp"
#include "io/gltf/writer/glb_json.hpp"

namespace strake::io::gltf {
namespace {

/// Attributes whose names repeat, or that are longer or more than the usual form is read, are
/// written as a list of pairs as well. A byte becomes six at most, beside quotes, colon and comma.
bool need_list(const model::Attributes& attributes) {
  constexpr std::size_t kMax = 512, kMaxOfAll = 8192, kAround = 2;
  std::set<std::string_view> names;
  std::size_t all = 0;
  for (const auto& [name, value] : attributes) all += name.size() + value.size() + kAround;
  if (all > kMaxOfAll) return true;
  return !std::ranges::all_of(attributes, [&](const auto& attribute) {
    return attribute.first.size() <= kMax && attribute.second.size() <= kMax &&
           names.insert(attribute.first).second;
  });
}

std::string_view word_of(model::Category category) {
  return category == model::Category::obstruction ? "obstruction" : "insulation";
}

/// The nodes of a document: first the frame, then groups in the order of the tree, in which they
/// are read, then objects and bodies in the order of the model; but a body that is all of its
/// object is none of its own.
class NeutralNodes {
 public:
  NeutralNodes(const model::Model& model, const NeutralPlan& plan) : model_(model), plan_(plan) {}
  std::string text();

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }
  void count_ids();
  void make_tree();
  void number_groups(std::uint32_t first_group);
  [[nodiscard]] bool is_whole(const model::Object& object) const { return object.body_count == 1; }
  void asset();
  void node_start(std::string_view name);
  void group(std::size_t index);
  void object(const model::Object& object, std::uint32_t& next_body_node);
  void facts(const model::Body& body);
  void attribute_list(const model::Attributes& attributes);

  const model::Model& model_;
  const NeutralPlan& plan_;
  std::map<std::string_view, std::size_t> repeated_;  ///< ids that objects of several files have
  /// Children of each group, then of each file where there are several.
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<std::uint32_t> roots_;
  std::vector<std::uint32_t> group_order_;  ///< numbers of groups in the order of their nodes
  std::string out_;
};

void NeutralNodes::count_ids() {
  if (model_.files.size() < 2) return;
  for (const model::Object& object : model_.objects) ++repeated_[object.id];
  std::erase_if(repeated_, [](const auto& entry) { return entry.second < 2; });
}

/// Puts nodes in the order of the source: a group comes where the first object in it does.
void NeutralNodes::make_tree() {
  const std::size_t groups = model_.groups.size(), objects = model_.objects.size();
  const bool several = model_.files.size() > 1;
  std::vector<std::uint32_t> by_place(objects);
  for (std::uint32_t i = 0; i < objects; ++i) by_place[i] = i;
  std::ranges::sort(by_place, [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(model_.objects[a].place, a) < std::pair(model_.objects[b].place, b);
  });
  const auto first_group = static_cast<std::uint32_t>(several ? 1 + model_.files.size() : 1);
  const auto first_object = static_cast<std::uint32_t>(first_group + groups);
  children_.resize(groups + (several ? model_.files.size() : 0));
  std::vector<bool> attached(groups);
  const auto top = [&](std::uint32_t file) -> std::vector<std::uint32_t>& {
    return several ? children_[groups + file] : roots_;
  };
  const auto attach = [&](std::uint32_t node, model::GroupId above, std::uint32_t file) {
    while (model::index(above) < groups) {
      const std::uint32_t at = model::index(above);
      children_[at].push_back(node);
      if (attached[at]) return;
      attached[at] = true;
      node = first_group + at;
      above = model_.groups[at].parent;
    }
    top(file).push_back(node);
  };
  for (const std::uint32_t i : by_place)
    attach(first_object + i, model_.objects[i].parent, model_.objects[i].file);
  // Groups without objects.
  for (std::uint32_t g = 0; g < groups; ++g)
    if (!attached[g]) {
      attached[g] = true;
      attach(first_group + g, model_.groups[g].parent, 0);
    }
  for (std::uint32_t file = 0; several && file < model_.files.size(); ++file)
    roots_.push_back(1 + file);
  number_groups(first_group);
}

/// Gives groups the numbers that they get where the file is read: what was read from a neutral
/// scene is written with the same bytes. Until then node `first_group + g` is group g.
void NeutralNodes::number_groups(std::uint32_t first_group) {
  const auto groups = static_cast<std::uint32_t>(model_.groups.size());
  const bool several = model_.files.size() > 1;
  const auto is_group = [&](std::uint32_t node) {
    return node >= first_group && node - first_group < groups;
  };
  std::vector<std::uint32_t> open(roots_.rbegin(), roots_.rend()), rank(groups);
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    const bool group = is_group(node);
    if (group) {
      rank[node - first_group] = static_cast<std::uint32_t>(group_order_.size());
      group_order_.push_back(node - first_group);
    }
    if (!group && (!several || node >= first_group)) continue;
    const std::vector<std::uint32_t>& below =
        children_[group ? node - first_group : groups + node - 1];
    open.insert(open.end(), below.rbegin(), below.rend());
  }
  const auto renumber = [&](std::vector<std::uint32_t>& nodes) {
    for (std::uint32_t& node : nodes)
      if (is_group(node)) node = first_group + rank[node - first_group];
  };
  std::ranges::for_each(children_, renumber);
  renumber(roots_);
}

void NeutralNodes::asset() {
  const bool ends_early =
      std::ranges::any_of(model_.files, [](const auto& file) { return file.ends_early; });
  out_ += R"({"asset":{"version":"2.0","generator":"Strake","extras":{"strake":{"scene":1)";
  if (ends_early) out_ += R"(,"ends_early":true)";
  append_diagnostics(out_, model_.diagnostics);
  out_ += "}}}";
}

void NeutralNodes::node_start(std::string_view name) {
  out_ += ",\n";
  out_ += R"({"name":)";
  append_json_string(out_, name);
}

void NeutralNodes::attribute_list(const model::Attributes& attributes) {
  out_ += R"(,"attributes":[)";
  bool first = true;
  for (const auto& [name, value] : attributes) {
    out_ += std::exchange(first, false) ? "[" : ",[";
    append_json_string(out_, name);
    out_ += ',';
    append_json_string(out_, value);
    out_ += ']';
  }
  out_ += ']';
}

void NeutralNodes::group(std::size_t index) {
  const model::Group& group = model_.groups[index];
  node_start(group.name);
  append_nodes(out_, "children", children_[index]);
  if (group.attributes != model::Group::kNoAttributes) {
    const model::Attributes& attributes = model_.group_attributes[group.attributes];
    out_ += R"(,"extras":{)";
    append_attributes(out_, attributes);
    if (need_list(attributes)) {
      out_ += R"(,"strake":{"is":"group")";
      attribute_list(attributes);
      out_ += '}';
    }
    out_ += '}';
  }
  out_ += '}';
}

/// Appends what glTF has no place for.
void NeutralNodes::facts(const model::Body& body) {
  if (body.precision_um != 0) add(R"(,"precision_um":{})", body.precision_um);
  if (body.category != model::Category::physical)
    add(R"(,"category":"{}")", word_of(body.category));
}

void NeutralNodes::object(const model::Object& object, std::uint32_t& next_body_node) {
  node_start(object.name);
  const bool whole = is_whole(object) && plan_.meshes[object.first_body] != kNoMesh;
  std::vector<std::uint32_t> bodies;
  for (std::uint32_t i = 0; !whole && i < object.body_count; ++i)
    if (plan_.meshes[object.first_body + i] != kNoMesh) bodies.push_back(next_body_node++);
  if (whole) {
    add(R"(,"mesh":{})", plan_.meshes[object.first_body]);
    append_matrix(out_, model_.bodies[object.first_body].placement);
  }
  append_nodes(out_, "children", bodies);
  out_ += R"(,"extras":{"id":)";
  const bool repeated = repeated_.contains(object.id);
  append_json_string(out_,
                     repeated ? model_.files[object.file].label + ':' + object.id : object.id);
  if (!object.attributes.empty()) {
    out_ += ',';
    append_attributes(out_, object.attributes);
  }
  out_ += R"(,"strake":{"is":"object")";
  if (whole) facts(model_.bodies[object.first_body]);
  if (object.positional_id) out_ += R"(,"positional_id":true)";
  if (object.incomplete) out_ += R"(,"incomplete":true)";
  if (need_list(object.attributes)) attribute_list(object.attributes);
  out_ += "}}}";
}

std::string NeutralNodes::text() {
  count_ids();
  make_tree();
  asset();
  // Millimetres with z up, which are exact, become the metres with y up that viewers take.
  out_ += R"(,"scene":0,"scenes":[{"name":"model","nodes":[0]}],"nodes":[)"
          "\n"
          R"({"name":"model","matrix":[0.001,0,0,0,0,0,-0.001,0,0,0.001,0,0,0,0,0,1])";
  append_nodes(out_, "children", roots_);
  out_ += R"(,"extras":{"strake":{"is":"frame"}}})";
  for (std::size_t file = 0; model_.files.size() > 1 && file < model_.files.size(); ++file) {
    node_start(model_.files[file].label);
    append_nodes(out_, "children", children_[model_.groups.size() + file]);
    out_ += '}';
  }
  for (const std::uint32_t g : group_order_) group(g);
  auto next_body_node =
      static_cast<std::uint32_t>(1 + (model_.files.size() > 1 ? model_.files.size() : 0) +
                                 model_.groups.size() + model_.objects.size());
  for (const model::Object& one : model_.objects) object(one, next_body_node);
  for (const model::Object& one : model_.objects) {
    if (is_whole(one)) continue;
    for (std::uint32_t body = one.first_body; body < one.first_body + one.body_count; ++body) {
      if (plan_.meshes[body] == kNoMesh) continue;
      add(",\n{{\"mesh\":{}", plan_.meshes[body]);
      append_matrix(out_, model_.bodies[body].placement);
      out_ += R"(,"extras":{"strake":{"is":"body")";
      facts(model_.bodies[body]);
      out_ += "}}}";
    }
  }
  out_ += ']';
  append_geometry(out_, plan_.glb);
  out_ += "}\n";
  return std::move(out_);
}

}  // namespace

std::string neutral_json(const model::Model& model, const NeutralPlan& plan) {
  return NeutralNodes(model, plan).text();
}

}  // namespace strake::io::gltf
