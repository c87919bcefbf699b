// SPDX-License-Identifier: Apache-2.0
// Reports as bytes: what is read is what was written, and bytes that are no report are refused.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "project/stored_report/kept_codec.hpp"
#include "project/stored_report/report_codec.hpp"
#include "strake/generate/ship.hpp"
#include "strake/rules/rules.hpp"
#include "support/clash_model.hpp"

namespace strake::project {
namespace {

RememberedReport remembered(clash::Report report) {
  RememberedReport all{std::move(report), {}, {}, {}};
  for (std::size_t i = 0; i < all.report.pairs.size(); ++i)
    all.rows.push_back(all.report.pairs[i].allowed < 0 ? static_cast<std::int64_t>(i + 1) : 0);
  return all;
}

EncodedReport encoded(const RememberedReport& all, const std::vector<std::byte>& head) {
  EncodedReport bytes{head, {}, {}, {}};
  std::vector<Hash128> hashes;
  for (const PartRange& part : parts_of(all.report, all.report.in_a.size()))
    hashes.push_back(hash_bytes(bytes.parts.emplace_back(encode_part(all, part).value())));
  bytes.seal = seal_of(head, {}, hashes);
  return bytes;
}

void expect_round_trip(const RememberedReport& all) {
  const std::size_t objects = all.report.in_a.size();
  const std::vector<std::byte> head = encode_head(all.report).value();
  const Result<RememberedReport> read = decode_report(encoded(all, head), objects, "it", {});
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->rows, all.rows);
  EXPECT_TRUE(is_same_result(read->report, all.report).value());
  EXPECT_EQ(encode_head(read->report).value(), head);
  EXPECT_EQ(read->report.counters.candidate_pairs, all.report.counters.candidate_pairs);
  ASSERT_EQ(read->report.pairs.size(), all.report.pairs.size());
  for (std::size_t i = 0; i < all.report.pairs.size(); ++i)
    ASSERT_EQ(read->report.pairs[i].first_region, all.report.pairs[i].first_region);
  const std::vector<std::byte> kept = encode_kept(all.report.kept).value();
  const std::vector<std::uint64_t> elements =
      all.report.kept ? all.report.kept->elements : std::vector<std::uint64_t>();
  const auto again = decode_kept(kept, read->report, objects, elements, "it");
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_EQ(encode_kept(*again).value(), kept);
}

clash::Options measured() {
  clash::Options options;
  options.tolerances.clearance_mm = 25;
  options.engine.volumes = clash::Volumes::on;
  options.engine.keep_for_changes = true;
  return options;
}

clash::Report of_ship(const clash::Options& options) {
  const auto ship = generate::generate_ship({3000, 7}, {}).value();
  const auto scene = make_scene(ship.model, clash::scene_options(options), {}).value();
  return clash::detect(scene, clash::one_set(scene), options, {}).value();
}

TEST(StoredReport, of_a_ship_is_read_as_it_was_written) {
  const clash::Report report = of_ship(measured());
  ASSERT_GT(report.pairs.size(), 100U);
  ASSERT_GT(parts_of(report, report.in_a.size()).size(), 1U);
  expect_round_trip(remembered(report));
}

TEST(StoredReport, with_contacts_that_are_counted_is_read_as_it_was_written) {
  clash::Options options = measured();
  options.engine.contacts = clash::Contacts::count;
  const clash::Report report = of_ship(options);
  ASSERT_GT(report.unlisted.contacts, 0U);
  expect_round_trip(remembered(report));
}

TEST(StoredReport, under_rules_is_read_as_it_was_written) {
  const auto ship = generate::generate_ship({1500, 3}, {}).value();
  const auto rules = rules::Rules::parse(R"toml([[discipline]]
name = "meshes"
select = "type = mesh"
[[discipline]]
name = "rest"
select = "*"
[matrix]
name = "all"
clearance = "20mm"
min_volume = "1cm3"
missing = "checked"
[matrix.cells.meshes]
meshes = { clearance = "5mm" }
rest = { clearance = "10mm", touch_gap = 0 }
[[allowed]]
name = "shallow"
a = "*"
b = "*"
max_depth = "30mm"
)toml",
                                         "r.toml");
  ASSERT_TRUE(rules) << rules.error().text();
  const auto scene = make_scene(ship.model, rules->scene_options(), {}).value();
  rules::Plan plan = rules->plan(scene, {}).value();
  ASSERT_EQ(plan.tests.size(), 1U);
  plan.tests[0].policy.list_exempted = true;
  plan.tests[0].options.engine.keep_for_changes = true;
  clash::Report report =
      clash::detect(scene, plan.tests[0].sets, plan.tests[0].options, plan.tests[0].policy, {})
          .value();
  report.name = "all";
  ASSERT_GT(report.count_allowed, 0U);
  ASSERT_FALSE(report.cells.empty());
  expect_round_trip(remembered(report));
}

TEST(StoredReport, rewrites_only_the_part_that_changed) {
  const RememberedReport before = remembered(of_ship(measured()));
  const std::vector<PartRange> parts = parts_of(before.report, before.report.in_a.size());
  RememberedReport after = before;
  after.report.pairs.back().d_mm -= 1;
  std::size_t changed = 0;
  for (const PartRange& part : parts) changed += is_same_part(before, part, after, part) ? 0U : 1U;
  EXPECT_EQ(changed, 1U);
}

TEST(StoredReport, refuses_what_does_not_fit) {
  test::ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100});
  m.box("b", {80, 0, 0}, {200, 100, 100});
  const RememberedReport good = remembered(m.detect());
  const auto refused = [&](auto&& change, std::size_t objects = 2) {
    RememberedReport bad = good;
    change(bad);
    const std::vector<std::byte> head = encode_head(bad.report).value();
    return !decode_report(encoded(bad, head), objects, "it", {});
  };
  EXPECT_FALSE(refused([](RememberedReport&) {}));
  EXPECT_TRUE(refused([](RememberedReport&) {}, 3)) << "another number of objects";
  EXPECT_TRUE(refused([](RememberedReport& r) { r.report.pairs[0].b = model::ObjectId{9}; }));
  EXPECT_TRUE(refused([](RememberedReport& r) { r.report.pairs[0].allowed = 0; }));
  EXPECT_TRUE(refused([](RememberedReport& r) { r.report.pairs[0].cls = clash::Class::no_hit; }));
  EXPECT_TRUE(refused([](RememberedReport& r) { r.report.pairs[0].regions = 2; }));
  EXPECT_TRUE(refused([](RememberedReport& r) { r.rows[0] = -1; }));
  EXPECT_TRUE(refused([](RememberedReport& r) { r.report.discipline = {0, 0}; }));
}

TEST(StoredReport, refuses_any_byte_that_changed) {
  test::ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100});
  m.box("b", {80, 0, 0}, {200, 100, 100});
  const RememberedReport good = remembered(m.detect());
  const std::vector<std::byte> head = encode_head(good.report).value();
  EncodedReport stored = encoded(good, head);
  ASSERT_TRUE(decode_report(stored, 2, "it", {}));
  for (std::size_t i = 0; i < head.size(); ++i) {
    std::vector<std::byte> bad = head;
    bad[i] ^= std::byte{0x10};
    stored.head = bad;
    EXPECT_FALSE(decode_report(stored, 2, "it", {})) << i;
  }
}

TEST(StoredReport, refuses_parts_that_are_missing_too_many_or_of_another_run) {
  const RememberedReport good = remembered(of_ship(measured()));
  const std::size_t objects = good.report.in_a.size();
  const std::vector<std::byte> head = encode_head(good.report).value();
  const EncodedReport stored = encoded(good, head);
  ASSERT_GT(stored.parts.size(), 1U);
  const auto refused = [&](auto&& change) {
    EncodedReport bad = stored;
    change(bad);
    return !decode_report(bad, objects, "it", {});
  };
  EXPECT_FALSE(refused([](EncodedReport&) {}));
  EXPECT_TRUE(refused([](EncodedReport& e) { e.parts.pop_back(); }));
  EXPECT_TRUE(refused([](EncodedReport& e) { e.parts.clear(); }));
  EXPECT_TRUE(refused([](EncodedReport& e) { e.parts.push_back(e.parts.back()); }));
  RememberedReport earlier = good;
  earlier.report.pairs.front().d_mm -= 1;
  const PartRange first = parts_of(earlier.report, objects).front();
  ASSERT_GT(first.last_pair, first.first_pair);
  const std::vector<std::byte> of_earlier = encode_part(earlier, first).value();
  EXPECT_TRUE(refused([&](EncodedReport& e) { e.parts.front() = of_earlier; }));
  EXPECT_TRUE(refused([&](EncodedReport& e) { e.kept = head; }));
}

}  // namespace
}  // namespace strake::project
