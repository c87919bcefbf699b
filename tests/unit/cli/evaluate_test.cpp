// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/evaluate/cases.hpp"
#include "cli/evaluate/compare.hpp"
#include "cli/evaluate/evaluation.hpp"
#include "cli/evaluate/measure.hpp"
#include "cli/evaluate/pages/bar_chart.hpp"
#include "cli/evaluate/pages/pages.hpp"
#include "cli/evaluate/pages/tables.hpp"
#include "cli/evaluate/published/sheet_pixels.hpp"
#include "cli/evaluate/record_json.hpp"
#include "cli/evaluate/statistics.hpp"
#include "cli/evaluate/studies/loose_octree.hpp"
#include "cli/evaluate/studies/object_boxes.hpp"
#include "cli/evaluate/studies/region_times.hpp"
#include "cli/evaluate/studies/study_runs.hpp"
#include "cli/evaluate/time_limit.hpp"
#include "strake/clash/clash.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/report.hpp"

namespace strake::cli {
namespace {

ContenderRecord contender(std::string name, unsigned threads, std::vector<double> seconds) {
  ContenderRecord one;
  one.name = std::move(name);
  one.threads = threads;
  one.seconds = std::move(seconds);
  one.counters = {{"face tests", 1000}};
  one.hash = "abc";
  one.published_hash = "def";
  return one;
}

/// A case of one stage that took 2 s, twice, and 1.1 s on two threads.
CaseRecord example_case(std::string name, std::string stage) {
  CaseRecord one;
  one.name = std::move(name);
  one.title = "A case | with a bar & <marks>";
  one.objects = 10;
  StageRecord measured;
  measured.name = std::move(stage);
  measured.reference_s = 0.1;
  measured.contenders = {contender(kSequential, 1, {2, 2.1, 1.9}),
                         contender(kAgain, 1, {2, 2.1, 1.9}), contender(kOurs, 2, {1.0, 1.2, 1.1})};
  parallel::RegionReport region;
  region.name = "edges";
  region.runs = 1;
  region.wall_s = 1.0;
  region.busy_s = {1.0, 0.9};
  region.share_s = 0.95;
  region.least_s = 0.95;
  measured.contenders.back().regions = {region};
  measured.contenders.back().shared_wall_s = 1.0;
  one.stages.push_back(std::move(measured));
  return one;
}

EvaluationRecord example() {
  EvaluationRecord record;
  record.settings.threads = {1, 2};
  record.machine.processor = "a processor";
  record.cases = {example_case("iso", "global"), example_case("dense", "clash")};
  record.studies = {{"distribution",
                     "Ranges",
                     "Which?",
                     {"Stage", "s"},
                     {{"clash", "1.5"}},
                     {{"busy", "s", {"worker 1", "worker 2"}, {{"ranges", {0.5, 1}}}, {{"x", 1}}}},
                     {}}};
  return record;
}

Contender fake(std::string name, const std::string& hash) {
  Contender one;
  one.name = std::move(name);
  one.compute = [hash](const parallel::Context&) -> Result<Computed> {
    return Computed{
        {},
        [hash] { return hash; },
        [hash](const parallel::Context&) -> Result<Published> { return Published{hash}; }};
  };
  return one;
}

TEST(Evaluate, SpeedupBalanceAndSerialShareAreThoseOfTheRuns) {
  const EvaluationRecord record = example();
  const auto s = speedup_of(record.cases[0].stages[0], 2);
  ASSERT_TRUE(s.has_value());
  EXPECT_DOUBLE_EQ(s->sequential_s, 2.0);
  EXPECT_DOUBLE_EQ(s->parallel_s, 1.1);
  EXPECT_NEAR(s->speedup, 2.0 / 1.1, 1e-12);
  EXPECT_NEAR(s->load_balance, 1.9 / 2.0, 1e-12);
  EXPECT_EQ(s->worst_region, "edges");
  EXPECT_NEAR(s->serial_share, 0.1 / 2.0, 1e-12);
  EXPECT_NEAR(s->amdahl, 1 / (0.05 + 0.95 / 2), 1e-12);
  EXPECT_NEAR(s->bound, 2.0 / (0.1 + 0.95), 1e-12);
  EXPECT_FALSE(speedup_of(record.cases[0].stages[0], 4).has_value());
}

TEST(Evaluate, TimeAloneBoundsTheSpeedupOnABusyMachineToo) {
  EvaluationRecord record = example();
  ContenderRecord& ours = record.cases[0].stages[0].contenders.back();
  ours.cpu_s = 2;
  ours.alone_s = 0.2;
  ours.kernel_alone_s = {1.9, 2.0, 2.1};
  ours.kernel_s = {1.3, 1.25, 1.2};
  const auto s = speedup_of(record.cases[0].stages[0], 2);
  ASSERT_TRUE(s.has_value());
  EXPECT_DOUBLE_EQ(s->alone_s, 0.2);
  EXPECT_NEAR(s->by_cpu, 2 / (0.2 + 1.8 / 2), 1e-12);
  EXPECT_NEAR(s->machine, 2 / 1.25, 1e-12);
  const std::string text = evaluation_markdown(record);
  EXPECT_NE(text.find("| Machine |"), std::string::npos);
  EXPECT_NE(text.find("| 1.82 | 1.60 |"), std::string::npos) << text;
  // Nothing was measured, or nothing of it noted.
  EXPECT_EQ(speedup_of(record.cases[1].stages[0], 2)->machine, 0);
  EXPECT_EQ(speedup_of(record.cases[1].stages[0], 2)->by_cpu, 0);
}

TEST(Evaluate, ATeamIsMeasuredBesideWorkThatIsSharedPerfectly) {
  EvaluationSettings settings;
  settings.threads = {1, 2};
  settings.repeat = 2;
  std::vector<Contender> contenders{fake(kSequential, "a"), fake(kAgain, "a"), fake(kOurs, "a")};
  contenders.back().threads = 2;
  contenders.back().compute = [](const parallel::Context& context) -> Result<Computed> {
    // So much is the calling thread's alone.
    volatile double sum = 0;
    for (const double start = parallel::thread_cpu_s(); parallel::thread_cpu_s() < start + 0.02;)
      sum = sum + 1;
    const Status status = parallel::for_each(context, {.name = "loop", .n = 1000}, [](std::size_t) {
      for (const double start = parallel::thread_cpu_s();
           parallel::thread_cpu_s() < start + 0.0001;)
        continue;
    });
    if (!status) return status.error();
    return Computed{{},
                    [] { return std::string("a"); },
                    [](const parallel::Context&) -> Result<Published> { return Published{"a"}; }};
  };
  const auto stage = measure_stage("global", contenders, settings, {}, [](const std::string&) {});
  ASSERT_TRUE(stage.has_value()) << stage.error().text();
  const ContenderRecord& ours = stage->contenders.back();
  EXPECT_EQ(ours.kernel_s.size(), 2 * ours.seconds.size()) << "before and after each round";
  EXPECT_EQ(ours.kernel_alone_s.size(), ours.kernel_s.size());
  EXPECT_GT(*std::ranges::min_element(ours.kernel_s), 0);
  EXPECT_GE(ours.alone_s, 0.0199);
  EXPECT_LT(ours.alone_s, 0.02 + 0.04) << "of 0.1 s in the loop at most a part is the caller's";
  for (const ContenderRecord& one : stage->contenders)
    if (one.threads == 1) {
      EXPECT_TRUE(one.kernel_s.empty()) << one.name;
    }
}

TEST(Evaluate, ARecordOfBeforeLacksWhatCameLater) {
  nlohmann::json document = nlohmann::json::parse(evaluation_json(example()));
  for (nlohmann::json& one : document["cases"])
    for (nlohmann::json& stage : one["stages"])
      for (nlohmann::json& run : stage["contenders"])
        for (const char* const name : {"alone_s", "kernel_alone_s", "kernel_s"}) run.erase(name);
  document.erase("peers");
  const auto read = parse_evaluation(document.dump(), "x");
  ASSERT_TRUE(read.has_value()) << read.error().text();
  EXPECT_EQ(evaluation_json(*read), evaluation_json(example()));
}

TEST(Evaluate, SpreadIsThatOfASample) {
  const std::vector<double> values{1, 2, 3, 4};
  const Spread spread = spread_of(values);
  EXPECT_DOUBLE_EQ(spread.mean, 2.5);
  EXPECT_NEAR(spread.deviation, std::sqrt(5.0 / 3.0), 1e-12);
  EXPECT_DOUBLE_EQ(spread.least, 1);
  EXPECT_DOUBLE_EQ(spread.greatest, 4);
  EXPECT_EQ(spread_of(std::vector<double>{}).count, 0U);
}

TEST(Evaluate, NoiseIsHowFarTheSameContenderIsApart) {
  StageRecord stage;
  stage.contenders = {contender(kSequential, 1, {1.0}), contender(kAgain, 1, {1.1})};
  EXPECT_NEAR(timing_noise(stage), 0.1, 1e-12);
}

TEST(Evaluate, ARecordComesBackFromItsJson) {
  const EvaluationRecord record = example();
  const std::string text = evaluation_json(record);
  const auto read = parse_evaluation(text, "x");
  ASSERT_TRUE(read.has_value()) << read.error().text();
  EXPECT_EQ(evaluation_json(*read), text);
}

TEST(Evaluate, ADamagedRecordIsAnError) {
  const std::string text = evaluation_json(example());
  for (const std::size_t size : {std::size_t{0}, text.size() / 3, text.size() - 4})
    EXPECT_FALSE(parse_evaluation(text.substr(0, size), "x").has_value()) << size;
  EXPECT_FALSE(parse_evaluation("[]", "x").has_value());
  EXPECT_FALSE(parse_evaluation(R"({"schema_version": 2})", "x").has_value());
  std::string wrong = text;
  wrong.replace(wrong.find("\"threads\""), 9, "\"threats\"");
  EXPECT_FALSE(parse_evaluation(wrong, "x").has_value());
}

TEST(Evaluate, MoreWorkIsNamedAndLessIsNot) {
  const EvaluationRecord before = example();
  EvaluationRecord now = example();
  now.cases[0].stages[0].contenders[0].counters["face tests"] = 1200;
  now.cases[1].stages[0].contenders[0].counters["face tests"] = 500;
  const auto comparison = compare_evaluations(before, now);
  ASSERT_TRUE(comparison.has_value());
  EXPECT_EQ(comparison->more_work,
            std::vector<std::string>{"iso, global: face tests 1000 -> 1200 (+20.0 %)"});
  EXPECT_EQ(comparison->less_work.size(), 1U);
  EXPECT_TRUE(comparison->slower.empty());
  now.settings.scale = 2;
  EXPECT_FALSE(compare_evaluations(before, now).has_value());
}

TEST(Evaluate, TimesAreComparedAsRatiosToTheReferenceKernel) {
  const EvaluationRecord before = example();
  EvaluationRecord now = example();
  // A machine of half the speed is no slower program.
  for (CaseRecord& one : now.cases) {
    one.stages[0].reference_s *= 2;
    for (ContenderRecord& run : one.stages[0].contenders)
      for (double& s : run.seconds) s *= 2;
  }
  EXPECT_TRUE(compare_evaluations(before, now)->slower.empty());
  for (double& s : now.cases[0].stages[0].contenders[0].seconds) s *= 1.3;
  for (double& s : now.cases[0].stages[0].contenders[1].seconds) s *= 1.3;
  EXPECT_EQ(compare_evaluations(before, now)->slower.size(), 1U);
}

TEST(Evaluate, ACaseThatIsMissingIsNamed) {
  EvaluationRecord now = example();
  now.cases.pop_back();
  EXPECT_EQ(compare_evaluations(example(), now)->missing, std::vector<std::string>{"dense"});
}

TEST(Evaluate, PagesEscapeWhatTheyShow) {
  const EvaluationRecord record = example();
  const std::string html = evaluation_html(record);
  EXPECT_EQ(html.find("<marks>"), std::string::npos);
  EXPECT_NE(html.find("&lt;marks&gt;"), std::string::npos);
  EXPECT_NE(html.find("2.911"), std::string::npos) << "the thesis's figures stand beside";
  EXPECT_NE(html.find("All 4 results"), std::string::npos) << "the first of each is none of them";
  EXPECT_NE(evaluation_markdown(record).find("A case \\| with a bar"), std::string::npos);
  EXPECT_NE(evaluation_csv(record).find("iso,10,0,0,global,\"sequential, again\",1,3,2,1.9"),
            std::string::npos)
      << evaluation_csv(record);
}

TEST(Evaluate, ADifferenceStandsOnThePage) {
  EvaluationRecord record = example();
  record.cases[0].stages[0].differences = {"the result differs"};
  EXPECT_EQ(differences_of(record).size(), 1U);
  EXPECT_NE(evaluation_html(record).find(">NO<"), std::string::npos);
  EXPECT_NE(evaluation_markdown(record).find("1 results differ"), std::string::npos);
}

TEST(Evaluate, AChartOfAStudyStandsWithItsTable) {
  const EvaluationRecord record = example();
  EXPECT_NE(evaluation_html(record).find("busy"), std::string::npos);
  EXPECT_NE(evaluation_markdown(record).find("(chart-distribution-1.svg)"), std::string::npos);
}

TEST(Evaluate, NoTwoCasesShareAName) {
  std::set<std::string> names;
  for (const CaseGroup& group : case_groups()) {
    EXPECT_TRUE(names.insert(group.name).second) << group.name;
    for (const std::string& name : group.cases) EXPECT_TRUE(names.insert(name).second) << name;
  }
}

/// Returns a region of a team whose workers were busy for so long.
parallel::RegionReport region_of(std::string name, std::vector<double> busy_s, double longest_s) {
  parallel::RegionReport region;
  region.name = std::move(name);
  region.runs = 1;
  region.items = 10;
  region.busy_s = std::move(busy_s);
  region.longest_s = longest_s;
  region.share_s = region.total_busy_s() / static_cast<double>(region.busy_s.size());
  region.least_s = std::max(region.share_s, longest_s);
  return region;
}

TEST(Evaluate, RegionsOfATeamAddUpByWorker) {
  std::vector<parallel::RegionReport> regions{region_of("a", {1, 3}, 2), region_of("b", {2, 1}, 1)};
  parallel::RegionReport nested;
  nested.nested_runs = 5;
  nested.nested_cpu_s = 100;
  regions.push_back(nested);
  const parallel::RegionReport whole = merged_report(regions);
  EXPECT_EQ(whole.busy_s, (std::vector<double>{3, 4}));
  EXPECT_EQ(whole.items, 20U);
  EXPECT_DOUBLE_EQ(whole.load_balance(), 3.5 / 4);
  EXPECT_DOUBLE_EQ(whole.longest_s, 2);
  EXPECT_DOUBLE_EQ(whole.bound(), 1);
  EXPECT_EQ(longest_of(regions).name, "a");
  EXPECT_EQ(region_named(regions, "b").busy_s, (std::vector<double>{2, 1}));
  EXPECT_TRUE(region_named(regions, "c").name.empty());
  const std::vector<std::string_view> names{"b", "c"};
  EXPECT_EQ(merged_report(regions, names).busy_s, (std::vector<double>{2, 1}));
  EXPECT_EQ(cells_of(regions[0]).front(), "1.000");
  EXPECT_EQ(cells_of(regions[0]).size(), region_columns().size());
  EXPECT_EQ(cells_of(regions[2]).front(), "-");
  EXPECT_TRUE(merged_report({}).busy_s.empty());
  EXPECT_TRUE(longest_of({}).name.empty());
}

/// Returns boxes of very unequal size, some of them empty, points, or alike.
std::vector<geometry::Box3l> uneven_boxes(unsigned seed) {
  std::minstd_rand random(seed);
  const auto up_to = [&](std::int64_t most) {
    return static_cast<std::int64_t>(random()) % (most + 1);
  };
  std::vector<geometry::Box3l> boxes;
  for (int i = 0; i < 400; ++i) {
    geometry::Box3l box;
    const std::int64_t longest = std::int64_t{1} << up_to(24);
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = up_to(20'000'000) - 10'000'000;
      box.hi[k] = box.lo[k] + up_to(longest);
    }
    if (i % 50 == 0) box = geometry::empty_box<std::int64_t>();
    if (i % 50 == 1) box.hi = box.lo;
    if (i % 50 == 2) box = boxes.back();
    boxes.push_back(box);
  }
  return boxes;
}

TEST(Evaluate, ALooseOctreeFindsAllPairsOfBoxes) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const std::vector<geometry::Box3l> boxes = uneven_boxes(seed);
    const LooseOctree tree{std::span(boxes)};
    TreeSearch search;
    std::vector<geometry::IndexPair> expected;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      tree.find(i, search);
      for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
        if (!boxes[i].empty() && !boxes[j].empty() && meet(boxes[i], boxes[j]))
          expected.push_back({i, j});
    }
    ASSERT_GT(expected.size(), 100U);
    EXPECT_EQ(search.pairs.size(), expected.size()) << "seed " << seed;
    EXPECT_EQ(computed_of(search.pairs).hash(), computed_of(expected).hash()) << "seed " << seed;
  }
  const LooseOctree none{std::span<const geometry::Box3l>()};
  const std::vector<geometry::Box3l> empty(3, geometry::empty_box<std::int64_t>());
  TreeSearch search;
  LooseOctree{std::span(empty)}.find(1, search);
  EXPECT_TRUE(search.pairs.empty());
}

TEST(Evaluate, AStudyRunsUnderItsConditions) {
  EvaluationSettings settings;
  settings.threads = {1};
  settings.repeat = 2;
  settings.limit_s = 60;
  const StudyInput input{settings, {}, [](const std::string&) {}};
  Contender contender = fake("x", "a");
  contender.threads = 3;
  contender.compute = [](const parallel::Context& context) -> Result<Computed> {
    EXPECT_EQ(context.distribution, parallel::Distribution::equal_ranges);
    EXPECT_EQ(context.min_chunk, 4U);
    const Status status =
        parallel::for_each(context, {.name = "loop", .n = 300}, [](std::size_t) {});
    if (!status) return status.error();
    return Computed{{{"tests", 7}}, [] { return std::string("a"); }, {}};
  };
  const auto run = run_for_study(
      input, contender,
      {.distribution = parallel::Distribution::equal_ranges, .min_chunk = 4, .with_regions = true});
  ASSERT_TRUE(run.has_value()) << run.error().text();
  EXPECT_EQ(region_named(run->regions, "loop").busy_s.size(), 3U);
  EXPECT_EQ(run->counter("tests"), "7");
  StudyRun other = *run;
  other.computed.hash = [] { return std::string("b"); };
  StudyRecord study;
  EXPECT_EQ(equal(*run, *run, "same", study), "yes");
  EXPECT_TRUE(study.differences.empty());
  EXPECT_EQ(equal(*run, other, "another", study), "NO");
  EXPECT_EQ(study.differences.size(), 1U);
}

TEST(Evaluate, AChartOfNothingIsStillAChart) {
  const std::string svg = bar_chart_svg({"empty", "x", {"a"}, {{"s", {0.0}}}});
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Evaluate, AResultThatDiffersIsReported) {
  EvaluationSettings settings;
  settings.threads = {1};
  settings.repeat = 1;
  const std::vector<Contender> equal{fake(kSequential, "a"), fake(kAgain, "a")};
  const std::vector<Contender> other{fake(kSequential, "a"), fake("thesis: push", "b")};
  const auto narrate = [](const std::string&) {};
  const auto same = measure_stage("global", equal, settings, {}, narrate);
  ASSERT_TRUE(same.has_value());
  EXPECT_TRUE(same->differences.empty());
  const auto different = measure_stage("global", other, settings, {}, narrate);
  ASSERT_TRUE(different.has_value());
  EXPECT_EQ(different->differences.size(), 2U) << "the result, and what is published";
}

/// Returns a sheet of A4 with two lines, one of them hidden, that end so far to the right.
SheetPixels sheet_of_lines(double right_mm) {
  drawing::NeutralDrawing sheet;
  sheet.sheet.width_mm = 297;
  sheet.sheet.height_mm = 210;
  drawing::Ink ink;
  drawing::Line line;
  line.a_paper = {20, 30};
  line.b_paper = {right_mm, 30};
  ink.lines.push_back(line);
  line.a_paper = {20, 100};
  line.b_paper = {right_mm, 100};
  line.state = drawing::LineState::hidden_by_other;
  ink.lines.push_back(line);
  return {sheet, ink};
}

TEST(Evaluate, PixelsShowWhatOfADifferenceAnybodyCouldSee) {
  const SheetPixels sheet = sheet_of_lines(120);
  // 100 mm at 4096 pixels for 297 mm, and each line's first pixel.
  EXPECT_NEAR(static_cast<double>(sheet.inked()), 2 * 100 * 4096.0 / 297 + 2, 4);
  EXPECT_EQ(sheet.different(sheet_of_lines(120)), 0U);
  EXPECT_EQ(sheet.different(sheet_of_lines(120.001)), 0U) << "a micrometre is none";
  EXPECT_NEAR(static_cast<double>(sheet.different(sheet_of_lines(130))), 2 * 10 * 4096.0 / 297, 4);
  EXPECT_EQ(sheet.difference_text(sheet_of_lines(120)), "0 of 11862016 pixels differ");
  EXPECT_EQ(SheetPixels().inked(), 0U);
  EXPECT_GT(sheet.different(SheetPixels()), 0U) << "another size";
}

TEST(Evaluate, ADrawingThatDiffersIsComparedPixelByPixel) {
  EvaluationSettings settings;
  settings.threads = {1};
  settings.repeat = 1;
  const auto drawn = [](std::string name, double right_mm) {
    Contender one = fake(std::move(name), "a");
    one.compute = [right_mm](const parallel::Context&) -> Result<Computed> {
      return Computed{{},
                      [] { return std::string("a"); },
                      [right_mm](const parallel::Context&) -> Result<Published> {
                        return Published{std::to_string(right_mm), sheet_of_lines(right_mm)};
                      }};
    };
    return one;
  };
  const std::vector<Contender> contenders{drawn(kSequential, 120), drawn("seen", 130),
                                          drawn("not seen", 120.001)};
  const auto stage = measure_stage("global", contenders, settings, {}, [](const std::string&) {});
  ASSERT_TRUE(stage.has_value());
  ASSERT_EQ(stage->differences.size(), 2U);
  EXPECT_EQ(stage->differences[0].find("(0 of"), std::string::npos) << stage->differences[0];
  EXPECT_NE(stage->differences[0].find("pixels differ) of 'seen'"), std::string::npos)
      << stage->differences[0];
  EXPECT_NE(stage->differences[1].find("(0 of 11862016 pixels differ) of 'not seen'"),
            std::string::npos)
      << stage->differences[1];
}

TEST(Evaluate, AContenderWithALimitIsStoppedAndReportedToBe) {
  EvaluationSettings settings;
  settings.threads = {1};
  settings.repeat = 1;
  settings.limit_s = 0.05;
  std::vector<Contender> contenders{fake(kSequential, "a"), fake("thesis: spheres", "a")};
  contenders.back().limited = true;
  contenders.back().compute = [](const parallel::Context& context) -> Result<Computed> {
    while (!context.stop.stop_requested()) continue;
    return Error{ErrorCode::cancelled, "cancelled", {}, {}};
  };
  const auto stage = measure_stage("clash", contenders, settings, {}, [](const std::string&) {});
  ASSERT_TRUE(stage.has_value()) << stage.error().text();
  EXPECT_EQ(stage->contenders.back().unfinished, "stopped after 0.05 s");
  EXPECT_TRUE(stage->differences.empty());
}

/// Returns a cube of side 100 mm, from x on.
geometry::TriangleMesh cube_from(double x) {
  geometry::TriangleMesh mesh;
  for (unsigned corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back({x + ((corner & 1U) != 0 ? 100.0 : 0), (corner & 2U) != 0 ? 100.0 : 0,
                             (corner & 4U) != 0 ? 100.0 : 0});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(Evaluate, ALimitEndsSphereSubdivisionWithinAPair) {
  model::Model model;
  model.files.push_back({"cubes", "made", "mm", "z", 0, 0});
  for (std::uint32_t i = 0; i < 2; ++i) {
    model::Object object;
    object.id = object.name = i == 0 ? "a" : "b";
    object.first_body = i;
    object.body_count = 1;
    model.objects.push_back(object);
    model::Body body;
    body.shape = model::ShapeId{i};
    model.bodies.push_back(body);
    model.shapes.emplace_back(cube_from(i == 0 ? 0 : 100.5));
  }
  model::finish(model);
  const auto scene = model::make_scene(model, {}, {});
  ASSERT_TRUE(scene.has_value());
  clash::Options options{.tolerances = {.touch_gap_mm = 0.002, .touch_overlap_mm = 0.002}};
  options.tolerances.clearance_mm = 5;
  options.engine.narrow_phase = clash::NarrowPhase::sphere_subdivision;
  options.engine.max_spheres = std::uint64_t{1} << 50U;
  const TimeLimit limit({}, 0.05);
  const auto report =
      clash::detect(*scene, clash::one_set(*scene), options, {.stop = limit.token()});
  ASSERT_FALSE(report.has_value());
  EXPECT_EQ(report.error().code, ErrorCode::cancelled);
}

TEST(Evaluate, AFailureOfAContenderThatMustEndIsTheEvaluations) {
  EvaluationSettings settings;
  settings.threads = {1};
  std::vector<Contender> contenders{fake(kSequential, "a")};
  contenders.front().compute = [](const parallel::Context&) -> Result<Computed> {
    return Error{ErrorCode::input, "no", {}, {}};
  };
  EXPECT_FALSE(
      measure_stage("clash", contenders, settings, {}, [](const std::string&) {}).has_value());
}

TEST(Evaluate, EveryViewIsOneThatCanBeDrawn) {
  const geometry::Box3l box{{0, -5'000'000, 0}, {90'000'000, 5'000'000, 20'000'000}};
  for (const ViewCase& view : view_cases()) {
    const hlr::View hlr_view = view_of(view, box);
    EXPECT_NE(hlr_view.direction, (geometry::Vec3l{0, 0, 0})) << view.name;
    EXPECT_TRUE(!hlr_view.limits || !hlr_view.limits->empty()) << view.name;
  }
  EXPECT_EQ(view_cases().size(), 13U);
  EXPECT_EQ(ship_cases().size(), 4U);
  for (const ShipCase& ship : ship_cases())
    EXPECT_GT(clashing_ship(ship, 1).objects, 1'000'000U) << ship.name;
}

}  // namespace
}  // namespace strake::cli
