// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <utility>

#include "generate/ship_plan.hpp"

namespace strake::generate {
namespace {

using geometry::Vec3d;

constexpr double kRest = 2100;      ///< top of the cross-bars that runs lie on, above the deck
constexpr double kPipeJoint = 800;  ///< flange faces, from the start of a bay
constexpr double kTrayJoint = 500;
constexpr double kDuctJoint = 1000;
/// A flange is longer than the clearance: a pipe never comes near the next pipe's end through
/// flanges.
constexpr double kFlangeLength = 30;
constexpr double kRunEnd = 100;  ///< runs stop this far before the end of the last deck above

constexpr std::array<PipeSize, 4> kPipeSizes{{{30, 60}, {45, 80}, {57, 95}, {84, 125}}};

/// The layout of one run of a lane, the same in all bays.
struct PipeRun {
  PipeSize size;
  double v = 0;  ///< the position of the axis across the lane
};

struct LaneRuns {
  std::vector<PipeRun> pipes;
  bool tray = false, duct = false;
};

LaneRuns choose_runs(const ShipPlan& plan, int lane, int level) {
  Random random = plan.random(21, 0, lane, level);
  LaneRuns runs;
  double v = 390;
  while (true) {
    const PipeSize& size = kPipeSizes[random.below(kPipeSizes.size())];
    if (v + 2 * size.flange > 1940) break;
    runs.pipes.push_back({size, v + size.flange});
    v += 2 * size.flange + random.between(30, 90);
  }
  runs.tray = !random.chance(15);
  runs.duct = !random.chance(20);
  for (int extra = 0; extra < 2; ++extra)
    if (random.chance(70)) runs.pipes.push_back({kPipeSizes[0], 3230.0 + 160 * extra});
  return runs;
}

/// Builds one lane's runs below one deck bay by bay, and keeps what the next bay joins on to.
class LaneBuilder {
 public:
  LaneBuilder(const ShipPlan& plan, ShipBuilder& builder, int lane, int level)
      : plan_(plan),
        yard_(builder),
        lane_(lane),
        level_(level),
        bays_(plan.deck_bays(level + 1)),
        runs_(choose_runs(plan, lane, level)),
        pipe_end_(runs_.pipes.size(), kNothing) {}

  void build(const Steel& steel) {
    for (int bay = 0; bay < bays_; ++bay) {
      const Site site = plan_.site(yard_, bay, lane_, level_);
      const Handle bar = build_support(site, steel.beam(level_, bay, lane_));
      for (std::size_t p = 0; p < runs_.pipes.size(); ++p) build_pipe(site, bay, p, bar);
      if (runs_.tray) build_tray(site, bay, bar);
      if (runs_.duct) build_duct(site, bay, bar);
    }
  }

 private:
  [[nodiscard]] bool last(int bay) const { return bay + 1 == bays_; }
  [[nodiscard]] double end(int bay, double joint) const {
    return last(bay) ? kBay - kRunEnd : kBay + joint;
  }

  static Handle build_support(const Site& site, Handle beam) {
    const double u = kBeamAt;
    const Handle bar =
        site.box(ObjectKind::support, {u - 30, 300, kRest - 50}, {u + 30, 3700, kRest});
    for (const double v : {300.0, 1970.0, 3640.0}) {
      const Handle hanger =
          site.box(ObjectKind::hanger, {u - 10, v, kRest}, {u + 10, v + 60, kBeamFlangeUnder});
      site.builder->weld(hanger, bar);
      site.builder->weld(hanger, beam);
    }
    return bar;
  }

  void build_pipe(const Site& site, int bay, std::size_t p, Handle bar) {
    const PipeRun& run = runs_.pipes[p];
    const double h = kRest + run.size.r;
    const Site line = site.moved({0, run.v, h});
    if (bay == 0) {
      const double stub = kPipeJoint - kFlangeLength - kRunEnd;
      const Handle pipe =
          line.bar(ObjectKind::pipe, run.size.r, stub, facing(FacingAxis::along, {kRunEnd, 0, 0}));
      pipe_end_[p] = pipe;
    }
    const Handle before = flange(line, run.size, kPipeJoint - kFlangeLength);
    yard_.weld(before, pipe_end_[p]);
    const Handle after = flange(line, run.size, kPipeJoint);
    yard_.bolt(before, after);
    const double from = kPipeJoint + kFlangeLength;
    const double to = last(bay) ? kBay - kRunEnd : kBay + kPipeJoint - kFlangeLength;
    Random random = plan_.random(22, bay, lane_ * 64 + static_cast<int>(p), level_);
    const bool valve = run.size.r > 40 && random.chance(30);
    pipe_end_[p] = valve ? valved_pipe(line, run.size, {after, bar, from, to})
                         : plain_pipe(line, run.size, {after, bar, from, to});
    const std::array<Vec3d, 2> axis{{{bay == 0 ? kRunEnd : kPipeJoint, 0, 0},
                                     {last(bay) ? kBay - kRunEnd : kBay + kPipeJoint, 0, 0}}};
    line.centre_line(axis);
  }

  struct PipeSpan {
    Handle start = kNothing, bar = kNothing;
    double from = 0, to = 0;
  };

  static Handle flange(const Site& line, const PipeSize& size, double x) {
    return line.bar(ObjectKind::flange, size.flange, kFlangeLength,
                    facing(FacingAxis::along, {x, 0, 0}));
  }

  Handle plain_pipe(const Site& line, const PipeSize& size, const PipeSpan& span) const {
    const Handle pipe = line.bar(ObjectKind::pipe, size.r, span.to - span.from,
                                 facing(FacingAxis::along, {span.from, 0, 0}));
    yard_.weld(pipe, span.start);
    yard_.rest(pipe, span.bar);
    return pipe;
  }

  /// Builds pipe, flange, valve, flange, pipe.
  Handle valved_pipe(const Site& line, const PipeSize& size, const PipeSpan& span) const {
    constexpr double kValveAt = 2000, kValve = 300;
    const Handle first = plain_pipe(line, size, {span.start, span.bar, span.from, kValveAt});
    const Handle in = flange(line, size, kValveAt);
    const Handle valve = build_valve(line, size, kValve, at({kValveAt + kFlangeLength, 0, 0}));
    const Handle out = flange(line, size, kValveAt + kFlangeLength + kValve);
    const double rest = kValveAt + 2 * kFlangeLength + kValve;
    const Handle second =
        line.bar(ObjectKind::pipe, size.r, span.to - rest, facing(FacingAxis::along, {rest, 0, 0}));
    yard_.weld(first, in);
    yard_.bolt(in, valve);
    yard_.bolt(valve, out);
    yard_.weld(out, second);
    return second;
  }

  /// Builds a ladder tray: two rails, rungs between; cables lie on the rungs.
  void build_tray(const Site& site, int bay, Handle bar) {
    const double from = bay == 0 ? kRunEnd : kTrayJoint, to = end(bay, kTrayJoint);
    constexpr double kWidth = 400, kRail = 6, kRung = 40;
    const std::uint32_t shape = yard_.shape({2002, um(to - from)}, [&] {
      MicrometreMesh mesh = make_box(grid({to - from, kRail, 60}));
      append(mesh, make_box(grid({to - from, kRail, 60})), grid({0, kWidth - kRail, 0}));
      for (double u = 130; u + 130 < to - from; u += 250)
        append(mesh, make_box(grid({30, kWidth - 2 * kRail, 12})), grid({u, kRail, kRung - 12}));
      return mesh;
    });
    const Site line = site.moved({from, 2080, kRest});
    const Handle tray = yard_.add(ObjectKind::cable_tray, line.cell, shape, line.frame);
    yard_.fit(tray, tray_end_);
    yard_.rest(tray, bar);
    tray_end_ = tray;
    constexpr std::array<std::pair<double, double>, 3> kCables{{{70, 20}, {170, 28}, {280, 24}}};
    for (std::size_t c = 0; c < kCables.size(); ++c) {
      const auto [v, r] = kCables[c];
      const Handle cable = line.bar(ObjectKind::cable, r, to - from,
                                    facing(FacingAxis::along, {0, v, kRung + r}), 12);
      yard_.rest(cable, tray);
      yard_.fit(cable, cable_end_[c]);
      cable_end_[c] = cable;
    }
  }

  void build_duct(const Site& site, int bay, Handle bar) {
    constexpr double kWide = 500, kHigh = 250, kWall = 4, kRim = 30;
    const Site line = site.moved({0, 2560, kRest});
    const auto rim = [&](double x) {
      const std::uint32_t shape = yard_.shape({2003}, [&] {
        const OutlinePolygon outer{{um(-kRim), um(-kRim)},
                                   {um(kWide + kRim), um(-kRim)},
                                   {um(kWide + kRim), um(kHigh + kRim)},
                                   {um(-kRim), um(kHigh + kRim)}};
        const std::array<OutlinePolygon, 1> bore{{{{um(kWall), um(kWall)},
                                                   {um(kWide - kWall), um(kWall)},
                                                   {um(kWide - kWall), um(kHigh - kWall)},
                                                   {um(kWall), um(kHigh - kWall)}}}};
        return extrude(outer, bore, um(kFlangeLength));
      });
      return yard_.add(ObjectKind::duct_flange, line.cell, shape,
                       line.frame * facing(FacingAxis::along, {x, 0, 0}));
    };
    if (bay == 0)
      duct_end_ = line.tube(ObjectKind::duct, {kWide, kHigh, kDuctJoint - kFlangeLength - kRunEnd},
                            kWall, facing(FacingAxis::along, {kRunEnd, 0, 0}));
    const Handle before = rim(kDuctJoint - kFlangeLength), after = rim(kDuctJoint);
    yard_.weld(before, duct_end_);
    yard_.bolt(before, after);
    const double from = kDuctJoint + kFlangeLength;
    const double to = last(bay) ? kBay - kRunEnd : kBay + kDuctJoint - kFlangeLength;
    duct_end_ = line.tube(ObjectKind::duct, {kWide, kHigh, to - from}, kWall,
                          facing(FacingAxis::along, {from, 0, 0}));
    yard_.weld(after, duct_end_);
    yard_.rest(duct_end_, bar);
  }

  const ShipPlan& plan_;
  ShipBuilder& yard_;
  int lane_, level_, bays_;
  LaneRuns runs_;
  std::vector<Handle> pipe_end_;
  Handle tray_end_ = kNothing, duct_end_ = kNothing;
  std::array<Handle, 3> cable_end_{kNothing, kNothing, kNothing};
};

}  // namespace

Handle build_valve(const Site& site, const PipeSize& size, double length, const AxisFrame& where) {
  const std::int64_t r = um(size.r), big = um(size.flange - 10), l = um(length);
  const std::uint32_t shape = site.builder->shape({2001, r, big, l}, [&] {
    const std::array<RevolutionPoint, 6> body{
        {{r, 0}, {r, l / 6}, {big, l * 3 / 8}, {big, l * 5 / 8}, {r, l * 5 / 6}, {r, l}}};
    MicrometreMesh mesh = cycled(revolve(body, 24), 1);
    // The bonnet stands on the body's upper flat; the stem carries a hand wheel.
    const std::int64_t stem = um(12), wheel = um(size.flange - 20);
    const std::array<RevolutionPoint, 8> bonnet{{{um(20), 0},
                                                 {um(20), um(20)},
                                                 {stem, um(30)},
                                                 {stem, um(50)},
                                                 {wheel, um(50)},
                                                 {wheel, um(62)},
                                                 {stem, um(62)},
                                                 {stem, um(75)}}};
    append(mesh, revolve(bonnet, 24), {l / 2, 0, big});
    return mesh;
  });
  return site.builder->add(ObjectKind::valve, site.cell, shape, site.frame * where);
}

void build_runs(const ShipPlan& plan, const Steel& steel, ShipBuilder& builder) {
  for (int level = 0; level < plan.levels; ++level)
    for (int lane = 0; lane < plan.lanes; ++lane)
      LaneBuilder(plan, builder, lane, level).build(steel);
}

void build_ballast(const ShipPlan& plan, ShipBuilder& builder) {
  constexpr double kRadius = 110, kRim = 160;
  for (int lane = 0; lane < plan.lanes; ++lane) {
    Handle end = kNothing;
    for (int bay = 0; bay < plan.bays; ++bay) {
      const Site line{&builder, ShipPlan::cell(bay, lane, 0),
                      at({plan.x(bay), plan.y(lane) + 2000, 885})};
      const double from = bay == 0 ? kRunEnd : kPipeJoint + kFlangeLength;
      const double to = bay + 1 == plan.bays ? kBay - kRunEnd : kBay + kPipeJoint - kFlangeLength;
      Handle after = kNothing;
      if (bay > 0) {
        const Handle before =
            line.bar(ObjectKind::ballast_pipe, kRim, kFlangeLength,
                     facing(FacingAxis::along, {kPipeJoint - kFlangeLength, 0, 0}));
        after = line.bar(ObjectKind::ballast_pipe, kRim, kFlangeLength,
                         facing(FacingAxis::along, {kPipeJoint, 0, 0}));
        builder.weld(before, end);
        builder.bolt(before, after);
      }
      end = line.bar(ObjectKind::ballast_pipe, kRadius, to - from,
                     facing(FacingAxis::along, {from, 0, 0}));
      builder.weld(end, after);
    }
  }
}

}  // namespace strake::generate
