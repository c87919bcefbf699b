// SPDX-License-Identifier: Apache-2.0
#include "cli/run/object_selection.hpp"

#include <cstddef>
#include <utility>

namespace strake::cli {

Result<std::vector<model::Selection>> parse_selections(const std::vector<std::string>& texts,
                                                       const std::string& option) {
  std::vector<model::Selection> selections;
  for (const std::string& text : texts) {
    auto selection = model::Selection::parse(text);
    if (!selection) {
      Error error = selection.error();
      error.where = option + ", " + error.where;
      return error;
    }
    selections.push_back(std::move(*selection));
  }
  return selections;
}

namespace {

/// Returns how to find what there is to be picked.
std::string mend_of(const model::Selection& selection) {
  if (selection.tests_attributes())
    return "'strake info --attributes' lists the attributes and their first values";
  if (selection.has_bare_pattern())
    return "a bare pattern is compared with names, ids and group/.../name paths; * stands for any "
           "text";
  return "'strake info --objects 20' lists what selections go by";
}

}  // namespace

Result<SelectedObjects> pick_all(Session& session, const model::Scene& scene,
                                 const std::vector<model::Selection>& selections) {
  SelectedObjects all;
  all.any.resize(scene.model->objects.size());
  for (const model::Selection& selection : selections) {
    const auto picked = model::pick(selection, scene, session.context());
    if (!picked) return picked.error();
    bool some = false;
    for (std::size_t o = 0; o < all.any.size(); ++o) {
      some = some || (*picked)[o];
      all.any[o] = all.any[o] || (*picked)[o];
    }
    if (!some)
      all.idle.push_back({model::picks_nothing(selection, *scene.model), mend_of(selection)});
  }
  return all;
}

Result<std::vector<bool>> pick_any(Session& session, const model::Scene& scene,
                                   const std::vector<model::Selection>& selections,
                                   const std::string& option) {
  if (selections.empty()) return std::vector<bool>();
  Result<SelectedObjects> picked = pick_all(session, scene, selections);
  if (!picked) return picked.error();
  if (!picked->idle.empty())
    return Error{ErrorCode::usage, std::move(picked->idle.front().message), option,
                 std::move(picked->idle.front().mend)};
  return std::move(picked->any);
}

}  // namespace strake::cli
