// SPDX-License-Identifier: Apache-2.0
#include "hlr/parts/join_parts.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "hlr/results/object_fates.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::hlr {

PartCounts count_lines(const Drawing& drawing, std::size_t objects) {
  PartCounts counts;
  for (auto* const column : {&counts.pieces, &counts.curved_edges, &counts.curves})
    column->resize(objects);
  for (const EdgePiece& piece : drawing.pieces) ++counts.pieces[model::index(piece.object)];
  // Curves stand in the order of the edges that lie on them first.
  std::uint32_t next = 0;
  for (const CurvedEdge& edge : drawing.curves.edges) {
    ++counts.curved_edges[model::index(edge.object)];
    if (edge.curve < next) continue;
    counts.curves[model::index(edge.object)] += edge.curve + 1 - next;
    next = edge.curve + 1;
  }
  return counts;
}

bool PartJoin::expect(const PartCounts& counts, std::span<const std::uint32_t> objects) {
  for (const auto* const column : {&counts.pieces, &counts.curved_edges, &counts.curves})
    if (column->size() != objects.size()) return false;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    First& at = first_[objects[i]];
    at.piece += counts.pieces[i];
    at.edge += counts.curved_edges[i];
    at.curve += counts.curves[i];
  }
  return true;
}

Status PartJoin::make_room(const Options& options, const parallel::Context& context) {
  First sum;
  for (First& at : first_) {
    const First count = at;
    at = sum;
    sum.piece += count.piece;
    sum.edge += count.edge;
    sum.curve += count.curve;
  }
  auto pieces = parallel::slots<EdgePiece>(sum.piece, context);
  if (!pieces) return pieces.error();
  drawing_.pieces = std::move(*pieces);
  drawing_.curves.edges.resize(sum.edge);
  drawing_.curves.all.resize(sum.curve);
  drawing_.account.fates.resize(first_.size());
  make_room_for_counts(options, first_.size(), drawing_);
  return {};
}

bool PartJoin::add(const Drawing& part, const PartCounts& counts,
                   std::span<const std::uint32_t> objects, const std::vector<bool>& to_solve) {
  const PartCounts found = count_lines(part, objects.size());
  if (found.pieces != counts.pieces || found.curved_edges != counts.curved_edges ||
      found.curves != counts.curves || part.counted.size() != objects.size() ||
      part.account.fates.size() != objects.size() ||
      part.left_out.size() != (drawing_.left_out.empty() ? 0 : objects.size()) ||
      part.clipped_left_out.size() != (drawing_.clipped_left_out.empty() ? 0 : objects.size()))
    return false;
  const auto whole = [&](model::ObjectId id) { return model::ObjectId{objects[index(id)]}; };
  std::size_t piece = 0, edge = 0, curve = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::uint32_t o = objects[i];
    if (!to_solve[i] && counts.pieces[i] + counts.curved_edges[i] > 0) return false;
    if (!to_solve[i]) continue;
    if (added_[o]) return false;
    added_[o] = true;
    const First& at = first_[o];
    for (std::uint32_t k = 0; k < counts.pieces[i]; ++k) {
      EdgePiece& to = drawing_.pieces[at.piece + k] = part.pieces[piece++];
      to.object = whole(to.object);
      to.other = whole(to.other);
    }
    for (std::uint32_t k = 0; k < counts.curved_edges[i]; ++k) {
      CurvedEdge& to = drawing_.curves.edges[at.edge + k] = part.curves.edges[edge++];
      to.object = whole(to.object);
      to.curve = static_cast<std::uint32_t>(to.curve - curve + at.curve);
    }
    for (std::uint32_t k = 0; k < counts.curves[i]; ++k)
      drawing_.curves.all[at.curve + k] = part.curves.all[curve++];
    drawing_.counted[o] = part.counted[i];
    if (!drawing_.left_out.empty()) drawing_.left_out[o] = part.left_out[i];
    if (!drawing_.clipped_left_out.empty()) drawing_.clipped_left_out[o] = part.clipped_left_out[i];
    drawing_.account.fates[o] = part.account.fates[i];
  }
  for (const Defect& defect : part.account.defects)
    drawing_.account.defects.push_back({whole(defect.object), defect.code});
  drawing_.account.in_part += part.account.in_part;
  add_counters(part.counters);
  return true;
}

void PartJoin::add_counters(const Counters& counters) {
  Counters& sum = drawing_.counters;
  for (const auto count :
       {&Counters::covered_edges, &Counters::face_tests, &Counters::exact_fallbacks,
        &Counters::crossing_pairs, &Counters::crossing_tests, &Counters::shared_shapes,
        &Counters::shared_bodies})
    sum.*count += counters.*count;
}

Result<Drawing> PartJoin::finish(const model::Scene& scene, const std::vector<bool>& drawn,
                                 const parallel::Context& context) && {
  // Objects without a place on the grid are in no part.
  std::vector<bool> rest(first_.size());
  for (std::size_t o = 0; o < rest.size(); ++o) rest[o] = drawn[o] && !added_[o];
  const Result<Account> of_rest = account_of(scene, rest, Drawing(), context);
  if (!of_rest) return of_rest.error();
  Account& account = drawing_.account;
  for (std::size_t o = 0; o < rest.size(); ++o)
    if (rest[o]) account.fates[o] = of_rest->fates[o];
  account.count = {};
  for (const Fate fate : account.fates) ++account.count[static_cast<std::size_t>(fate)];
  account.in_part += of_rest->in_part;
  account.defects.insert(account.defects.end(), of_rest->defects.begin(), of_rest->defects.end());
  // An object has at most one defect of a code, and they stand by code.
  std::ranges::sort(account.defects, [](const Defect& x, const Defect& y) {
    return x.object != y.object ? x.object < y.object : x.code < y.code;
  });
  sum_up_lines(drawing_);
  return std::move(drawing_);
}

}  // namespace strake::hlr
