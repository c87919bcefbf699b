// SPDX-License-Identifier: Apache-2.0
#include "strake/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
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
#include "strake/parallel/find.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::model {
namespace {

using BodyOrder = std::vector<std::uint32_t>;

// Only shares the work out.
constexpr std::size_t kObjectsPerBlock = 4096;

/// Returns the indices of all objects by file, those of a file as the source has them.
Result<BodyOrder> order_by_file(const Model& model, const parallel::Context& context) {
  const std::size_t count = model.objects.size();
  Result<BodyOrder> order = parallel::unset_slots<std::uint32_t>(count);
  if (!order) return order;
  const Status numbered = parallel::for_each(
      context, {.name = "objects as they stand", .n = count, .grain = kObjectsPerBlock},
      [&](std::size_t i) { (*order)[i] = static_cast<std::uint32_t>(i); });
  if (!numbered) return numbered.error();
  const auto file_of = [&](std::size_t i) { return model.objects[i].file; };
  const auto ascending =
      parallel::all_of(context, {.name = "files of objects", .n = count, .grain = kObjectsPerBlock},
                       [&](std::size_t i) { return i == 0 || file_of(i - 1) <= file_of(i); });
  if (!ascending) return ascending.error();
  if (!*ascending)
    std::ranges::sort(*order, [&](std::uint32_t a, std::uint32_t b) {
      return file_of(a) != file_of(b) ? file_of(a) < file_of(b) : a < b;
    });
  return order;
}

/// Puts the indices of all objects, which are ordered by file, in the order of (file, id), equal
/// ones as they stand. Returns true when no two objects of a file have one id.
Result<bool> sort_objects(const Model& model, BodyOrder& order, const parallel::Context& context) {
  const auto file_of = [&](std::uint32_t i) { return model.objects[i].file; };
  const auto ids = parallel::transform(
      context, {.name = "ids of objects", .n = model.objects.size(), .grain = kObjectsPerBlock},
      [&](std::size_t i) { return std::string_view(model.objects[i].id); });
  if (!ids) return ids.error();
  bool distinct = true;
  for (auto first = order.begin(), last = first; first != order.end(); first = last) {
    last = std::partition_point(first, order.end(), [&, file = file_of(*first)](std::uint32_t i) {
      return file_of(i) == file;
    });
    const auto sorted = sort_strings(*ids, std::span(first, last), context);
    if (!sorted) return sorted.error();
    distinct = *sorted && distinct;
  }
  return distinct;
}

/// Notes for each file how many ids its reader could only count.
void note_positional_ids(Model& model, std::span<const std::size_t> counts) {
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
  parallel::clear(model.objects, context);
  model.objects = std::move(*objects);
  model.bodies = std::move(bodies->values);
  return {};
}

/// Whether reorder() would change nothing. Many programs write objects in the order of their ids,
/// and a copy of a million objects takes a fifteenth of the time of loading them.
Result<bool> is_in_order(const Model& model, const BodyOrder& order,
                         const parallel::Context& context) {
  const auto bodies_before = [&](std::size_t i) -> std::size_t {
    if (i == 0) return 0;
    return std::size_t{model.objects[i - 1].first_body} + model.objects[i - 1].body_count;
  };
  if (bodies_before(order.size()) != model.bodies.size()) return false;
  return parallel::all_of(
      context, {.name = "objects in order", .n = order.size(), .grain = kObjectsPerBlock},
      [&](std::size_t i) {
        return order[i] == i && model.objects[i].first_body == bodies_before(i);
      });
}

Status reorder_if_needed(Model& model, const BodyOrder& order, const parallel::Context& context) {
  const Result<bool> in_order = is_in_order(model, order, context);
  if (!in_order) return in_order.error();
  return *in_order ? Status{} : reorder(model, order, context);
}

/// Gives files their numbers by label, and objects their places as the source has them. Returns for
/// each file how many ids its reader could only count.
Result<std::vector<std::size_t>> number_by_source(Model& model, const parallel::Context& context) {
  const BodyOrder renumbered = label_and_sort_files(model);
  // Each block has counts of its own, so that there are few, and long ones.
  constexpr std::size_t kMaxBlocks = 64;
  const std::size_t count = model.objects.size();
  using Counts = std::vector<std::size_t>;
  return parallel::reduce(
      context,
      {.name = "objects numbered",
       .n = count,
       .grain = std::max(kObjectsPerBlock, (count + kMaxBlocks - 1) / kMaxBlocks)},
      Counts(model.files.size()),
      [&](Counts& positional, std::size_t i) {
        Object& o = model.objects[i];
        o.place = static_cast<std::uint32_t>(i);
        if (o.file >= renumbered.size()) return;
        o.file = renumbered[o.file];
        if (o.positional_id) ++positional[o.file];
      },
      [](Counts& into, const Counts& of_block) {
        std::ranges::transform(into, of_block, into.begin(), std::plus{});
      });
}

/// Puts the objects of a numbered model in order, and separates ids that repeat.
Status arrange_objects(Model& model, const parallel::Context& context) {
  Result<BodyOrder> order = order_by_file(model, context);
  if (!order) return order.error();
  auto distinct = sort_objects(model, *order, context);
  if (!distinct) return distinct.error();
  if (!*distinct) {
    separate_ids(model, *order);
    order = order_by_file(model, context);
    if (!order) return order.error();
    distinct = sort_objects(model, *order, context);
    if (!distinct) return distinct.error();
  }
  return reorder_if_needed(model, *order, context);
}

/// Puts the objects of a finished model as the source has them, and takes folders off its labels.
Status take_up_again(Model& model) {
  BodyOrder order(model.objects.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return model.objects[a].place < model.objects[b].place;
  });
  if (Status status = reorder_if_needed(model, order, {}); !status) return status;
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
  const Result<std::vector<std::size_t>> positional = number_by_source(model, context);
  if (!positional) return positional.error();
  note_positional_ids(model, *positional);
  return arrange_objects(model, context);
}

void finish(Model& model) { throw_unless(finish(model, {})); }

void clear(Model& model, const parallel::Context& context) {
  parallel::clear(model.objects, context);
  parallel::clear(model.groups, context);
  parallel::clear(model.group_attributes, context);
  parallel::clear(model.shapes, context);
  model = {};
}

void append(Model& model, Model&& other) {
  const auto files = static_cast<std::uint32_t>(model.files.size());
  const auto groups = static_cast<std::uint32_t>(model.groups.size());
  const auto shapes = static_cast<std::uint32_t>(model.shapes.size());
  const auto bodies = static_cast<std::uint32_t>(model.bodies.size());
  const auto shifted = [groups](GroupId id) {
    return id == GroupId::none ? id : GroupId{index(id) + groups};
  };
  const auto attributes = static_cast<std::uint32_t>(model.group_attributes.size());
  // What a model begins with keeps its numbers: most have one file.
  if (groups > 0 || attributes > 0)
    for (Group& g : other.groups) {
      g.parent = shifted(g.parent);
      if (g.attributes != Group::kNoAttributes) g.attributes += attributes;
    }
  if (files > 0 || groups > 0 || bodies > 0)
    for (Object& o : other.objects) {
      o.file += files;
      o.parent = shifted(o.parent);
      o.first_body += bodies;
    }
  if (shapes > 0)
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
  if (const auto numbered = number_by_source(all, {}); !numbered) throw_unless(numbered.error());
  throw_unless(arrange_objects(all, {}));
  return all;
}

}  // namespace strake::model
