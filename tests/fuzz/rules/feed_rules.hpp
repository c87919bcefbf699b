// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "strake/rules/rules.hpp"
#include "support/clash_model.hpp"

namespace strake::test {

/// Any bytes as a rules file: tests that run over two boxes, or an error that names the file.
inline void feed_rules(std::string_view bytes) {
  static const ClashModel model = [] {
    ClashModel m;
    m.box("a", {0, 0, 0}, {100, 100, 100}).box("b", {90, 0, 0}, {200, 100, 100});
    m.model.objects[0].attributes.push_back({"UNIT", "7"});
    m.model.groups.push_back({"branch", model::GroupId::none});
    m.model.set_attributes(model::GroupId{0}, {{"HREF", "b"}, {"OBST", "1"}});
    m.model.objects[0].parent = model::GroupId{0};
    return m;
  }();
  const auto stop = [](const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
  };
  const auto rules = rules::Rules::parse(bytes, "fuzz.toml");
  if (!rules) {
    if (rules.error().where.find("fuzz.toml") == std::string::npos) stop("an error without a file");
    return;
  }
  const auto scene = model::make_scene(model.model, {}, {}).value();
  const auto plan = rules->plan(scene, {});
  if (!plan) stop("a file that was understood has no plan");
  for (const rules::PlannedTest& test : plan->tests)
    if (!clash::detect(scene, test.sets, test.options, test.policy, {}))
      stop("a test that was planned does not run");
}

}  // namespace strake::test
