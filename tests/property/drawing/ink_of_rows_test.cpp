// SPDX-License-Identifier: Apache-2.0
// Rows of equal things behind a plate, drawn dashed: equal things look equal, whatever their
// number, the scale, the way they are turned, what stands at the end of the row and who comes
// first.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"
#include "support/clash_model.hpp"
#include "support/draw.hpp"
#include "support/meshes.hpp"
#include "support/prism.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

using geometry::Vec3d;

/// A row along its own x axis, seen from -y, and then turned about z as a whole.
struct Row {
  double scale = 50;
  int count = 40;
  Vec3d size;  ///< of a thing
  int corners = 4;
  Vec3d step;
  double turn = 0;        ///< of the row and of the view
  Vec3d toward;           ///< the viewer, before the turn
  bool neighbour = true;  ///< something unequal, nearer, within the ink of the first thing
  bool on_grid = true;    ///< things are equal to the last digit; otherwise but for rounding

  [[nodiscard]] Vec3d turned(const Vec3d& v) const {
    const double c = std::cos(turn), s = std::sin(turn);
    return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
  }
};

std::ostream& operator<<(std::ostream& out, const Row& r) {
  return out << "1:" << r.scale << ", " << r.count << " of " << r.size.x << "x" << r.size.y << "x"
             << r.size.z << " with " << r.corners << " corners" << ", step " << r.step.x << ","
             << r.step.y << "," << r.step.z << ", turn " << r.turn << ", toward " << r.toward.x
             << "," << r.toward.y << "," << r.toward.z << (r.neighbour ? ", a neighbour" : "")
             << (r.on_grid ? ", on the grid" : "");
}

Row random_row(test::Draw& draw) {
  Row row;
  constexpr std::array<double, 6> kScales{5, 20, 50, 100, 200, 500};
  row.scale = kScales.at(draw.below(kScales.size()));
  row.count = draw.whole(2, 20);
  // Corners that are off by what the grid rounds decide nothing between sizes that a designer would
  // take; between others a stretch may be as long as a dash, up to that.
  row.on_grid = draw.one_in(2);
  // About a pen wide on paper.
  const auto length = [&](double lo, double hi) {
    const double mm = draw.between(lo, hi) * row.scale;
    return row.on_grid ? mm : std::copysign(std::max(1.0, std::round(std::abs(mm))), mm);
  };
  row.size.x = length(0.05, 0.6);
  row.size.y = length(0.05, 2);
  row.size.z = length(0.05, 4);
  if (row.on_grid && draw.one_in(2)) row.corners = draw.whole(3, 13);
  row.step.x = row.size.x + length(0.02, 0.5);
  if (draw.one_in(2)) row.step.y = length(-0.3, 0.3);
  if (draw.one_in(2)) row.step.z = length(-0.3, 0.3);
  if (draw.one_in(2)) row.turn = draw.between(0, 2 * std::numbers::pi);
  row.toward = {0, -1, 0};
  if (row.on_grid && draw.one_in(2)) {
    row.toward.x = draw.between(-0.7, 0.7);
    row.toward.z = draw.between(-0.7, 0.7);
  }
  row.neighbour = draw.one_in(2);
  return row;
}

/// A box, or a prism of as many corners.
geometry::TriangleMesh thing(const Row& row) {
  if (row.corners == 4) return test::box_mesh({0, 0, 0}, row.size);
  return test::prism(static_cast<std::uint32_t>(row.corners), 0, row.size.z,
                     [&](double angle, double z) {
                       return Vec3d{row.size.x * (1 + std::cos(angle)) / 2,
                                    row.size.y * (1 + std::sin(angle)) / 2, z};
                     });
}

Vec3d on_grid(const Vec3d& mm) { return geometry::to_mm(*geometry::snap(mm)); }

/// Objects by name: "0", "1" … the things, then what is beside and before them.
std::vector<std::pair<std::string, geometry::TriangleMesh>> objects_of(const Row& row) {
  std::vector<std::pair<std::string, geometry::TriangleMesh>> all;
  for (int i = 0; i < row.count; ++i) {
    all.emplace_back(std::to_string(i), thing(row));
    for (Vec3d& v : all.back().second.vertices)
      v = row.on_grid ? on_grid(row.turned(v)) + on_grid(row.turned(row.step)) * i
                      : row.turned(v + row.step * i);
  }
  const Vec3d last = row.step * row.count;
  const double extent = row.size.x + row.size.y + row.size.z + std::abs(last.x) + std::abs(last.y) +
                        std::abs(last.z) + 10 * row.scale;
  if (row.neighbour) {
    const Vec3d at = row.toward * (row.size.y + std::abs(last.y) + 3);
    all.emplace_back("neighbour", test::box_mesh(at - row.size * 0.31, at + row.size * 0.37));
    for (Vec3d& v : all.back().second.vertices) v = row.turned(v);
  }
  all.emplace_back("plate", test::box_mesh({-6 * extent, -2 * extent - 5, -6 * extent},
                                           {6 * extent, -2 * extent, 6 * extent}));
  for (Vec3d& v : all.back().second.vertices) v = row.turned(v);
  return all;
}

/// The hidden lines that get ink, by name.
using HiddenInk = std::map<std::string, std::vector<drawing::Line>>;

HiddenInk hidden_ink(const Row& row, std::uint64_t order, const parallel::Context& context) {
  auto objects = objects_of(row);
  test::Draw draw(order);
  if (order != 0)
    for (std::size_t i = objects.size(); i > 1; --i)
      std::swap(objects[i - 1], objects[draw.below(i)]);
  test::ClashModel model;
  for (const auto& [name, mesh] : objects) model.object(name).body(mesh);
  const auto scene = model::make_scene(model.model, {}, context);
  hlr::View view;
  const Vec3d toward = row.turned(row.toward) * 700'000;
  view.direction = {std::llround(toward.x), std::llround(toward.y), std::llround(toward.z)};
  view.up = {0, 0, 1};
  const auto lines = hlr::draw(*scene, {}, view, {}, context);
  drawing::LayoutOptions layout;
  layout.scale = row.scale;
  // What lies on another thing by chance is drawn once, with that one.
  layout.remove_duplicates = false;
  const auto sheet = drawing::lay_out(*lines, model.model, layout, context);
  const auto ink = drawing::choose_ink(*sheet, {.hidden = true, .pens = drawing::Pens{}}, context);
  HiddenInk found;
  for (const drawing::Line& line : ink->lines)
    if (line.state != drawing::LineState::visible)
      found[objects[model::index(line.object)].first].push_back(line);
  return found;
}

/// How lines of one thing lie to those of another, seen from the viewer.
struct Moved {
  Vec3d by, toward;

  /// Up to what rounding to the grid makes of a place.
  [[nodiscard]] bool same_place(const Vec3d& a, const Vec3d& b) const {
    const Vec3d d = a + by - b;
    const Vec3d projected = d - toward * (dot(d, toward) / dot(toward, toward));
    constexpr double kRounding = 0.05;
    return dot(projected, projected) < kRounding * kRounding;
  }
  /// Whether each of some lines has its like among others.
  [[nodiscard]] bool have_all(const std::vector<drawing::Line>& lines,
                              const std::vector<drawing::Line>& others) const {
    return std::ranges::all_of(lines, [&](const drawing::Line& line) {
      return std::ranges::any_of(others, [&](const drawing::Line& other) {
        return same_place(line.a_mm, other.a_mm) && same_place(line.b_mm, other.b_mm);
      });
    });
  }
};

std::string text(const std::vector<drawing::Line>& lines, const Vec3d& moved) {
  std::ostringstream out;
  for (const drawing::Line& l : lines) {
    const Vec3d a = l.a_mm - moved, b = l.b_mm - moved;
    out << "  " << l.edge << ": " << a.x << ' ' << a.y << ' ' << a.z << " - " << b.x << ' ' << b.y
        << ' ' << b.z << '\n';
  }
  return out.str();
}

void expect_equal_things(const Row& row, const HiddenInk& ink) {
  const auto& first = ink.find("0");
  ASSERT_NE(first, ink.end());
  for (int i = 1; i < row.count; ++i) {
    const auto it = ink.find(std::to_string(i));
    ASSERT_NE(it, ink.end()) << i;
    const Vec3d moved = row.turned(row.step * i);
    const Vec3d toward = row.turned(row.toward);
    ASSERT_TRUE((Moved{moved, toward}.have_all(first->second, it->second)) &&
                (Moved{moved * -1, toward}.have_all(it->second, first->second)))
        << "first\n"
        << text(first->second, {}) << i << '\n'
        << text(it->second, moved);
  }
}

void expect_same(const HiddenInk& a, const HiddenInk& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [name, lines] : a) {
    const auto it = b.find(name);
    ASSERT_NE(it, b.end()) << name;
    ASSERT_EQ(lines.size(), it->second.size()) << name;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      ASSERT_EQ(lines[k].a_mm, it->second[k].a_mm) << name;
      ASSERT_EQ(lines[k].b_mm, it->second[k].b_mm) << name;
      ASSERT_EQ(lines[k].a_paper, it->second[k].a_paper) << name;
      ASSERT_EQ(lines[k].b_paper, it->second[k].b_paper) << name;
    }
  }
}

TEST(InkOfRows, EqualThingsHaveEqualInkInAnyOrderAndForAnyTeam) {
  parallel::Team team(3);
  for (std::uint64_t seed = 1; seed <= test::rounds<std::uint64_t>(150, 1500); ++seed) {
    test::Draw draw(seed);
    const Row row = random_row(draw);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << row);
    const HiddenInk ink = hidden_ink(row, 0, {});
    expect_equal_things(row, ink);
    expect_same(ink, hidden_ink(row, seed, {.team = &team}));
    if (HasFatalFailure()) return;
  }
}

// 12 mm wide and 12 mm apart at 1:50: each edge is within a pen's width of the next.
TEST(InkOfRows, EachOfFortyRungsKeepsOneSide) {
  const Row row{.scale = 50,
                .count = 40,
                .size = {12, 40, 30},
                .step = {24, 0, 3},
                .toward = {0, -1, 0},
                .neighbour = false};
  const HiddenInk ink = hidden_ink(row, 0, {});
  expect_equal_things(row, ink);
  EXPECT_EQ(ink.at("0").size(), 3U);
}

}  // namespace
}  // namespace strake
