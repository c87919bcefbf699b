// SPDX-License-Identifier: Apache-2.0
#include "strake/model/selection.hpp"

#include <utility>

#include "model/selection/evaluate.hpp"
#include "model/selection/parser.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::model {

Result<Selection> Selection::parse(std::string_view text) {
  Result<selection::Query> query = selection::parse_query(text);
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
