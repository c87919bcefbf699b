// SPDX-License-Identifier: Apache-2.0
#include "hlr/seams/flush_seams.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <tuple>

#include "hlr/seams/joined_faces.hpp"
#include "hlr/sections/sectioned_shapes.hpp"
#include "strake/geometry/part.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::hlr {
namespace {

using geometry::Int128;
using geometry::Segment;
using geometry::Vec3l;
using SeamInterval = std::pair<Int128, Int128>;

/// Decides along one edge where the faces round it join flat.
class SeamOfEdge {
 public:
  /// `shared`: all of what is shared with that edge.
  SeamOfEdge(const std::vector<SeamSurface>& surfaces, std::span<const SharedLine> shared)
      : surfaces_(surfaces), shared_(shared) {
    const SharedLine& first = shared.front();
    const SeamSurface& own = surfaces[first.surface];
    seam_.emplace(FlushSeam{.body = own.body,
                            .part = own.part,
                            .edge = first.edge,
                            .on = LineMeasure(edge_line(own.placed, first.edge)),
                            .intervals = {}});
    for (const SharedLine& line : shared) seam_->contact = std::max(seam_->contact, line.contact);
  }

  /// Returns nothing where no place of the edge is a flush seam.
  std::optional<FlushSeam> run() {
    std::vector<Int128> cuts;
    for (const SharedLine& line : shared_) {
      cuts.push_back(line.from);
      cuts.push_back(line.to);
    }
    std::ranges::sort(cuts);
    cuts.erase(std::ranges::unique(cuts).begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      if (is_flat(cuts[i], cuts[i + 1])) add(cuts[i], cuts[i + 1]);
    if (seam_->intervals.empty()) return std::nullopt;
    return std::move(seam_);
  }

 private:
  void add_faces(std::uint32_t surface, std::uint32_t edge) {
    const SeamSurface& of = surfaces_[surface];
    const geometry::Part& part = *of.placed.part;
    for (const std::uint32_t t : geometry::incident_triangles(part, edge)) {
      SeamFace face{.surface = surface,
                    .solid = part.kind == geometry::PartKind::solid,
                    .contact = of.contact};
      for (std::size_t k = 0; k < 3; ++k)
        face.corners[k] = part.vertices[part.triangles[t][k]].as<std::int64_t>() + of.placed.origin;
      faces_.push_back(face);
    }
  }

  bool is_flat(Int128 from, Int128 to) {
    faces_.clear();
    add_faces(shared_.front().surface, shared_.front().edge);
    const std::size_t own = faces_.size();
    for (const SharedLine& line : shared_)
      if (line.from <= from && to <= line.to) add_faces(line.other, line.along);
    return faces_.size() > own && join_flat(seam_->on.line, faces_);
  }

  /// Adds an interval, joined with the last one where that is within the contact distance.
  void add(Int128 from, Int128 to) {
    std::vector<SeamInterval>& all = seam_->intervals;
    if (!all.empty() && from <= all.back().second + seam_->on.room(seam_->contact))
      all.back().second = to;
    else
      all.emplace_back(from, to);
  }

  const std::vector<SeamSurface>& surfaces_;
  std::span<const SharedLine> shared_;
  std::optional<FlushSeam> seam_;
  std::vector<SeamFace> faces_;
};

/// Returns where the lines of each edge begin, and the end.
std::vector<std::size_t> starts_of_edges(const std::vector<SharedLine>& shared) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < shared.size(); ++i)
    if (i == 0 || std::tie(shared[i].surface, shared[i].edge) !=
                      std::tie(shared[i - 1].surface, shared[i - 1].edge))
      starts.push_back(i);
  starts.push_back(shared.size());
  return starts;
}

}  // namespace

Result<std::vector<FlushSeam>> find_flush_seams(const ViewJob& job,
                                                const parallel::Context& context) {
  const std::vector<SeamSurface> surfaces = seam_surfaces(job);
  const auto shared = find_shared_lines(job, surfaces, context);
  if (!shared) return shared.error();
  const std::vector<std::size_t> starts = starts_of_edges(*shared);
  auto found = parallel::transform(
      context, {.name = "seams: edges", .n = starts.size() - 1, .grain = 256}, [&](std::size_t i) {
        return SeamOfEdge(surfaces,
                          std::span(*shared).subspan(starts[i], starts[i + 1] - starts[i]))
            .run();
      });
  if (!found) return found.error();
  std::vector<FlushSeam> seams;
  for (std::optional<FlushSeam>& seam : *found)
    if (seam) seams.push_back(std::move(*seam));
  return seams;
}

namespace {

/// An edge or a line of the drawing that has a flush seam.
struct DrawnSeam {
  model::ObjectId object{};
  std::uint32_t edge = 0;  ///< as EdgePiece::edge
  const FlushSeam* seam = nullptr;
};

/// Returns whether a line lies on an edge but for the rounding of section planes.
bool lies_on(const Segment& line, const LineMeasure& on, std::int64_t rounded) {
  const Int128 room = on.room(rounded);
  return std::ranges::all_of(line, [&](const Vec3l& end) {
    const Int128 place = on.along(end);
    return -room <= place && place <= on.length + room && on.passes(end, rounded);
  });
}

/// Finds the seam of an edge of the drawing among those of its body. A part that is cut has other
/// numbers for its edges, which are found by their places.
const FlushSeam* seam_of(const FeatureEdge& edge, const SectionedShape& sectioned,
                         const Vec3l& origin, std::span<const FlushSeam> of_body) {
  if (!sectioned.cut) {
    const auto number = std::pair(edge.part, edge.part_edge);
    const auto found = std::ranges::lower_bound(
        of_body, number, {}, [](const FlushSeam& s) { return std::pair(s.part, s.edge); });
    return found != of_body.end() && std::pair(found->part, found->edge) == number ? &*found
                                                                                   : nullptr;
  }
  const Segment line{edge.a.as<std::int64_t>() + origin, edge.b.as<std::int64_t>() + origin};
  const auto rounded = static_cast<std::int64_t>(sectioned.planes.size());
  const auto found = std::ranges::find_if(of_body, [&](const FlushSeam& seam) {
    return seam.part == edge.part && lies_on(line, seam.on, rounded);
  });
  return found != of_body.end() ? &*found : nullptr;
}

/// Finds the edges and intersection lines of the drawing that have flush seams.
class DrawnSeams {
 public:
  /// `seams`: those of all objects.
  DrawnSeams(const ViewJob& job, std::span<const FlushSeam> seams) : job_(job), seams_(seams) {}

  /// Appends those of one object.
  Status add(std::uint32_t object, std::vector<DrawnSeam>& out) const {
    const model::Scene& scene = *job_.scene;
    std::uint32_t number = 0;
    for (std::uint32_t b = scene.first_body[object]; b < scene.first_body[object + 1]; ++b) {
      const SectionedShape& sectioned = job_.sectioned_shape_of(b);
      const auto edges = sectioned_edges(sectioned, job_.features_of(scene.bodies[b]), {});
      if (!edges) return edges.error();
      const std::span<const FlushSeam> own = of_body(b);
      for (const FeatureEdge& edge : *edges)
        push(object, number++, seam_of(edge, sectioned, scene.bodies[b].origin, own), out);
    }
    for (const Line& line : job_.lines.of(object)) push(object, number++, seam_along(line), out);
    return {};
  }

 private:
  [[nodiscard]] std::span<const FlushSeam> of_body(std::uint32_t body) const {
    const auto own = std::ranges::equal_range(seams_, body, {}, &FlushSeam::body);
    return {own.begin(), own.end()};
  }

  static void push(std::uint32_t object, std::uint32_t number, const FlushSeam* seam,
                   std::vector<DrawnSeam>& out) {
    if (seam != nullptr) out.push_back({model::ObjectId{object}, number, seam});
  }

  /// Finds the seam along which an intersection runs that rounding made of two skins that touch:
  /// both of its bodies have one there.
  [[nodiscard]] const FlushSeam* seam_along(const Line& line) const {
    if (line.kind != EdgeKind::intersection) return nullptr;
    const auto along = [&](std::uint32_t body) -> const FlushSeam* {
      const std::span<const FlushSeam> own = of_body(body);
      const auto found = std::ranges::find_if(own, [&](const FlushSeam& seam) {
        return lies_on({line.a, line.b}, seam.on, std::max(seam.contact, job_.lines.contact));
      });
      return found != own.end() ? &*found : nullptr;
    };
    const FlushSeam* const seam = along(line.body_a);
    return seam != nullptr && along(line.body_b) != nullptr ? seam : nullptr;
  }

  const ViewJob& job_;
  std::span<const FlushSeam> seams_;
};

Result<std::vector<DrawnSeam>> drawn_seams(const ViewJob& job, std::span<const FlushSeam> seams,
                                           const parallel::Context& context) {
  std::vector<std::uint32_t> objects;
  for (const FlushSeam& seam : seams)
    objects.push_back(model::index(job.scene->bodies[seam.body].object));
  objects.erase(std::ranges::unique(objects).begin(), objects.end());
  const DrawnSeams drawn(job, seams);
  return parallel::collect<DrawnSeam>(
      context, {.name = "seams: drawn edges", .n = objects.size()},
      [&](std::size_t i, std::vector<DrawnSeam>& out) { return drawn.add(objects[i], out); });
}

/// Appends what a seam leaves of a piece that runs along its edge; returns whether that is less
/// than all.
bool append_rest(const EdgePiece& piece, const FlushSeam& seam, std::vector<EdgePiece>& out) {
  const Int128 room = seam.on.room(seam.contact);
  const Int128 begin = seam.on.along(piece.a), end = seam.on.along(piece.b);
  Int128 from = begin;
  bool any = false;
  const auto keep = [&](Int128 to) {
    if (to - from <= room) return;
    out.push_back(piece);
    if (from != begin) out.back().a = seam.on.at(from);
    if (to != end) out.back().b = seam.on.at(to);
  };
  for (const auto& [first, last] : seam.intervals) {
    if (last <= from || end <= first) continue;
    keep(first);
    from = last;
    any = true;
  }
  if (any)
    keep(end);
  else
    out.push_back(piece);
  return any;
}

/// The same for a piece that may run either way, as intersections do.
bool append_rest_either_way(EdgePiece piece, const FlushSeam& seam, std::vector<EdgePiece>& out) {
  if (seam.on.along(piece.a) <= seam.on.along(piece.b)) return append_rest(piece, seam, out);
  const auto turn = [](EdgePiece& p) { std::swap(p.a, p.b); };
  turn(piece);
  const auto before = static_cast<std::ptrdiff_t>(out.size());
  const bool any = append_rest(piece, seam, out);
  std::for_each(out.begin() + before, out.end(), turn);
  std::reverse(out.begin() + before, out.end());
  return any;
}

}  // namespace

Status leave_out_flush_seams(const ViewJob& job, const parallel::Context& context,
                             Drawing& drawing) {
  const auto seams = find_flush_seams(job, context);
  if (!seams) return seams.error();
  const auto drawn = drawn_seams(job, *seams, context);
  if (!drawn) return drawn.error();
  std::vector<EdgePiece> rest;
  rest.reserve(drawing.pieces.size());
  std::size_t next = 0;
  const DrawnSeam* last = nullptr;
  for (const EdgePiece& piece : drawing.pieces) {
    const auto key = std::tuple(piece.object, piece.edge);
    while (next < drawn->size() && std::tuple((*drawn)[next].object, (*drawn)[next].edge) < key)
      ++next;
    const DrawnSeam* const at = next < drawn->size() ? &(*drawn)[next] : nullptr;
    if (at == nullptr || std::tuple(at->object, at->edge) != key) {
      rest.push_back(piece);
    } else if (append_rest_either_way(piece, *at->seam, rest) && at != last) {
      ++drawing.counters.seams;
      last = at;
    }
  }
  drawing.pieces = std::move(rest);
  return {};
}

}  // namespace strake::hlr
