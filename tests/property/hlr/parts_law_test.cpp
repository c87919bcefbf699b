// SPDX-License-Identifier: Apache-2.0
// A drawing that is put together of parts, which know nothing of each other, is the drawing of the
// whole, bit by bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hlr/incremental/extents.hpp"
#include "hlr/incremental/solve_part.hpp"
#include "hlr/parts/join_parts.hpp"
#include "hlr/parts/split_view.hpp"
#include "hlr/results/object_fates.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/team.hpp"
#include "support/changing_model.hpp"
#include "support/drawing_cases.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

using test::ChangingModel;
using test::Draw;

/// A view of a model, whole and by parts.
class SplitView {
 public:
  SplitView(const model::Model& model, const model::Scene& scene, std::vector<bool> drawn,
            hlr::View view, hlr::Options options)
      : model_(model),
        scene_(scene),
        drawn_(std::move(drawn)),
        view_(std::move(view)),
        options_(std::move(options)),
        whole_(hlr::whole_extent(scene_, drawn_, view_, options_, {}).value()) {
    if (view_.sections.empty()) return;
    sections_ = hlr::prepare_sections({scene_, drawn_, view_, options_}, {}).value();
  }

  [[nodiscard]] std::vector<hlr::ViewPart> split(std::uint64_t max_bytes) const {
    const std::vector<std::uint32_t> bytes(model_.objects.size(), 1000);
    return hlr::split_view({view_, options_, whole_.drawn.box, whole_.boxes, bytes}, max_bytes, {})
        .value();
  }

  [[nodiscard]] hlr::Drawing by_parts(const std::vector<hlr::ViewPart>& parts,
                                      const parallel::Context& context) const {
    std::vector<hlr::Drawing> solved;
    for (const hlr::ViewPart& part : parts) solved.push_back(solve(part, context));
    hlr::PartJoin join(model_.objects.size());
    for (std::size_t k = 0; k < parts.size(); ++k)
      EXPECT_TRUE(join.expect(counts_of(solved[k], parts[k]), parts[k].objects));
    EXPECT_TRUE(join.make_room(options_, {}));
    Diagnostics first_diagnostics;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      EXPECT_TRUE(
          join.add(solved[k], counts_of(solved[k], parts[k]), parts[k].objects, parts[k].to_solve));
      first_diagnostics = solved[k].diagnostics;
    }
    hlr::Drawing drawing = std::move(join).finish(scene_, drawn_, {}).value();
    drawing.origin = solved.back().origin;
    drawing.weld_mm = scene_.weld_mm;
    drawing.sag_mm = whole_.sag_mm;
    drawing.contact_distance_mm =
        view_.sections.empty() ? static_cast<double>(whole_.drawn.contact) * geometry::kMmPerGrid
                               : sections_.contact_distance_mm;
    drawing.hatches = sections_.hatches;
    drawing.counters.uncut_objects = sections_.uncut_objects;
    drawing.diagnostics = sections_.diagnostics;
    drawing.diagnostics.append(first_diagnostics);
    hlr::report_defects(model_, drawing.account, drawing.diagnostics);
    return drawing;
  }

 private:
  template <class T>
  static std::vector<T> of(const std::vector<T>& all, const std::vector<std::uint32_t>& objects) {
    std::vector<T> some;
    for (std::size_t i = 0; !all.empty() && i < objects.size(); ++i)
      some.push_back(all[objects[i]]);
    return some;
  }

  static hlr::PartCounts counts_of(const hlr::Drawing& drawing, const hlr::ViewPart& part) {
    return hlr::count_lines(drawing, part.objects.size());
  }

  /// Solves a part over a model of its own, as a worker that has nothing else.
  [[nodiscard]] hlr::Drawing solve(const hlr::ViewPart& part,
                                   const parallel::Context& context) const {
    model::Model model;
    model.files = model_.files;
    model.shapes = model_.shapes;
    std::vector<bool> finer;
    for (const std::uint32_t o : part.objects) {
      model::Object object = model_.objects[o];
      const std::size_t first = model.bodies.size();
      for (std::uint32_t b = 0; b < object.body_count; ++b)
        model.bodies.push_back(model_.bodies[object.first_body + b]);
      finer.resize(model.bodies.size());
      for (const model::GridBody& body : scene_.bodies_of(model::ObjectId{o}))
        finer[first + body.body - object.first_body] =
            whole_.tessellation.is_finer(body.grid_shape);
      object.first_body = static_cast<std::uint32_t>(first);
      model.objects.push_back(std::move(object));
    }
    const model::Scene scene = model::make_scene(model, {.sag_mm = 0.3}, context).value();
    const std::vector<hlr::Hatch> hatches = of(sections_.hatches, part.objects);
    hlr::WholeView whole = whole_.view_of(hatches);
    whole.to_solve = part.to_solve;
    whole.tessellation.any = whole_.tessellation.any;
    whole.tessellation.finer.resize(scene.shapes.size());
    for (const model::GridBody& body : scene.bodies)
      if (finer[body.body]) whole.tessellation.finer[body.grid_shape] = true;
    hlr::Options options = options_;
    options.hatches = of(options_.hatches, part.objects);
    options.uncut = of(options_.uncut, part.objects);
    const std::vector<bool> drawn(part.objects.size(), true);
    hlr::Drawing drawing = hlr::solve_part({scene, drawn, view_, options, &whole}, context).value();
    drawing.account = hlr::account_of(scene, part.to_solve, drawing, context).value();
    return drawing;
  }

  const model::Model& model_;
  const model::Scene& scene_;
  std::vector<bool> drawn_;
  hlr::View view_;
  hlr::Options options_;
  hlr::WholeExtent whole_;
  hlr::WholeSections sections_;
};

constexpr auto kModels = test::rounds<std::uint64_t>(25, 2000);

TEST(PartsLaw, APartedDrawingIsTheDrawingOfTheWhole) {
  parallel::Team team(3);
  std::uint64_t parts = 0, sectioned = 0, in_perspective = 0, shared = 0;
  for (std::uint64_t seed = 1; seed <= kModels; ++seed) {
    Draw draw(seed * 31);
    const ChangingModel changing(seed * 1009, 20 + draw.below(120));
    const model::Model model = changing.build();
    const hlr::View view = test::some_view(draw);
    hlr::Options options = test::some_options(draw);
    options.flush_seams = true;
    if (draw.one_in(2)) options = test::with_rules(options, changing);
    const model::Scene scene = model::make_scene(model, {.sag_mm = 0.3}, {}).value();
    const auto whole = hlr::draw(scene, changing.drawn(), view, options, {});
    if (!whole) continue;
    const SplitView split(model, scene, changing.drawn(), view, options);
    for (const std::uint64_t most :
         {std::uint64_t{1} << 40U, std::uint64_t{300'000}, std::uint64_t{60'000}}) {
      const std::vector<hlr::ViewPart> cut = split.split(most);
      ASSERT_TRUE(cut.size() == 1 || most < 1'000'000'000);
      ASSERT_EQ(test::difference(*whole, split.by_parts(cut, {.team = &team})), "")
          << "seed " << seed << ", " << cut.size() << " parts";
      parts += cut.size();
      for (const hlr::ViewPart& part : cut)
        shared += static_cast<std::uint64_t>(std::ranges::count(part.to_solve, false));
    }
    if (!view.sections.empty()) ++sectioned;
    if (view.perspective) ++in_perspective;
  }
  // Few objects lie in one part alone, and few are in all.
  EXPECT_GT(parts, 6 * kModels);
  EXPECT_GT(shared, 20 * kModels);
  EXPECT_GT(sectioned, kModels / 5);
  EXPECT_GT(in_perspective, kModels / 10);
}

/// Plates of one outline, one behind the other in no order: each half of them needs nearly all as
/// what may hide it.
TEST(SplitView, LeavesTogetherWhatIsNoSmallerInHalves) {
  constexpr std::int64_t kMm = 1000, kPlates = 200;
  std::vector<geometry::Box3l> boxes;
  geometry::Box3l drawn;
  for (std::int64_t i = 0; i < kPlates; ++i) {
    const std::int64_t z = i * 77 % kPlates * 100 * kMm;
    boxes.push_back({{0, 0, z}, {1000 * kMm, 1000 * kMm, z + 10 * kMm}});
    drawn.include(boxes.back());
  }
  const std::vector<std::uint32_t> bytes(kPlates, 3'000'000);
  hlr::View view;
  view.direction = {0, 0, -1};
  view.up = {0, 1, 0};
  const hlr::Options options;
  const auto split = [&](std::uint64_t most) {
    const auto parts = hlr::split_view({view, options, drawn, boxes, bytes}, most, {}).value();
    std::uint64_t all = 0, to_solve = 0;
    for (const hlr::ViewPart& part : parts) {
      all += part.bytes;
      to_solve += static_cast<std::uint64_t>(std::ranges::count(part.to_solve, true));
    }
    EXPECT_EQ(to_solve, boxes.size());
    return all;
  };
  EXPECT_LT(split(std::uint64_t{128} << 20U), 3 * split(std::uint64_t{1} << 40U));
}

}  // namespace
}  // namespace strake
