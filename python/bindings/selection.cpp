// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/selection.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "strake/model/selection.hpp"

namespace strake::python {

namespace {

Result<std::vector<model::Selection>> parsed(const std::vector<std::string>& texts) {
  std::vector<model::Selection> selections;
  for (const std::string& text : texts) {
    Result<model::Selection> one = model::Selection::parse(text);
    if (!one) return one.error();
    selections.push_back(std::move(*one));
  }
  return selections;
}

Result<Picked> pick_by_text(const std::vector<std::string>& texts,
                            const std::vector<std::vector<bool>>& each, const model::Model& model) {
  const Result<std::vector<model::Selection>> selections = parsed(texts);
  if (!selections) return selections.error();
  Picked picked;
  picked.objects.resize(model.objects.size());
  for (std::size_t s = 0; s < selections->size(); ++s) {
    const std::vector<bool>& some = each[s];
    if (std::find(some.begin(), some.end(), true) == some.end())
      picked.idle.push_back(model::picks_nothing((*selections)[s], model));
    for (std::size_t o = 0; o < some.size(); ++o)
      if (some[o]) picked.objects[o] = true;
    const std::string& text = (*selections)[s].text();
    picked.name += selections->size() == 1 ? text : (s == 0 ? "(" : " or (") + text + ")";
  }
  return picked;
}

}  // namespace

Result<std::vector<std::vector<bool>>> picked_by_each(const Pick& wanted, const model::Scene& scene,
                                                      const parallel::Context& context) {
  if (wanted.selections.empty()) return std::vector<std::vector<bool>>();
  const Result<std::vector<model::Selection>> selections = parsed(wanted.selections);
  if (!selections) return selections.error();
  return model::pick(*selections, scene, context);
}

Result<Picked> pick(const Pick& wanted, const std::vector<std::vector<bool>>& each,
                    const model::Model& model) {
  const std::size_t objects = model.objects.size();
  if (!wanted.selections.empty()) return pick_by_text(wanted.selections, each, model);
  if (wanted.objects.empty()) return Picked{std::vector<bool>(objects, true), "*", {}};
  if (wanted.objects.size() != objects)
    return Error{ErrorCode::usage,
                 fmt::format("an array of {} entries does not say which of {} objects are meant",
                             wanted.objects.size(), objects),
                 {},
                 "give an entry per object, as select() returns them"};
  Picked picked{wanted.objects, {}, {}};
  const auto some = std::count(wanted.objects.begin(), wanted.objects.end(), true);
  picked.name = fmt::format("{} objects of an array", some);
  if (some == 0) picked.idle.emplace_back("no entry of the array is true");
  return picked;
}

Result<Picked> pick(const Pick& wanted, const model::Scene& scene,
                    const parallel::Context& context) {
  const auto each = picked_by_each(wanted, scene, context);
  if (!each) return each.error();
  return pick(wanted, *each, *scene.model);
}

Result<std::vector<bool>> pick_some(const Pick& wanted, const model::Scene& scene,
                                    const std::string& where, const parallel::Context& context) {
  const auto each = picked_by_each(wanted, scene, context);
  if (!each) return each.error();
  return pick_some(wanted, *each, *scene.model, where);
}

Result<std::vector<bool>> pick_some(const Pick& wanted, const std::vector<std::vector<bool>>& each,
                                    const model::Model& model, const std::string& where) {
  if (wanted.is_everything()) return std::vector<bool>();
  Result<Picked> picked = pick(wanted, each, model);
  if (!picked) return picked.error();
  if (!picked->idle.empty())
    return Error{ErrorCode::usage, picked->idle.front(), where,
                 "len(), objects tell what there is"};
  return std::move(picked->objects);
}

void append_picked(const std::vector<std::vector<bool>>& more,
                   std::vector<std::vector<bool>>& all) {
  all.resize(more.size());
  for (std::size_t s = 0; s < more.size(); ++s)
    all[s].insert(all[s].end(), more[s].begin(), more[s].end());
}

}  // namespace strake::python
