// SPDX-License-Identifier: Apache-2.0
// Reads, clashes and draws with what one header names; and some of the objects, too.
#include <array>
#include <cstdio>
#include <strake/strake.hpp>
#include <vector>

#include "two_boxes.hpp"

int main() {
  using namespace strake;
  parallel::Team team(2);
  const parallel::Context context{.team = &team};
  const std::array files{two_boxes()};
  const auto model = io::read_models(files, {.unit_mm = 1}, context);
  if (!model) return std::puts(model.error().text().c_str()), 1;
  const auto scene = model::make_scene(*model, {}, context);
  if (!scene) return 1;
  const auto report = clash::detect(*scene, clash::one_set(*scene), {}, context);
  const auto lines = hlr::draw(*scene, std::vector<bool>(2, true), {}, {}, context);
  if (!report || !lines) return 1;
  const auto one = model::Selection::parse("name = box1");
  const auto other = model::Selection::parse("name = box0");
  if (!one || !other) return 1;
  const auto in_a = model::pick(*one, *scene, context);
  const auto in_b = model::pick(*other, *scene, context);
  if (!in_a || !in_b) return 1;
  const auto between = clash::detect(*scene, {.in_a = *in_a, .in_b = *in_b}, {}, context);
  const auto alone = hlr::draw(*scene, *in_a, {}, {}, context);
  if (!between || between->pairs.size() != 1 || !alone) return 1;
  if (alone->account.of(hlr::Fate::unselected) != 1) return 1;
  const auto project = project::Project::open("two_boxes.obj", {});
  if (project || project.error().code != ErrorCode::input) return 1;
  std::printf("Strake %s: %zu pairs, %zu pieces\n", version().data(), report->pairs.size(),
              lines->pieces.size());
  return report->pairs.size() == 1 && !lines->pieces.empty() ? 0 : 1;
}
