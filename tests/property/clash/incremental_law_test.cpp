// SPDX-License-Identifier: Apache-2.0
// A run that follows changes reports what a full run does, bit by bit, whatever was edited.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "strake/clash/incremental.hpp"
#include "strake/parallel/team.hpp"
#include "support/edited_model.hpp"
#include "support/rounds.hpp"
#include "support/same_reports.hpp"

namespace strake::clash {
namespace {

using test::EditedInputs;
using test::EditedModel;
using test::ReportDifference;

Signatures signatures_of(const EditedInputs& in, const parallel::Context& context) {
  return signatures(in.scene, in.sets, in.options, in.policy, context).value();
}

/// A run, and what a later one has to know of it.
struct Earlier {
  Report report;
  Signatures signatures;
  std::vector<std::string> identities;
};

std::vector<std::uint32_t> mapped(const Earlier& earlier, const EditedInputs& in,
                                  const Signatures& now) {
  std::unordered_map<std::string, std::uint32_t> numbers;
  for (std::uint32_t o = 0; o < in.identities.size(); ++o) numbers[in.identities[o]] = o;
  std::vector<std::uint32_t> map;
  for (std::size_t o = 0; o < earlier.identities.size(); ++o) {
    const auto at = numbers.find(earlier.identities[o]);
    const bool same =
        at != numbers.end() && now.objects[at->second] == earlier.signatures.objects[o];
    map.push_back(same ? at->second : model::kNoObject);
  }
  return map;
}

/// Returns the results that are in neither list of numbers, wherever their regions lie.
Report without(Report report, const std::vector<std::size_t>& numbers) {
  for (auto i = numbers.rbegin(); i != numbers.rend(); ++i)
    report.pairs.erase(report.pairs.begin() + static_cast<std::ptrdiff_t>(*i));
  for (Pair& pair : report.pairs) pair.first_region = 0;
  return report;
}

/// Says what is wrong with what a run says it did to the results of the one before.
std::string fault_of(const Report& earlier, const FollowedRun& run) {
  if (!run.changes) return ReportDifference::of(earlier, run.earlier);
  Report gone = earlier, then = without(earlier, run.changes->gone_from),
         now = without(run.report, run.changes->put_in);
  if (run.earlier.sheets != earlier.sheets) return "the sheets of the earlier run";
  gone.pairs.clear();
  for (const std::size_t i : run.changes->gone_from) gone.pairs.push_back(earlier.pairs[i]);
  Report reported = gone;
  reported.pairs = run.changes->gone;
  if (const std::string fault = ReportDifference::of(gone, reported); !fault.empty())
    return "gone: " + fault;
  gone.pairs = std::move(then.pairs);
  reported.pairs = std::move(now.pairs);
  return ReportDifference::of(gone, reported);
}

PartnerBlocks blocks_of(const Report& report, std::size_t objects) {
  PartnerBlocks partners;
  auto at = report.pairs.begin();
  for (std::size_t first = 0; first < objects; first += PartnerBlocks::kObjects) {
    const auto end = std::find_if(at, report.pairs.end(), [&](const Pair& pair) {
      return index(pair.a) >= first + PartnerBlocks::kObjects;
    });
    partners.of.push_back(partners_of({at, end}));
    at = end;
  }
  return partners;
}

class IncrementalLaw : public testing::TestWithParam<std::uint64_t> {
 protected:
  /// Compares a run that follows the changes, for each team, with a full one.
  void compare(const EditedInputs& in, const Earlier& earlier, const Signatures& now,
               const Report& full) {
    const std::vector<std::uint32_t> map = mapped(earlier, in, now);
    for (parallel::Team* const team : {&one_, &two_, &three_, &eight_}) {
      const parallel::Context context{.team = team, .stop = {}};
      EXPECT_EQ(signatures_of(in, context).objects, now.objects);
      const PartnerBlocks partners = blocks_of(earlier.report, map.size());
      // Whether results are searched or looked at one by one must not show.
      const Result<FollowedRun> followed =
          follow_changes(in.scene, in.sets, in.options, in.policy,
                         {earlier.report, map, in.identities == earlier.identities,
                          team == &two_ ? nullptr : &partners},
                         context);
      ASSERT_TRUE(followed) << followed.error().text();
      EXPECT_EQ(ReportDifference::of(full, followed->report), "");
      EXPECT_EQ(fault_of(earlier.report, *followed), "");
      if (followed->changes) ++reported_;
      work_ += followed->report.counters.part_pairs;
    }
    full_work_ += 4 * full.counters.part_pairs;
  }

  /// Edits a crowd step by step, each by `edit(model)`, and compares after each.
  template <class Edit>
  void follow_edits(const Edit& edit) {
    const int steps = test::rounds(12, 40);
    EditedModel edited(GetParam());
    Earlier earlier;
    for (int step = 0; step < steps; ++step) {
      SCOPED_TRACE("step " + std::to_string(step));
      if (step > 0) edit(edited);
      const EditedInputs in = edited.inputs();
      const Signatures now = signatures_of(in, {});
      Report full =
          detect(in.scene, in.sets, in.options, in.policy, {.team = &two_, .stop = {}}).value();
      if (step > 0 && now.rules == earlier.signatures.rules) {
        compare(in, earlier, now, full);
        if (HasFailure()) return;
      }
      earlier = {std::move(full), now, in.identities};
    }
  }

  parallel::Team one_{1}, two_{2}, three_{3}, eight_{8};
  std::uint64_t work_ = 0, full_work_ = 0, reported_ = 0;
};

TEST_P(IncrementalLaw, EqualsTheFullRunBitByBit) {
  follow_edits([](EditedModel& edited) { edited.edit(); });
  // It would be equal as well if every run were a full one.
  EXPECT_LT(work_, full_work_);
  EXPECT_GT(reported_, 0U);
}

TEST_P(IncrementalLaw, HoldsForFilesThatAreRenamed) {
  follow_edits([](EditedModel& edited) {
    edited.rename_files();
    if (edited.draw().one_in(2)) edited.edit();
  });
  // Where files change places or rules go by files it may be as much.
  EXPECT_LE(work_, full_work_);
}

INSTANTIATE_TEST_SUITE_P(Seeds, IncrementalLaw,
                         testing::Range<std::uint64_t>(1, test::rounds<std::uint64_t>(20, 400)));

/// What follows from its own result step by step: nothing that is kept may drift.
TEST(IncrementalChain, FollowsItsOwnResults) {
  for (std::uint64_t seed = 1000; seed < test::rounds<std::uint64_t>(1008, 1100); ++seed) {
    SCOPED_TRACE(seed);
    EditedModel edited(seed);
    Earlier earlier;
    for (int step = 0; step < 20; ++step) {
      if (step > 0 && seed % 2 == 0) edited.rename_files();
      if (step > 0) edited.edit();
      const EditedInputs in = edited.inputs();
      const Signatures now = signatures_of(in, {});
      const Report full = detect(in.scene, in.sets, in.options, in.policy, {}).value();
      Report followed = full;
      if (step > 0 && now.rules == earlier.signatures.rules)
        followed = detect_changes(in.scene, in.sets, in.options, in.policy,
                                  {std::move(earlier.report), mapped(earlier, in, now)}, {})
                       .value();
      ASSERT_EQ(ReportDifference::of(full, followed), "") << "step " << step;
      earlier = {std::move(followed), now, in.identities};
    }
  }
}

/// Labels, links and groups are numbered anew by every call of inputs(), and objects are in another
/// order there.
TEST(IncrementalSignatures, NumbersDoNotShowInThem) {
  for (std::uint64_t seed = 1; seed < test::rounds<std::uint64_t>(30, 300); ++seed) {
    EditedModel edited(seed);
    const EditedInputs once = edited.inputs();
    std::ranges::reverse(edited.objects);
    const EditedInputs again = edited.inputs();
    const Signatures first = signatures_of(once, {}), second = signatures_of(again, {});
    EXPECT_EQ(first.rules, second.rules) << seed;
    EXPECT_EQ(first.objects, second.objects) << seed;
  }
}

}  // namespace
}  // namespace strake::clash
