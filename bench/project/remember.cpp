// SPDX-License-Identifier: Apache-2.0
// What it costs to remember a run of a clash test, and to have it again.
//
//     bench_project_remember [objects]  a generated ship at a clearance of 25 mm; default 100,000
//
// "first" writes the run that found everything; "again" reads it, finds that nothing changed and
// remembers that; "one moved" does the same after an object moved, whose pairs are tested again.
// Each is up to the end of the commit, with signatures, without loading and placing the model. A
// run that follows a change must come to the result of a full one, and its rows to its count.
#include "project/results/remember.hpp"

#include <fmt/core.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clocks.hpp"
#include "peer_support/work_folder.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/generate/ship.hpp"
#include "strake/parallel/team.hpp"
#include "strake/project/project.hpp"

namespace {

using namespace strake;

clash::Options options_of_run() {
  clash::Options options;
  options.tolerances.clearance_mm = 25;
  options.engine.keep_for_changes = true;
  return options;
}

/// What a project knows of a model in which nothing but places change.
class KnownPlaces {
 public:
  explicit KnownPlaces(const model::Model& model) : shapes_(model.shapes.size()) {
    constexpr std::size_t kBlock = 32768;
    for (std::size_t s = 0; s < shapes_.size(); ++s) shapes_[s] = {1, s};
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      if (b % kBlock == 0) bodies_.push_back({static_cast<std::uint32_t>(b), {}});
      const geometry::Vec3d& place = model.bodies[b].placement.translation;
      WordHash hash;
      hash.add(bodies_.back().hash).add(place.x).add(place.y).add(place.z);
      bodies_.back().hash = hash.value();
    }
  }
  [[nodiscard]] clash::KnownModel all() const { return {shapes_, bodies_, {1, 1}}; }

 private:
  std::vector<Hash128> shapes_;
  std::vector<clash::HashedBodies> bodies_;
};

/// Tests a model as `strake clash -p` does, and prints what each step took.
class Night {
 public:
  Night(project::Project& project, const parallel::Context& context)
      : project_(project), context_(context) {}

  /// Returns how many clashes appeared; `state` numbers the models, as the seal of a project does.
  Result<std::uint64_t> run(const char* what, const model::Model& model, std::uint64_t state) {
    const Result<model::Scene> scene = make_scene(model, clash::scene_options(options_), context_);
    if (!scene) return scene.error();
    const KnownPlaces known(model);
    const clash::Sets sets = clash::one_set(*scene);
    fmt::print("{}\n", what);
    clock_ = {};
    Result<std::optional<project::StoredTest>> before =
        project::read_test(project_.database(), "", context_);
    if (!before) return before.error();
    print_step("read earlier result");
    const Hash128 source =
        WordHash().add(state).add(clash::hash_of_inputs(*scene, sets, options_, {})).value();
    std::optional<project::Snapshot> made;
    if (!*before || (**before).snapshot.source != source) {
      Result<project::Snapshot> now = sign(*scene, sets, *before, source, known.all());
      if (!now) return now.error();
      made = std::move(*now);
    }
    const project::Snapshot& snapshot = made ? *made : (**before).snapshot;
    print_step("signatures");
    project::TestWork work;
    std::optional<clash::PairChanges> changes;
    const Result<clash::Report> report = test(*scene, sets, *before, snapshot, work, changes);
    if (!report) return report.error();
    print_step("clash");
    const clash::Policy policy;
    const project::TestedTest tested{&*report,
                                     &snapshot,
                                     &sets,
                                     &policy,
                                     *before ? &**before : nullptr,
                                     work,
                                     changes ? &*changes : nullptr};
    Result<project::Transaction> transaction = project::Transaction::begin(project_.database());
    if (!transaction) return transaction.error();
    const project::RunFacts facts{"2026-01-31T00:00:00Z", "bench", 1, 1};
    const Result<project::RememberedRun> remembered =
        project::remember(project_.database(), model, facts, {&tested, 1}, context_);
    if (!remembered) return remembered.error();
    print_step("remember");
    if (const Status done = transaction->commit(); !done) return done.error();
    print_step("commit");
    return remembered->trends.front().appeared;
  }

 private:
  /// Objects have the names that they had: nothing but a place changes.
  Result<project::Snapshot> sign(const model::Scene& scene, const clash::Sets& sets,
                                 const std::optional<project::StoredTest>& before,
                                 const Hash128& source, const clash::KnownModel& known) {
    clash::EarlierSignatures earlier;
    if (before) earlier = {before->snapshot.signatures, before->snapshot.ranges};
    Result<clash::Signatures> now =
        clash::signatures(scene, sets, options_, {}, context_, known, earlier);
    if (!now) return now.error();
    project::Snapshot made{now->rules,    {},     std::move(now->objects),
                           known.objects, source, std::move(now->ranges)};
    if (before) {
      made.identities = before->snapshot.identities;
      return made;
    }
    Result<std::vector<std::uint64_t>> identities = project::identities(*scene.model, context_);
    if (!identities) return identities.error();
    made.identities = std::move(*identities);
    return made;
  }
  Result<clash::Report> test(const model::Scene& scene, const clash::Sets& sets,
                             std::optional<project::StoredTest>& before,
                             const project::Snapshot& snapshot, project::TestWork& work,
                             std::optional<clash::PairChanges>& changes) {
    if (!before) return clash::detect(scene, sets, options_, {}, context_);
    if (&before->snapshot == &snapshot) {
      work.how = project::Retested::nothing;
      return std::move(before->results.report);
    }
    work.how = project::Retested::changes;
    const auto now_of = project::unchanged(before->snapshot, snapshot, context_);
    if (!now_of) return now_of.error();
    Result<clash::FollowedRun> run =
        clash::follow_changes(scene, sets, options_, {},
                              {std::move(before->results.report), *now_of,
                               project::is_same_known(before->snapshot.names, snapshot.names),
                               &*before->results.partners},
                              context_);
    if (!run) return run.error();
    before->results.report = std::move(run->earlier);
    changes = std::move(run->changes);
    return std::move(run->report);
  }
  void print_step(const char* step) { fmt::print("  {:<20} {}\n", step, clock_.text()); }

  project::Project& project_;
  const parallel::Context& context_;
  clash::Options options_ = options_of_run();
  bench::Clock clock_;
};

int fail(const Error& error) {
  fmt::print(stderr, "{}\n", error.text());
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  generate::ShipOptions options;
  options.objects = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100'000;
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team};
  const Result<generate::Ship> ship = generate::generate_ship(options, context);
  if (!ship) return fail(ship.error());
  const bench::WorkFolder folder({}, "bench_project_remember");
  Result<project::Project> project = project::Project::create(folder.path() / "ship.strake");
  if (!project) return fail(project.error());
  Night night(*project, context);
  const auto first = night.run("first", ship->model, 1);
  const auto again = night.run("again", ship->model, 1);
  model::Model moved = ship->model;
  const model::Object& object = moved.objects[moved.objects.size() / 2];
  for (std::uint32_t b = object.first_body; b < object.first_body + object.body_count; ++b)
    moved.bodies[b].placement.translation.x += 20;
  const auto after = night.run("one moved", moved, 2);
  for (const auto* const result : {&first, &again, &after})
    if (!*result) return fail(result->error());
  fmt::print("{} objects, {} clashes\n", ship->model.objects.size(), *first);
  const bool right = *first > 0 && *again == 0;
  if (!right) fmt::print(stderr, "not the clashes that there are\n");
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
