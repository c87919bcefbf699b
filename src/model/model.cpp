// SPDX-License-Identifier: Apache-2.0
#include "strake/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <new>
#include <numeric>
#include <span>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/seeded_hash.hpp"
#include "model/file_labels.hpp"
#include "model/string_sort.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::model {
namespace {

using BodyOrder = std::vector<std::uint32_t>;

// Only shares the work out.
constexpr std::size_t kObjectsPerBlock = 4096;

BodyOrder identity(std::size_t count) {
  BodyOrder order(count);
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

/// Puts the indices of all objects in the order of (file, id), equal ones as the source has them.
/// Returns true when no two objects of a file have one id.
Result<bool> sort_objects(const Model& model, BodyOrder& order, const parallel::Context& context) {
  const auto file_of = [&](std::uint32_t i) { return model.objects[i].file; };
  const auto by_file = [&](std::uint32_t a, std::uint32_t b) {
    return file_of(a) != file_of(b) ? file_of(a) < file_of(b) : a < b;
  };
  if (!std::is_sorted(order.begin(), order.end(), by_file))
    std::sort(order.begin(), order.end(), by_file);
  const auto ids = parallel::transform(
      context, {.name = "ids of objects", .n = model.objects.size(), .grain = kObjectsPerBlock},
      [&](std::size_t i) { return std::string_view(model.objects[i].id); });
  if (!ids) return ids.error();
  bool distinct = true;
  for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
    for (end = i + 1; end < order.size() && file_of(order[end]) == file_of(order[i]);) ++end;
    const auto sorted = sort_strings(*ids, std::span(order).subspan(i, end - i), context);
    if (!sorted) return sorted.error();
    distinct = *sorted && distinct;
  }
  return distinct;
}

/// Notes for each file how many ids its reader could only count.
void note_positional_ids(Model& model) {
  std::vector<std::size_t> counts(model.files.size(), 0);
  for (const Object& o : model.objects)
    if (o.positional_id && o.file < counts.size()) ++counts[o.file];
  for (std::size_t file = 0; file < counts.size(); ++file)
    if (counts[file] > 0)
      model.diagnostics.add(
          Severity::note, "object-id-positional",
          fmt::format(
              "{} no stable id (only {} position in the file); clash diff matches {} by location",
              counts[file] == 1 ? "1 object has" : fmt::format("{} objects have", counts[file]),
              counts[file] == 1 ? "its" : "their", counts[file] == 1 ? "it" : "them"),
          model.files[file].label);
}

/// Gives every repetition of an id within a file a suffix, in the order of `order`, which is
/// sorted by (file, id) with the source's order among equals.
void separate_ids(Model& model, const BodyOrder& order) {
  std::unordered_set<std::string, SeededHash> taken;
  std::uint32_t taken_of = 0;
  for (std::size_t i = 0; i < order.size();) {
    const Object& first = model.objects[order[i]];
    std::size_t end = i + 1;
    while (end < order.size() && model.objects[order[end]].file == first.file &&
           model.objects[order[end]].id == first.id)
      ++end;
    if (end - i > 1) {
      for (std::size_t k = i; k < end; ++k) model.objects[order[k]].positional_id = true;
      if (taken.empty() || taken_of != first.file) {
        taken.clear();
        taken_of = first.file;
        for (const Object& o : model.objects)
          if (o.file == taken_of) taken.insert(o.id);
      }
      std::uint32_t repeat = 1;
      for (std::size_t k = i + 1; k < end; ++k) {
        std::string id;
        do id = fmt::format("{}#{}", first.id, ++repeat);
        while (!taken.insert(id).second);
        model.objects[order[k]].id = std::move(id);
      }
      model.diagnostics.add(Severity::warning, "object-id-repeated",
                            fmt::format("{} objects share one id; all but the first gained a "
                                        "number, so runs are compared by place there",
                                        end - i),
                            fmt::format("{}: {}", model.files[first.file].label, first.id));
    }
    i = end;
  }
}

/// Puts the objects in the given order and their bodies behind each other in the same order.
Status reorder(Model& model, const BodyOrder& order, const parallel::Context& context) {
  const auto bodies_of = [&](std::size_t i) {
    const Object& object = model.objects[order[i]];
    const std::size_t first = std::min<std::size_t>(object.first_body, model.bodies.size());
    return std::span(model.bodies)
        .subspan(first, std::min<std::size_t>(object.body_count, model.bodies.size() - first));
  };
  auto bodies = parallel::count_fill<Body>(
      context, {.name = "bodies in order", .n = order.size(), .grain = kObjectsPerBlock},
      [&](std::size_t i) { return bodies_of(i).size(); },
      [&](std::size_t i, std::span<Body> out) { std::ranges::copy(bodies_of(i), out.begin()); });
  if (!bodies) return bodies.error();
  auto objects = parallel::slots<Object>(order.size(), context);
  if (!objects) return objects.error();
  const Status moved = parallel::for_each(
      context, {.name = "objects in order", .n = order.size(), .grain = kObjectsPerBlock},
      [&](std::size_t i) {
        Object& object = (*objects)[i];
        object = std::move(model.objects[order[i]]);
        object.first_body = static_cast<std::uint32_t>(bodies->offsets[i]);
        object.body_count = static_cast<std::uint32_t>((*bodies)[i].size());
      });
  if (!moved) return moved;
  model.objects = std::move(*objects);
  model.bodies = std::move(bodies->values);
  return {};
}

/// Whether reorder() would change nothing. Many programs write objects in the order of their ids,
/// and a copy of a million objects takes a fifteenth of the time of loading them.
bool is_in_order(const Model& model, const BodyOrder& order) {
  std::size_t bodies = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Object& object = model.objects[i];
    if (order[i] != i || object.first_body != bodies) return false;
    bodies += object.body_count;
  }
  return bodies == model.bodies.size();
}

/// Gives files their numbers by label, and objects their places as the source has them.
void number_by_source(Model& model) {
  for (std::uint32_t place = 0; Object & o : model.objects) o.place = place++;
  const BodyOrder renumbered = label_and_sort_files(model);
  for (Object& o : model.objects)
    if (o.file < renumbered.size()) o.file = renumbered[o.file];
}

/// Puts the objects of a numbered model in order, and separates ids that repeat.
Status arrange_objects(Model& model, const parallel::Context& context) {
  BodyOrder order = identity(model.objects.size());
  auto distinct = sort_objects(model, order, context);
  if (!distinct) return distinct.error();
  if (!*distinct) {
    separate_ids(model, order);
    distinct = sort_objects(model, order, context);
    if (!distinct) return distinct.error();
  }
  return is_in_order(model, order) ? Status{} : reorder(model, order, context);
}

/// Puts the objects of a finished model as the source has them, and takes folders off its labels.
Status take_up_again(Model& model) {
  BodyOrder order = identity(model.objects.size());
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return model.objects[a].place < model.objects[b].place;
  });
  if (!is_in_order(model, order))
    if (Status status = reorder(model, order, {}); !status) return status;
  for (SourceFile& file : model.files) file.label.erase(0, file.label.rfind('/') + 1);
  return {};
}

/// For functions that have no other way to say so: without a team and a token nothing else fails.
void throw_unless(const Status& status) {
  if (!status) throw std::bad_alloc();
}

}  // namespace

std::string_view kind_name(const Shape& shape) {
  if (const auto* const primitive = std::get_if<geometry::Primitive>(&shape))
    return geometry::kind_name(*primitive);
  return std::holds_alternative<geometry::TriangleMesh>(shape) ? "mesh" : "polylines";
}

std::vector<std::string_view> Model::group_names(const Object& object) const {
  std::vector<std::string_view> names;
  GroupId group = object.parent;
  // A chain longer than the number of groups is a cycle.
  while (group != GroupId::none && index(group) < groups.size() && names.size() < groups.size()) {
    names.push_back(groups[index(group)].name);
    group = groups[index(group)].parent;
  }
  std::reverse(names.begin(), names.end());
  return names;
}

std::string Model::path(const Object& object) const { return joined_path(group_names(object)); }

std::string unread_rest(const Model& model) {
  const SourceFile* first = nullptr;
  std::size_t more = 0;
  for (const SourceFile& file : model.files) {
    if (!file.ends_early) continue;
    if (first == nullptr)
      first = &file;
    else
      ++more;
  }
  if (first == nullptr) return {};
  if (more == 0) return fmt::format("the rest of {}, which ends early", first->label);
  return fmt::format("the rest of {} and {} more file{}, which end early", first->label, more,
                     more == 1 ? "" : "s");
}

std::string joined_path(std::span<const std::string_view> names) {
  std::string joined;
  for (std::size_t n = 0; n < names.size(); ++n) {
    if (n > 0 && !names[n].starts_with('/')) joined += '/';
    joined += names[n];
  }
  return joined;
}

Model::Stated Model::stated(const Object& object, std::string_view attribute) const {
  const auto states = [attribute](const Attributes& attributes) {
    return std::ranges::any_of(attributes, [&](const auto& a) { return a.first == attribute; });
  };
  if (states(object.attributes)) return {&object.attributes, GroupId::none};
  if (group_attributes.empty()) return {};
  GroupId at = object.parent;
  // A chain longer than the number of groups is a cycle.
  for (std::size_t steps = 0; index(at) < groups.size() && steps < groups.size(); ++steps) {
    const Group& group = groups[index(at)];
    if (group.attributes < group_attributes.size() && states(group_attributes[group.attributes]))
      return {&group_attributes[group.attributes], at};
    at = group.parent;
  }
  return {};
}

void Model::set_attributes(GroupId group, Attributes attributes) {
  if (attributes.empty()) return;
  groups[index(group)].attributes = static_cast<std::uint32_t>(group_attributes.size());
  group_attributes.push_back(std::move(attributes));
}

Status finish(Model& model, const parallel::Context& context) {
  number_by_source(model);
  note_positional_ids(model);
  return arrange_objects(model, context);
}

void finish(Model& model) { throw_unless(finish(model, {})); }

void append(Model& model, Model&& other) {
  const auto files = static_cast<std::uint32_t>(model.files.size());
  const auto groups = static_cast<std::uint32_t>(model.groups.size());
  const auto shapes = static_cast<std::uint32_t>(model.shapes.size());
  const auto bodies = static_cast<std::uint32_t>(model.bodies.size());
  const auto shifted = [groups](GroupId id) {
    return id == GroupId::none ? id : GroupId{index(id) + groups};
  };
  const auto attributes = static_cast<std::uint32_t>(model.group_attributes.size());
  for (Group& g : other.groups) {
    g.parent = shifted(g.parent);
    if (g.attributes != Group::kNoAttributes) g.attributes += attributes;
  }
  for (Object& o : other.objects) {
    o.file += files;
    o.parent = shifted(o.parent);
    o.first_body += bodies;
  }
  for (Body& b : other.bodies) b.shape = ShapeId{index(b.shape) + shapes};
  const auto move_all = [](auto& from, auto& to) {
    if (to.empty())
      to = std::move(from);
    else
      to.insert(to.end(), std::make_move_iterator(from.begin()),
                std::make_move_iterator(from.end()));
    from.clear();
  };
  move_all(other.files, model.files);
  move_all(other.groups, model.groups);
  move_all(other.group_attributes, model.group_attributes);
  move_all(other.shapes, model.shapes);
  move_all(other.objects, model.objects);
  move_all(other.bodies, model.bodies);
  model.diagnostics.append(other.diagnostics);
}

Model join(std::span<Model> models) {
  Model all;
  for (Model& model : models) {
    throw_unless(take_up_again(model));
    append(all, std::move(model));
  }
  // What finish() notes has been noted of each.
  number_by_source(all);
  throw_unless(arrange_objects(all, {}));
  return all;
}

}  // namespace strake::model
