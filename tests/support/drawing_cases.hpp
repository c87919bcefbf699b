// SPDX-License-Identifier: Apache-2.0
// Views and options at random for models that change, and what differs between two drawings.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "strake/hlr/hlr.hpp"
#include "support/changing_model.hpp"
#include "support/draw.hpp"
#include "support/lattice_scene.hpp"

namespace strake::test {

inline std::string difference_of_pieces(const hlr::Drawing& a, const hlr::Drawing& b) {
  if (a.pieces.size() != b.pieces.size())
    return std::to_string(a.pieces.size()) + " and " + std::to_string(b.pieces.size()) + " pieces";
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    const hlr::EdgePiece &p = a.pieces[i], &q = b.pieces[i];
    if (p.object != q.object || p.edge != q.edge || p.kind != q.kind || p.state != q.state ||
        p.other != q.other || p.a != q.a || p.b != q.b)
      return "piece " + std::to_string(i) + " of object " + std::to_string(model::index(p.object)) +
             ", edge " + std::to_string(p.edge);
  }
  return {};
}

inline bool same(const geometry::Ellipse& a, const geometry::Ellipse& b) {
  return a.centre == b.centre && a.u == b.u && a.v == b.v;
}

inline std::string difference_of_curves(const hlr::Curves& a, const hlr::Curves& b) {
  if (a.all.size() != b.all.size() || a.edges.size() != b.edges.size()) return "numbers of curves";
  for (std::size_t i = 0; i < a.all.size(); ++i)
    if (a.all[i].origin != b.all[i].origin || !same(a.all[i].at, b.all[i].at))
      return "curve " + std::to_string(i);
  for (std::size_t i = 0; i < a.edges.size(); ++i)
    if (a.edges[i].object != b.edges[i].object || a.edges[i].edge != b.edges[i].edge ||
        a.edges[i].curve != b.edges[i].curve)
      return "curved edge " + std::to_string(i);
  return {};
}

inline std::string difference_of_diagnostics(const Diagnostics& a, const Diagnostics& b) {
  if (a.kept().size() != b.kept().size() || a.counts().size() != b.counts().size())
    return "numbers of diagnostics";
  for (std::size_t i = 0; i < a.kept().size(); ++i) {
    const Diagnostic &p = a.kept()[i], &q = b.kept()[i];
    if (p.severity != q.severity || p.code != q.code || p.message != q.message ||
        p.where != q.where)
      return "diagnostic " + std::to_string(i);
  }
  for (std::size_t i = 0; i < a.counts().size(); ++i)
    if (a.counts()[i].code != b.counts()[i].code || a.counts()[i].count != b.counts()[i].count)
      return "count of diagnostics " + a.counts()[i].code;
  return {};
}

/// Returns what differs first; empty where nothing does but counters of the work.
inline std::string difference(const hlr::Drawing& a, const hlr::Drawing& b) {
  if (auto text = difference_of_pieces(a, b); !text.empty()) return text;
  if (auto text = difference_of_curves(a.curves, b.curves); !text.empty()) return text;
  if (auto text = difference_of_diagnostics(a.diagnostics, b.diagnostics); !text.empty())
    return text;
  if (a.left_out != b.left_out) return "edges left out";
  if (a.clipped_left_out != b.clipped_left_out) return "clipped pieces left out";
  if (a.counted != b.counted) return "lines counted";
  if (a.hatches != b.hatches) return "hatches";
  if (a.origin != b.origin) return "origin";
  if (a.account.fates != b.account.fates) return "fates";
  if (a.account.count != b.account.count) return "counts of fates";
  if (a.account.defects != b.account.defects) return "defects";
  if (a.account.in_part != b.account.in_part) return "objects in part";
  if (a.contact_distance_mm != b.contact_distance_mm) return "contact distance";
  if (a.sag_mm != b.sag_mm || a.weld_mm != b.weld_mm) return "sag or weld";
  const hlr::Counters &p = a.counters, &q = b.counters;
  if (p.feature_edges != q.feature_edges || p.specks != q.specks || p.left_out != q.left_out ||
      p.seams != q.seams || p.uncut_objects != q.uncut_objects)
    return "counters";
  return {};
}

inline hlr::View some_view(Draw& draw) {
  constexpr std::int64_t kMm = 1000;
  hlr::View view{.direction = direction_of(static_cast<std::uint32_t>(draw.below(16)))};
  if (draw.one_in(3)) view.direction = {0, 0, 1};
  if (draw.one_in(3)) {
    const std::int64_t from = draw.whole(0, ChangingModel::kLength / 2) * kMm;
    view.limits = geometry::Box3l{{from, -kMm, kMm}, {from + 60 * kMm, 6 * kMm, 7 * kMm + 500}};
  }
  if (draw.one_in(5)) {
    const geometry::Vec3l target{draw.whole(0, ChangingModel::kLength) * kMm, 4 * kMm, 4 * kMm};
    const geometry::Vec3l eye =
        target + geometry::Vec3l{draw.whole(-40, 41) * kMm, -draw.whole(3, 60) * kMm, 7 * kMm};
    geometry::Vec3l direction = eye - target;
    while (std::max({std::abs(direction.x), std::abs(direction.y), direction.z}) > (1 << 20))
      direction = {direction.x / 2, direction.y / 2, direction.z / 2};
    view.direction = direction;
    view.perspective = {.eye = eye, .target = target, .near_mm = 1};
  }
  if (draw.one_in(3)) view.sections.push_back({{0, 1, 0}, {0, 4 * kMm + draw.whole(0, 2), 0}});
  if (draw.one_in(6)) view.sections.push_back({{1, -2, 9}, {60 * kMm, 4 * kMm, 5 * kMm}});
  return view;
}

inline hlr::Options some_options(Draw& draw) {
  hlr::Options options;
  options.hidden = !draw.one_in(2);
  options.keep_specks = draw.one_in(5);
  options.stage = draw.one_in(10) ? hlr::Stage::local : hlr::Stage::global;
  options.smooth = static_cast<hlr::Smooth>(draw.below(3));
  options.intersections = draw.one_in(2) ? hlr::Intersections::primitives
                                         : static_cast<hlr::Intersections>(draw.below(4));
  if (draw.one_in(4)) options.contact_distance_mm = 0.4;
  if (draw.one_in(4)) options.contact_distance_mm = 0;
  if (draw.one_in(4)) options.own_polylines = hlr::OwnPolylines::hidden;
  if (draw.one_in(3)) options.sag_mm = 0.02;
  if (draw.one_in(16)) options.flush_seams = false;
  if (draw.one_in(4)) options.hatch_spacing_mm = draw.one_in(3) ? 0 : 0.75;
  options.culling = !draw.one_in(6);
  options.clipped = !draw.one_in(2);
  return options;
}

/// Gives some objects a hatch, and has sections leave some whole: always the same ones.
inline hlr::Options with_rules(hlr::Options options, const ChangingModel& changing) {
  for (const ChangingObject& one : changing.objects()) {
    options.uncut.push_back(one.identity % 7 == 3);
    options.hatches.emplace_back();
    if (one.identity % 5 == 1) options.hatches.back().angle_deg = 30;
    if (one.identity % 9 == 2) options.hatches.back().spacing_mm = one.identity % 2 == 0 ? 0 : 2;
  }
  return options;
}

}  // namespace strake::test
