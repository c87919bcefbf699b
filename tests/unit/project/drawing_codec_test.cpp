// SPDX-License-Identifier: Apache-2.0
// Drawings as rows of the database: all of them comes back, and from no bytes anything else.
#include "project/views/drawing_codec.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "project/codec/blob.hpp"
#include "project/views/number_columns.hpp"
#include "strake/generate/ship.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/team.hpp"
#include "support/clash_model.hpp"

namespace strake::project {
namespace {

std::vector<std::byte> bytes_of(const hlr::Drawing& drawing) {
  BlobWriter out;
  write(out, drawing);
  auto bytes = out.finish();
  EXPECT_TRUE(bytes);
  return bytes ? std::move(*bytes) : std::vector<std::byte>{};
}

/// Returns what is read, or the fault.
Result<hlr::Drawing> read_back(const std::vector<std::byte>& bytes,
                               const parallel::Context& context = {}) {
  Result<BlobReader> in = BlobReader::open(bytes, "the drawing");
  if (!in) return in.error();
  Result<hlr::Drawing> drawing = read_drawing(*in, context);
  if (!drawing) return drawing;
  if (const Status status = in->finish(); !status) return status.error();
  return drawing;
}

/// Returns a drawing in parts: its head, then the lines of each range of objects.
std::vector<std::vector<std::byte>> coded_parts_of(const hlr::Drawing& drawing) {
  BlobWriter head;
  write_head(head, drawing);
  std::vector<std::vector<std::byte>> blobs{head.finish().value()};
  const std::size_t objects = drawing.account.fates.size();
  for (std::size_t k = 0; k < count_drawing_parts(objects); ++k) {
    BlobWriter part;
    EXPECT_TRUE(write_lines(part, drawing, objects_of_drawing_part(k, objects)));
    blobs.push_back(part.finish().value());
  }
  return blobs;
}

Result<hlr::Drawing> read_parts_back(const std::vector<std::vector<std::byte>>& blobs,
                                     const parallel::Context& context = {}) {
  Result<BlobReader> in = BlobReader::open(blobs.front(), "the drawing");
  if (!in) return in.error();
  const std::vector<std::span<const std::byte>> parts(blobs.begin() + 1, blobs.end());
  Result<hlr::Drawing> drawing = read_parts_of_drawing(*in, parts, "the drawing", context);
  if (!drawing) return drawing;
  if (const Status status = in->finish(); !status) return status.error();
  return drawing;
}

/// Round and flat things, of which one lacks geometry and one is too small for the grid.
model::Model mixed_model() {
  test::ClashModel m;
  m.object("pipe").body(geometry::Primitive{geometry::CylinderPrimitive{300, 2000}});
  m.object("other").again({{}, {900, 150, 0}});
  m.box("box", {200, -500, -500}, {700, 500, 500});
  m.box("speck", {0, 0, 5000}, {1e-5, 1e-5, 5000});
  m.object("lost");
  m.model.objects.back().incomplete = true;
  return std::move(m.model);
}

model::Model ship() {
  auto made = generate::generate_ship({.objects = 600}, {});
  EXPECT_TRUE(made);
  return made ? std::move(made->model) : model::Model{};
}

/// A row of pipes, whose rims are circles.
model::Model pipes() {
  test::ClashModel m;
  m.object("pipe").body(geometry::Primitive{geometry::CylinderPrimitive{300, 2000}});
  for (int i = 1; i < 600; ++i)
    m.object("pipe " + std::to_string(i)).again({{}, {900.0 * i, 0, 0}});
  return std::move(m.model);
}

struct DrawingContent {
  hlr::View view;
  hlr::Options options;
};

/// Views that between them have everything that a drawing can hold.
std::vector<DrawingContent> contents_of(std::size_t objects) {
  std::vector<DrawingContent> all(5);
  all[1].view.direction = {0, 0, 1};
  all[1].view.up = {0, 1, 0};
  all[1].view.sections = {{{0, 0, 1}, {0, 0, 100'000}}, {{1, 0, 0}, {3'000'000, 0, 0}}};
  all[1].options.uncut.assign(objects, false);
  all[1].options.uncut[0] = true;
  all[1].options.hatches.assign(objects, {30, -1});
  all[2].view.direction = {0, -1, 0};
  all[2].view.limits = geometry::Box3l{{-100'000, -90'000, 0}, {900'000, 800'000, 900'000}};
  all[2].options.hidden = false;
  all[2].options.clipped = false;
  all[2].options.sag_mm = 0.01;
  all[2].options.smooth = hlr::Smooth::all;
  all[3].view.direction = {-1, -9, 3};
  all[3].view.perspective =
      hlr::Perspective{{1'000'000, -9'000'000, 3'000'000}, {2'000'000, 0, 0}, 50, 60};
  all[3].options.intersections = hlr::Intersections::parts;
  all[3].options.clipped = false;
  all[4].options.keep_specks = true;
  all[4].options.flush_seams = false;
  all[4].options.stage = hlr::Stage::local;
  all[4].options.contact_distance_mm = 0.5;
  return all;
}

hlr::Drawing drawn(const model::Model& model, const DrawingContent& how) {
  const auto scene = model::make_scene(model, {}, {});
  EXPECT_TRUE(scene);
  auto drawing = hlr::draw(*scene, {}, how.view, how.options, {});
  EXPECT_TRUE(drawing) << drawing.error().text();
  return drawing ? std::move(*drawing) : hlr::Drawing{};
}

TEST(DrawingCodec, AllOfADrawingComesBack) {
  parallel::Team team(4);
  const parallel::Context teamed{.team = &team};
  for (const model::Model& model : {mixed_model(), ship()})
    for (const DrawingContent& how : contents_of(model.objects.size())) {
      const hlr::Drawing drawing = drawn(model, how);
      const std::vector<std::byte> bytes = bytes_of(drawing);
      for (const parallel::Context& context : {parallel::Context{}, teamed}) {
        const auto again = read_back(bytes, context);
        ASSERT_TRUE(again) << again.error().text();
        // What is written is all, so that what is read is written alike.
        EXPECT_TRUE(bytes_of(*again) == bytes);
        EXPECT_EQ(again->pieces.size(), drawing.pieces.size());
        EXPECT_EQ(again->account.defects, drawing.account.defects);
        EXPECT_EQ(again->diagnostics.counts().size(), drawing.diagnostics.counts().size());
        EXPECT_EQ(again->counters.face_tests, drawing.counters.face_tests);
        const auto equal = are_equal(*again, drawing);
        ASSERT_TRUE(equal);
        EXPECT_TRUE(*equal);
      }
      const std::vector<std::vector<std::byte>> parts = coded_parts_of(drawing);
      EXPECT_EQ(parts.size(), model.objects.size() > 256 ? 4U : 2U);
      for (const parallel::Context& context : {parallel::Context{}, teamed}) {
        const auto again = read_parts_back(parts, context);
        ASSERT_TRUE(again) << again.error().text();
        EXPECT_TRUE(bytes_of(*again) == bytes);
        EXPECT_TRUE(coded_parts_of(*again) == parts);
      }
    }
}

/// So a change of one object leaves the bytes of all other parts.
TEST(DrawingCodec, APartIsOfItsObjectsAlone) {
  const hlr::Drawing drawing = drawn(pipes(), {});
  hlr::Drawing other = drawing;
  const auto first = std::ranges::find_if(
      other.pieces, [](const hlr::EdgePiece& piece) { return model::index(piece.object) >= 256; });
  ASSERT_NE(first, other.pieces.end());
  ASSERT_LT(model::index(first->object), 512U);
  other.pieces.insert(first, *first);
  // One more curve before all others.
  const auto edge = std::ranges::find_if(
      other.curves.edges, [](const hlr::CurvedEdge& e) { return model::index(e.object) >= 256; });
  ASSERT_NE(edge, other.curves.edges.end());
  const std::uint32_t curve = edge->curve;
  other.curves.all.insert(other.curves.all.begin() + curve, other.curves.all[curve]);
  for (auto at = edge + 1; at != other.curves.edges.end(); ++at) ++at->curve;
  const auto parts = coded_parts_of(drawing), others = coded_parts_of(other);
  ASSERT_EQ(parts.size(), 4U);
  const auto again = read_parts_back(parts);
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_TRUE(coded_parts_of(*again) == parts);
  EXPECT_TRUE(bytes_of(*again) == bytes_of(drawing));
  EXPECT_TRUE(parts[1] == others[1]);
  EXPECT_FALSE(parts[2] == others[2]);
  EXPECT_TRUE(parts[3] == others[3]);
}

TEST(DrawingCodec, PartsThatAreNotThoseOfADrawingAreRefused) {
  const auto parts = coded_parts_of(drawn(ship(), {}));
  ASSERT_TRUE(read_parts_back(parts));
  const auto is_refused = [](const std::vector<std::vector<std::byte>>& wrong) {
    const auto read = read_parts_back(wrong);
    return !read && read.error().code == ErrorCode::input;
  };
  auto wrong = parts;
  wrong.pop_back();
  EXPECT_TRUE(is_refused(wrong));
  wrong = parts;
  wrong.push_back(parts.back());
  EXPECT_TRUE(is_refused(wrong));
  wrong = parts;
  std::swap(wrong[1], wrong[2]);
  EXPECT_TRUE(is_refused(wrong)) << "lines of objects of another range";
  wrong = parts;
  wrong[3] = parts[0];
  EXPECT_TRUE(is_refused(wrong));
  wrong = parts;
  wrong[0] = bytes_of(drawn(ship(), {}));
  EXPECT_TRUE(is_refused(wrong)) << "another form";
  const auto of_whole = BlobReader::open(parts[0], "head");
  ASSERT_TRUE(of_whole);
  auto head = BlobReader::open(parts[0], "head");
  EXPECT_TRUE(!read_drawing(*head, {}) || head->failed()) << "a head alone is no drawing";
}

/// Lines whose curves are in another order would be of other objects when they are read again.
TEST(DrawingCodec, CurvesOutOfOrderAreNotWritten) {
  hlr::Drawing drawing = drawn(pipes(), {});
  ASSERT_GT(drawing.curves.edges.size(), 2U);
  std::swap(drawing.curves.edges.front().curve, drawing.curves.edges.back().curve);
  BlobWriter out;
  EXPECT_FALSE(write_lines(out, drawing, objects_of_drawing_part(0, 600)));
}

TEST(DrawingCodec, PiecesTakeFewBytes) {
  const hlr::Drawing drawing = drawn(ship(), {});
  ASSERT_GT(drawing.pieces.size(), 1000U);
  EXPECT_LT(bytes_of(drawing).size(), drawing.pieces.size() * 14);
}

TEST(DrawingCodec, AnyDifferenceIsOne) {
  const hlr::Drawing drawing = drawn(mixed_model(), {});
  const auto differs = [&](const std::function<void(hlr::Drawing&)>& change) {
    hlr::Drawing other = drawing;
    change(other);
    const auto equal = are_equal(drawing, other);
    return equal && !*equal;
  };
  EXPECT_FALSE(differs([](hlr::Drawing&) {}));
  EXPECT_FALSE(differs([](hlr::Drawing& d) { ++d.counters.face_tests; }));
  EXPECT_TRUE(differs([](hlr::Drawing& d) { ++d.counters.feature_edges; }));
  EXPECT_TRUE(differs([](hlr::Drawing& d) { ++d.pieces.back().b.z; }));
  EXPECT_TRUE(differs([](hlr::Drawing& d) { d.pieces[3].state = hlr::State::clipped; }));
  EXPECT_TRUE(differs([](hlr::Drawing& d) { d.pieces.pop_back(); }));
  EXPECT_TRUE(differs([](hlr::Drawing& d) { d.account.fates[1] = hlr::Fate::hidden; }));
  EXPECT_TRUE(differs([](hlr::Drawing& d) { d.curves.all[0].at.u.x += 1e-9; }));
  EXPECT_TRUE(differs([](hlr::Drawing& d) { d.options.sharp_angle_deg = 21; }));
  EXPECT_TRUE(differs([](hlr::Drawing& d) { d.view.up = {0, 1, 0}; }));
  EXPECT_TRUE(differs([](hlr::Drawing& d) { d.diagnostics.add(Severity::note, "x", "y", "z"); }));
}

TEST(DrawingCodec, WhatCannotBeADrawingIsRefused) {
  const hlr::Drawing sound = drawn(mixed_model(), {});
  ASSERT_TRUE(read_back(bytes_of(sound)));
  ASSERT_FALSE(sound.curves.edges.empty());
  const std::vector<std::function<void(hlr::Drawing&)>> faults{
      [](hlr::Drawing& d) { d.pieces[0].object = model::ObjectId{99}; },
      [](hlr::Drawing& d) { d.pieces.back().other = model::ObjectId{0xfffffffeU}; },
      [](hlr::Drawing& d) { std::swap(d.pieces.front(), d.pieces.back()); },
      [](hlr::Drawing& d) { d.pieces[2].kind = static_cast<hlr::EdgeKind>(77); },
      [](hlr::Drawing& d) { d.pieces[2].state = static_cast<hlr::State>(5); },
      [](hlr::Drawing& d) { d.pieces[1].a.x = std::numeric_limits<std::int64_t>::min(); },
      [](hlr::Drawing& d) { d.pieces[1].b.y = std::int64_t{1} << 60U; },
      [](hlr::Drawing& d) { d.origin.z = std::int64_t{-1} * (std::int64_t{1} << 53U); },
      [](hlr::Drawing& d) { d.curves.edges[0].curve = 1'000'000; },
      [](hlr::Drawing& d) { d.curves.edges[0].object = model::ObjectId{1'000}; },
      [](hlr::Drawing& d) { std::swap(d.curves.edges.front(), d.curves.edges.back()); },
      [](hlr::Drawing& d) { std::swap(d.curves.edges.front().curve, d.curves.edges.back().curve); },
      [](hlr::Drawing& d) { d.curves.all[0].at.v.y = std::nan(""); },
      [](hlr::Drawing& d) { d.curves.all[0].origin.x = std::int64_t{1} << 61U; },
      [](hlr::Drawing& d) { d.left_out = {1, 2, 3}; },
      [](hlr::Drawing& d) {
        d.options.clipped = false;
        d.clipped_left_out = {1, 2, 3};
      },
      [](hlr::Drawing& d) { d.counted.push_back({}); },
      [](hlr::Drawing& d) { d.account.fates[0] = static_cast<hlr::Fate>(200); },
      [](hlr::Drawing& d) { d.account.defects.push_back({model::ObjectId{50}, "no-lines"}); },
      [](hlr::Drawing& d) { d.account.defects.push_back({model::ObjectId{0}, "whatever"}); },
      [](hlr::Drawing& d) { d.options.stage = static_cast<hlr::Stage>(9); },
      [](hlr::Drawing& d) { d.options.bucketing = -7; },
      [](hlr::Drawing& d) { d.sag_mm = std::numeric_limits<double>::infinity(); },
      [](hlr::Drawing& d) { d.view.sections.resize(17); },
  };
  ASSERT_EQ(sound.account.fates.size(), 5U);
  std::size_t in_parts = 0;
  for (std::size_t f = 0; f < faults.size(); ++f) {
    hlr::Drawing wrong = sound;
    faults[f](wrong);
    const auto read = read_back(bytes_of(wrong));
    ASSERT_FALSE(read) << "fault " << f;
    EXPECT_EQ(read.error().code, ErrorCode::input);
    // Parts are made of what is in order, and of columns that have an entry for each object.
    const auto number = [](const auto& line) { return model::index(line.object); };
    BlobWriter part;
    if (!std::ranges::is_sorted(wrong.pieces, {}, number) ||
        !std::ranges::is_sorted(wrong.curves.edges, {}, number) ||
        number(wrong.pieces.back()) >= 5 || number(wrong.curves.edges.back()) >= 5 ||
        wrong.counted != sound.counted || wrong.left_out != sound.left_out ||
        wrong.clipped_left_out != sound.clipped_left_out || !write_lines(part, wrong, {0, 5}))
      continue;
    ++in_parts;
    const auto of_parts = read_parts_back(coded_parts_of(wrong));
    ASSERT_FALSE(of_parts) << "fault " << f;
    EXPECT_EQ(of_parts.error().code, ErrorCode::input);
  }
  EXPECT_GT(in_parts, faults.size() / 2);
}

TEST(NumberColumns, AnyNumbersComeBack) {
  const std::vector<std::vector<std::int64_t>> columns{
      {},
      {0, 0, 0},
      {1, 2, 3, 4},
      {-1, 1, -1, 1},
      {std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min(), 0, -1},
      {1'000'000'000'000, 1'000'000'000'001, -5}};
  BlobWriter out;
  for (const auto& column : columns) write_numbers(out, column);
  const auto bytes = out.finish();
  ASSERT_TRUE(bytes);
  auto in = BlobReader::open(*bytes, "columns");
  ASSERT_TRUE(in);
  for (const auto& column : columns) EXPECT_EQ(read_numbers(*in, column.size()), column);
  EXPECT_TRUE(in->finish());
}

TEST(NumberColumns, OfAnotherLengthAreRefused) {
  BlobWriter out;
  write_numbers(out, std::vector<std::int64_t>{1, 2, 3});
  const auto bytes = out.finish();
  ASSERT_TRUE(bytes);
  auto in = BlobReader::open(*bytes, "columns");
  ASSERT_TRUE(in);
  EXPECT_TRUE(read_numbers(*in, 4).empty());
  EXPECT_TRUE(in->failed());
}

}  // namespace
}  // namespace strake::project
