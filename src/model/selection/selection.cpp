// SPDX-License-Identifier: Apache-2.0
#include "strake/model/selection.hpp"

#include <utility>

#include "model/selection/evaluate.hpp"
#include "model/selection/parser.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::model {

Result<Selection> Selection::parse(std::string_view text) {
  const auto none = [](std::string_view name) -> Result<Selection> {
    return Error{ErrorCode::usage,
                 "no set is called '" + std::string(name) + "'",
                 {},
                 "named sets are known in a rules file"};
  };
  return parse(text, none);
}

Result<Selection> Selection::parse(std::string_view text, SetLookup set) {
  using QueryPointer = std::shared_ptr<const selection::Query>;
  const auto lookup = [&](std::string_view name) -> Result<QueryPointer> {
    const Result<Selection> found = set(name);
    if (!found) return found.error();
    return found->query_;
  };
  Result<selection::Query> query = selection::parse_query(text, lookup);
  if (!query) return query.error();
  return Selection(std::make_shared<const selection::Query>(std::move(*query)));
}

const std::string& Selection::text() const { return query_->text; }

bool Selection::picks(const Scene& scene, ObjectId object) const {
  return selection::answers(*query_, scene, object);
}

Result<std::vector<std::uint8_t>> pick(const Selection& selection, const Scene& scene,
                                       const parallel::Context& context) {
  constexpr std::size_t kGrain = 256;
  return parallel::transform(
      context, {.name = "selection", .n = scene.model->objects.size(), .grain = kGrain},
      [&](std::size_t i) -> std::uint8_t {
        return selection.picks(scene, static_cast<ObjectId>(i)) ? 1 : 0;
      });
}

}  // namespace strake::model
