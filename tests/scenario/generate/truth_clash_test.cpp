// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/generate/ship.hpp"
#include "strake/io/reader.hpp"
#include "strake/io/writer.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace strake::generate {
namespace {

using PairKey = std::pair<std::uint32_t, std::uint32_t>;

constexpr const char* kClassNames[] = {"NO_HIT", "CLEARANCE_VIOLATION", "CONTACT", "HIT"};

const char* name_of(clash::Class cls) { return kClassNames[static_cast<std::size_t>(cls)]; }

struct Case {
  std::uint64_t objects, seed;
  bool turned;
  bool through_file = false;   ///< written as GLB and read again
  std::uint64_t imported = 0;  ///< objects that are one heavy mesh
  ShipKind kind = ShipKind::usual;
};

class TruthAgainstEngine : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const Case& c = GetParam();
    ShipOptions options{c.objects, c.seed, c.turned};
    options.imported_detail = c.imported;
    options.imported_triangles = 20'000;
    options.kind = c.kind;
    Result<Ship> made = generate_ship(options, {});
    ASSERT_TRUE(made.has_value()) << made.error().text();
    ship_ = std::move(made.value());
    if (c.through_file) read_back();
  }

  /// Replaces the model by what a reader makes of its GLB file.
  void read_back() {
    const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) /
                                       (std::string("strake_") + std::to_string(getpid()) + ".glb");
    const Status written = io::write_glb(ship_.model, path, {}, {});
    ASSERT_TRUE(written.has_value()) << written.error().text();
    const std::array<std::filesystem::path, 1> paths{path};
    Result<model::Model> model = io::read_models(paths, {}, {});
    std::filesystem::remove(path);
    ASSERT_TRUE(model.has_value()) << model.error().text();
    ASSERT_EQ(model->objects.size(), ship_.model.objects.size());
    for (std::size_t i = 0; i < model->objects.size(); ++i)
      ASSERT_EQ(model->objects[i].id, ship_.model.objects[i].id);
    ship_.model = std::move(model.value());
  }

  [[nodiscard]] clash::Report detect() const {
    parallel::Team team(2);
    parallel::Context context;
    context.team = &team;
    const clash::Options options{.tolerances = {.clearance_mm = Truth::kClearanceMm}};
    const Result<model::Scene> scene =
        model::make_scene(ship_.model, clash::scene_options(options), context);
    EXPECT_TRUE(scene.has_value());
    Result<clash::Report> report = clash::detect(*scene, clash::one_set(*scene), options, context);
    EXPECT_TRUE(report.has_value()) << report.error().text();
    return std::move(report.value());
  }

  [[nodiscard]] std::string names(const PairKey& key) const {
    return ship_.model.objects[key.first].id + " " + ship_.model.objects[key.second].id;
  }

  Ship ship_;
};

TEST_P(TruthAgainstEngine, every_pair_is_found_in_its_class_and_no_other) {
  const clash::Report report = detect();
  std::map<PairKey, const clash::Pair*> found;
  for (const clash::Pair& pair : report.pairs)
    found[{model::index(pair.a), model::index(pair.b)}] = &pair;
  std::map<std::string, std::size_t> faults;
  std::size_t shown = 0;
  const auto fault = [&](const std::string& kind, const PairKey& key, const std::string& more) {
    ++faults[kind];
    if (++shown <= 30) ADD_FAILURE() << kind << ": " << names(key) << more;
  };
  for (const TruthPair& truth : ship_.truth.pairs) {
    const PairKey key{model::index(truth.a), model::index(truth.b)};
    const std::string why(ship_.truth.reasons[truth.why]);
    const auto place = found.find(key);
    if (place == found.end()) {
      fault("missed: " + why, key, " d " + std::to_string(truth.d_mm));
      continue;
    }
    const clash::Pair& pair = *place->second;
    if (pair.cls != truth.cls)
      fault(std::string(name_of(truth.cls)) + " called " + name_of(pair.cls) + ": " + why, key,
            " truth d " + std::to_string(truth.d_mm) + " found " + std::to_string(pair.d_mm) +
                " in [" + std::to_string(pair.d_lower_mm) + ", " + std::to_string(pair.d_upper_mm) +
                "]");
    // A bracket must hold the truth; where nothing is pressed in, it is a point.
    else if (truth.d_mm < pair.d_lower_mm - 5e-3 || truth.d_mm > pair.d_upper_mm + 5e-3)
      fault("d outside its bracket: " + why, key,
            " truth d " + std::to_string(truth.d_mm) + " found " + std::to_string(pair.d_mm) +
                " in [" + std::to_string(pair.d_lower_mm) + ", " + std::to_string(pair.d_upper_mm) +
                "]");
    found.erase(place);
  }
  for (const auto& [key, pair] : found)
    fault(std::string("not in the truth: ") + name_of(pair->cls), key,
          " d " + std::to_string(pair->d_mm));
  for (const auto& [kind, count] : faults) ADD_FAILURE() << count << " x " << kind;
}

INSTANTIATE_TEST_SUITE_P(ships, TruthAgainstEngine,
                         testing::Values(Case{1000, 1, false}, Case{1000, 1, true},
                                         Case{1000, 2, false}, Case{1000, 3, false, true},
                                         Case{1000, 3, true, true}, Case{1000, 4, false, true, 3},
                                         Case{1000, 4, true, true, 3}, Case{20000, 1, false, true},
                                         Case{20000, 1, true, true},
                                         Case{3000, 1, false, false, 0, ShipKind::slender},
                                         Case{3000, 1, false, true, 0, ShipKind::dense},
                                         Case{3000, 1, true, false, 0, ShipKind::dense},
                                         Case{3000, 1, false, false, 0, ShipKind::repeated},
                                         Case{3000, 1, false, true, 0, ShipKind::unlike},
                                         Case{3000, 1, true, false, 0, ShipKind::unlike}),
                         [](const auto& test_case) {
                           const auto kind = static_cast<std::size_t>(test_case.param.kind);
                           return std::string(kShipKinds[kind]) + "_of_" +
                                  std::to_string(test_case.param.objects) + "_seed_" +
                                  std::to_string(test_case.param.seed) +
                                  (test_case.param.turned ? "_turned" : "") +
                                  (test_case.param.imported > 0 ? "_with_imported" : "") +
                                  (test_case.param.through_file ? "_through_glb" : "");
                         });

}  // namespace
}  // namespace strake::generate
