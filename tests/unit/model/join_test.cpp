// SPDX-License-Identifier: Apache-2.0
// Finished models joined are the model that finish() makes of all their files at once.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "strake/model/model.hpp"

namespace strake::model {
namespace {

/// A file as a reader returns it: objects in the order of the source.
Model file_of(const std::string& label, const std::string& folders,
              const std::vector<std::string>& ids, bool positional = false) {
  Model model;
  SourceFile source;
  source.label = label;
  source.folders = folders;
  model.files.push_back(source);
  model.groups.push_back({"group of " + label, GroupId::none});
  for (const std::string& id : ids) {
    Object object;
    object.id = id;
    object.name = id + " of " + label;
    object.parent = GroupId{0};
    object.positional_id = positional;
    object.first_body = static_cast<std::uint32_t>(model.bodies.size());
    object.body_count = 1;
    Body body;
    body.shape = ShapeId{static_cast<std::uint32_t>(model.shapes.size())};
    body.placement.translation.x = static_cast<double>(model.bodies.size());
    model.shapes.emplace_back(geometry::Primitive(geometry::SpherePrimitive{10}));
    model.bodies.push_back(body);
    model.objects.push_back(object);
  }
  return model;
}

std::vector<Model> files() {
  return {file_of("a.obj", "x/y/", {"q", "b", "m"}), file_of("z.obj", "x/y/", {"n2", "n1"}, true),
          file_of("a.obj", "x/w/", {"m", "c", "m"})};
}

TEST(Join, IsWhatFinishMakesOfAllFiles) {
  Model whole;
  for (Model& one : files()) append(whole, std::move(one));
  finish(whole);
  // The first two have been finished together, the third one alone.
  std::vector<Model> given = files();
  append(given[0], std::move(given[1]));
  std::array<Model, 2> parts{std::move(given[0]), std::move(given[2])};
  for (Model& part : parts) finish(part);
  const Model joined = join(parts);
  ASSERT_EQ(joined.files.size(), whole.files.size());
  for (std::size_t f = 0; f < whole.files.size(); ++f)
    EXPECT_EQ(joined.files[f].label, whole.files[f].label);
  ASSERT_EQ(joined.objects.size(), whole.objects.size());
  for (std::size_t o = 0; o < whole.objects.size(); ++o) {
    const Object &x = joined.objects[o], &y = whole.objects[o];
    EXPECT_EQ(x.id, y.id);
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.file, y.file);
    EXPECT_EQ(x.place, y.place);
    EXPECT_EQ(x.positional_id, y.positional_id);
    EXPECT_EQ(joined.path(x), whole.path(y));
    EXPECT_EQ(joined.bodies[x.first_body].placement.translation.x,
              whole.bodies[y.first_body].placement.translation.x);
  }
  EXPECT_EQ(joined.diagnostics.count("object-id-positional"),
            whole.diagnostics.count("object-id-positional"));
}

TEST(Join, OfOneModelIsTheModel) {
  std::array<Model, 1> one{file_of("a.obj", "", {"b", "a"})};
  finish(one.front());
  const Model joined = join(one);
  EXPECT_EQ(joined.objects.front().id, "a");
  EXPECT_EQ(joined.objects.front().place, 1U);
}

}  // namespace
}  // namespace strake::model
