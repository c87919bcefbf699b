// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <tuple>
#include <utility>

#include "pictures/scenery/clash_place.hpp"
#include "pictures/scenery/scene_index.hpp"
#include "pictures/viewpoint.hpp"

namespace strake::pictures {

Result<Scenery> Scenery::of(const report::ClashContents& contents,
                            const parallel::Context& context) {
  if (contents.scene == nullptr)
    return Error{ErrorCode::usage, "a picture needs the model, and there are only results",
                 "picture", "give the model files or the project along with the results"};
  Result<SceneIndex> index = SceneIndex::of(*contents.scene, context);
  if (!index) return index.error();
  Scenery scenery;
  scenery.contents_ = &contents;
  scenery.index_ = std::make_shared<const SceneIndex>(std::move(*index));
  return scenery;
}

Subject subject_of(const clash::ResultRef& result) { return {{result}}; }

Subject subject_of(const report::ClashContents& contents, const clash::Group& group) {
  Subject subject{group.results};
  std::ranges::sort(subject.results, {}, [&](const clash::ResultRef& ref) {
    const clash::Pair& pair = pair_of(contents, ref);
    return std::tuple(-static_cast<int>(pair.cls), pair.d_mm, ref.test, ref.pair);
  });
  return subject;
}

}  // namespace strake::pictures
