// SPDX-License-Identifier: Apache-2.0
// Random edits of a generated ship: each is told as exactly what it was, whatever the team.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "project/changes/fingerprints.hpp"
#include "strake/generate/ship.hpp"
#include "strake/parallel/team.hpp"
#include "strake/project/update.hpp"
#include "support/rounds.hpp"

namespace strake::project {
namespace {

using Random = std::mt19937_64;

constexpr auto kRounds = test::rounds<std::uint64_t>(6, 400);

std::uint8_t bits(std::initializer_list<ChangeKind> kinds) {
  std::uint8_t all = 0;
  for (const ChangeKind kind : kinds)
    all = static_cast<std::uint8_t>(all | 1U << static_cast<unsigned>(kind));
  return all;
}

/// What was done, by the id that the object has in the new model; of removed ones in the old one.
using Done = std::map<std::string, std::uint8_t>;

/// Edits objects of a model, each once.
class Editor {
 public:
  Editor(model::Model& model, Random& random) : model_(model), random_(random) {}

  void edit(model::Object& object) {
    switch (random_() % 8) {
      case 0:
        move(object);
        return note(object, {ChangeKind::moved});
      case 1:
        reshape(object);
        return note(object, {ChangeKind::reshaped});
      case 2:
        object.attributes.emplace_back("REVISION", "B");
        return note(object, {ChangeKind::reattributed});
      case 3:
        paint(object);
        return note(object, {ChangeKind::reattributed});
      case 4:
        object.id += "~new";
        return note(object, {ChangeKind::renamed});
      case 5:
        object.name += " rev B";
        move(object);
        return note(object, {ChangeKind::moved, ChangeKind::reattributed});
      case 6:
        object.id += "~new";
        paint(object);
        return note(object, {ChangeKind::renamed, ChangeKind::reattributed});
      default:
        note(object, {ChangeKind::removed});
        removed_.push_back(object.id);
    }
  }

  void add_copy(const model::Object& of, std::uint64_t number) {
    model::Object copy = of;
    copy.id += "~copy" + std::to_string(number);
    copy.first_body = static_cast<std::uint32_t>(model_.bodies.size());
    for (std::uint32_t b = 0; b < of.body_count; ++b)
      model_.bodies.push_back(model::Body(model_.bodies[of.first_body + b]));
    move(copy);
    note(copy, {ChangeKind::added});
    model_.objects.push_back(std::move(copy));
  }

  Done finish() {
    std::erase_if(model_.objects, [&](const model::Object& object) {
      return std::ranges::find(removed_, object.id) != removed_.end();
    });
    model::finish(model_);
    return std::move(done_);
  }

 private:
  void note(const model::Object& object, std::initializer_list<ChangeKind> kinds) {
    done_[object.id] = bits(kinds);
  }

  [[nodiscard]] std::span<model::Body> bodies(const model::Object& object) {
    return std::span(model_.bodies).subspan(object.first_body, std::size_t{object.body_count});
  }

  void move(const model::Object& object) {
    const double by = 1 + static_cast<double>(random_() % 100'000) / 8;
    for (model::Body& body : bodies(object)) body.placement.translation.y += by;
  }

  void reshape(const model::Object& object) {
    model::Body& body = bodies(object).front();
    const double size = 7 + static_cast<double>(random_() % 1000) / 1024;
    model_.shapes.push_back(geometry::Primitive(geometry::BoxPrimitive{size, 2 * size, size}));
    body.shape = model::ShapeId{static_cast<std::uint32_t>(model_.shapes.size() - 1)};
  }

  void paint(const model::Object& object) {
    for (model::Body& body : bodies(object)) body.color.red ^= 0x55U;
  }

  model::Model& model_;
  Random& random_;
  Done done_;
  std::vector<std::string> removed_;
};

/// Returns the objects that nothing else could be taken for, in random order.
std::vector<std::uint32_t> distinguishable(const model::Model& model, Random& random) {
  const Result<std::vector<Fingerprint>> prints = fingerprints(model, {});
  EXPECT_TRUE(prints);
  std::map<std::pair<Hash128, Hash128>, int> count;
  for (const Fingerprint& print : *prints) ++count[{print.shapes, print.places}];
  std::vector<std::uint32_t> found;
  for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
    const Fingerprint& print = (*prints)[o];
    if (model.objects[o].body_count > 0 && !model.objects[o].positional_id &&
        count[{print.shapes, print.places}] == 1)
      found.push_back(o);
  }
  std::ranges::shuffle(found, random);
  return found;
}

Done reported(const Changes& changes) {
  Done done;
  for (const ObjectChange& change : changes.objects) done[change.name().id] = change.kinds;
  return done;
}

TEST(RandomEdits, EachIsReportedAsWhatItWas) {
  parallel::Team team(4);
  const parallel::Context parallel_context{.team = &team};
  for (std::uint64_t seed = 1; seed <= kRounds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Result<generate::Ship> ship =
        generate::generate_ship({.objects = 100 + random() % 500, .seed = seed}, {});
    ASSERT_TRUE(ship);
    const model::Model& then = ship->model;
    model::Model now = then;
    const std::vector<std::uint32_t> objects = distinguishable(then, random);
    const std::size_t edits = std::min<std::size_t>(objects.size(), random() % 60);
    Editor editor(now, random);
    for (std::size_t e = 0; e < edits; ++e) {
      if (random() % 8 == 0)
        editor.add_copy(then.objects[objects[e]], e);
      else
        editor.edit(now.objects[objects[e]]);
    }
    const bool renamed_file = random() % 2 == 0;
    const Done done = editor.finish();
    if (renamed_file) now.files.front().label = "ship_revB.glb";
    Result<report::FileMatches> files = match_files(then, now, {}, {});
    ASSERT_TRUE(files);
    ASSERT_EQ(files->matches.size(), 1U);
    const Result<Changes> alone = compare(then, now, *files, {});
    const Result<Changes> together = compare(then, now, *files, parallel_context);
    ASSERT_TRUE(alone);
    ASSERT_TRUE(together);
    EXPECT_EQ(reported(*alone), done);
    EXPECT_EQ(alone->objects, together->objects);
    EXPECT_EQ(alone->unchanged, together->unchanged);
  }
}

}  // namespace
}  // namespace strake::project
