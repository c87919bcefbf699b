// SPDX-License-Identifier: Apache-2.0
#include "geometry/plane_section/plane_section.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include "geometry/mesh_repair/make_part.hpp"
#include "geometry/plane_section/section_caps.hpp"
#include "geometry/predicates/exact_normal.hpp"

namespace strake::geometry {
namespace {

using plane_section::Directed;
using plane_section::OutlineSegment;

/// Numbers from here on stand for the caps of planes, those below for triangles of the source.
constexpr std::uint32_t kCap = 0x80000000U;

/// A part while planes cut it.
class PlaneCutter {
 public:
  explicit PlaneCutter(const Part& part) : part_(part) {
    vertices_.reserve(part.vertices.size());
    for (const Vec3i& v : part.vertices) vertices_.push_back(v.as<std::int64_t>());
    triangles_ = part.triangles.to_vector();
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) source_.push_back(t);
    closed_ = part.kind == PartKind::solid;
  }

  void cut(const CutPlane& plane, std::uint32_t number) {
    measure(plane);
    clip_lines(plane);
    if (std::ranges::all_of(heights_, [](std::int64_t h) { return h < 0; })) return;
    exact_ = true;
    points_.clear();
    stretches_.clear();
    std::vector<Triangle> whole = std::exchange(triangles_, {});
    std::vector<std::uint32_t> sources = std::exchange(source_, {});
    for (std::size_t t = 0; t < whole.size(); ++t) keep(plane, whole[t], sources[t]);
    if (!exact_) ++result_.rounded;
    weld();
    draw(number);
    if (closed_) triangulate_cap(plane, number);
    drop_degenerate();
  }

  PartSection finished() {
    stretches_.clear();
    weld();
    for (const std::uint32_t s : source_) result_.cap_of.push_back(s < kCap ? kNoIndex : s - kCap);
    drop_unused();
    GridMesh mesh;
    for (const Vec3l& v : vertices_) mesh.vertices.push_back(v.as<std::int32_t>());
    mesh.triangles = std::move(triangles_);
    const PartKind kind = closed_ ? PartKind::solid : PartKind::sheet;
    if (mesh.triangles.empty()) {
      result_.part.kind = kind;
    } else {
      TopologyScratch scratch;
      const Topology topology = make_topology(mesh.vertices.size(), mesh.triangles, scratch);
      const __int128 volume = closed_ ? signed_volume_6(mesh.vertices, mesh.triangles) : 0;
      result_.part = make_part(
          kind,
          {mesh, topology, label_shells(mesh.vertices, mesh.triangles, topology, scratch), volume});
    }
    result_.part.flags.unknown_sag = part_.flags.unknown_sag;
    result_.part.sag = part_.sag;
    std::ranges::sort(result_.lines);
    return std::move(result_);
  }

 private:
  void measure(const CutPlane& plane) {
    heights_.clear();
    for (const Vec3l& v : vertices_) heights_.push_back(plane.height(v));
  }

  void clip_lines(const CutPlane& plane) {
    std::vector<SectionLine> left;
    for (const SectionLine& line : result_.lines)
      if (const auto at = left_of(line.at, {&plane, 1})) left.push_back({*at, line.plane});
    for (SectionLine& line : left)
      if (line.at[1] < line.at[0]) std::swap(line.at[0], line.at[1]);
    result_.lines = std::move(left);
  }

  /// The vertex where an edge from below meets the plane.
  std::uint32_t meet(const CutPlane& plane, std::uint32_t below, std::uint32_t other) {
    if (heights_[other] == 0) return other;
    const auto [it, added] =
        points_.try_emplace((std::uint64_t{below} << 32U) | other, vertices_.size());
    if (added) {
      const plane_section::RoundedPoint p =
          plane_section::meeting_point(plane, vertices_[below], vertices_[other]);
      exact_ = exact_ && p.exact;
      vertices_.push_back(p.at);
    }
    return it->second;
  }

  void add(const Triangle& t, std::uint32_t source) {
    triangles_.push_back(t);
    source_.push_back(source);
  }

  void keep(const CutPlane& plane, Triangle t, std::uint32_t source) {
    const auto below = [&](std::uint32_t v) { return heights_[v] < 0; };
    const auto count = std::ranges::count_if(t, below);
    if (count == 3) return add(t, source);
    if (count == 0) return;
    // The odd one out comes first.
    while (below(t[0]) != (count == 1)) std::rotate(t.begin(), t.begin() + 1, t.end());
    if (count == 1) {
      const std::uint32_t p = meet(plane, t[0], t[1]), q = meet(plane, t[0], t[2]);
      add({t[0], p, q}, source);
      stretches_.push_back({{p, q}, source});
      return;
    }
    const std::uint32_t p = meet(plane, t[2], t[0]), q = meet(plane, t[1], t[0]);
    // The diagonal from the lower vertex: it does not depend on where the triangle starts.
    if (vertices_[t[1]] < vertices_[t[2]]) {
      add({t[1], t[2], p}, source);
      add({t[1], p, q}, source);
    } else {
      add({t[1], t[2], q}, source);
      add({t[2], p, q}, source);
    }
    stretches_.push_back({{p, q}, source});
  }

  /// Vertices that are one point become one.
  void weld() {
    std::vector<std::uint32_t> order(vertices_.size());
    for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
      return vertices_[a] != vertices_[b] ? vertices_[a] < vertices_[b] : a < b;
    });
    std::vector<std::uint32_t> number(vertices_.size());
    std::vector<Vec3l> welded;
    for (const std::uint32_t v : order) {
      if (welded.empty() || welded.back() != vertices_[v]) welded.push_back(vertices_[v]);
      number[v] = static_cast<std::uint32_t>(welded.size() - 1);
    }
    vertices_ = std::move(welded);
    for (Triangle& t : triangles_)
      for (std::uint32_t& v : t) v = number[v];
    for (OutlineSegment& s : stretches_)
      for (std::uint32_t& v : s.ends) v = number[v];
    std::erase_if(stretches_, [](const OutlineSegment& s) { return s.ends[0] == s.ends[1]; });
  }

  void draw(std::uint32_t number) {
    const plane_section::SectionOutline outline = plane_section::find_outline(
        stretches_, vertices_, [&](std::uint32_t s, std::uint32_t t) { return coplanar(s, t); });
    for (const Segment& line : outline.lines) result_.lines.push_back({line, number});
    if (!closed_) result_.open_ends += outline.open_ends;
  }

  /// Whether two triangles of the source, or pieces of caps, lie in one plane and face one way.
  [[nodiscard]] bool coplanar(std::uint32_t s, std::uint32_t t) const {
    if (s == t) return true;
    if (s >= kCap || t >= kCap) return false;
    const auto corner = [&](std::uint32_t triangle, std::size_t k) {
      return part_.vertices[part_.triangles[triangle][k]].as<std::int64_t>();
    };
    const Vec3l p = corner(s, 0);
    const ExactNormal m = triangle_normal(part_, s), n = triangle_normal(part_, t);
    for (std::size_t k = 0; k < 3; ++k)
      if (along(m, corner(t, k) - p) != 0) return false;
    for (std::size_t k = 0; k < 3; ++k)
      if (m[k] != 0) return (m[k] > 0) == (n[k] > 0);
    return false;
  }

  void triangulate_cap(const CutPlane& plane, std::uint32_t number) {
    std::vector<Directed> rim;
    for (const OutlineSegment& s : stretches_) rim.push_back({s.ends[1], s.ends[0]});
    const std::size_t before = triangles_.size();
    if (!plane_section::triangulate_cap(plane, rim, vertices_, triangles_)) {
      ++result_.not_filled;
      closed_ = false;
      return;
    }
    source_.insert(source_.end(), triangles_.size() - before, kCap | number);
  }

  void drop_degenerate() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const Triangle& t = triangles_[i];
      const auto at = [&](std::size_t k) { return vertices_[t[k]].as<std::int32_t>(); };
      if (collinear<__int128>(at(0), at(1), at(2))) continue;
      triangles_[kept] = t;
      source_[kept++] = source_[i];
    }
    triangles_.resize(kept);
    source_.resize(kept);
  }

  void drop_unused() {
    std::vector<std::uint32_t> number(vertices_.size(), kNoIndex);
    for (const Triangle& t : triangles_)
      for (const std::uint32_t v : t) number[v] = 0;
    std::uint32_t count = 0;
    for (std::uint32_t v = 0; v < number.size(); ++v) {
      if (number[v] == kNoIndex) continue;
      vertices_[count] = vertices_[v];
      number[v] = count++;
    }
    vertices_.resize(count);
    for (Triangle& t : triangles_)
      for (std::uint32_t& v : t) v = number[v];
  }

  const Part& part_;
  bool closed_ = false;
  std::vector<Vec3l> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> source_;  ///< of each triangle
  PartSection result_;
  // Of the plane at hand.
  std::vector<std::int64_t> heights_;
  std::unordered_map<std::uint64_t, std::uint32_t> points_;
  std::vector<OutlineSegment> stretches_;
  bool exact_ = true;
};

PartSection cut_wire(const Part& part, std::span<const CutPlane> planes) {
  PartSection result;
  Part& left = result.part;
  left.kind = PartKind::wire;
  left.flags = part.flags;
  for (std::size_t c = 0; c + 1 < part.chain_first.size(); ++c)
    for (std::uint32_t v = part.chain_first[c]; v + 1 < part.chain_first[c + 1]; ++v) {
      const Segment whole{part.vertices[v].as<std::int64_t>(),
                          part.vertices[v + 1].as<std::int64_t>()};
      const auto kept = left_of(whole, planes);
      if (!kept) continue;
      for (const Vec3l& p : *kept) {
        left.vertices.push_back(p.as<std::int32_t>());
        left.box.include(left.vertices.back());
      }
      if (left.chain_first.empty()) left.chain_first.push_back(0);
      left.chain_first.push_back(static_cast<std::uint32_t>(left.vertices.size()));
    }
  return result;
}

}  // namespace

std::optional<Segment> left_of(const Segment& segment, std::span<const CutPlane> planes) {
  Segment left = segment;
  for (const CutPlane& plane : planes) {
    const bool below0 = plane.height(left[0]) < 0, below1 = plane.height(left[1]) < 0;
    if (!below0 && !below1) return std::nullopt;
    if (!below0) left[0] = plane_section::meeting_point(plane, left[1], left[0]).at;
    if (!below1) left[1] = plane_section::meeting_point(plane, left[0], left[1]).at;
  }
  if (left[0] == left[1]) return std::nullopt;
  return left;
}

PartSection cut(const Part& part, std::span<const CutPlane> planes) {
  if (part.kind == PartKind::wire) return cut_wire(part, planes);
  PlaneCutter cutter(part);
  for (std::uint32_t i = 0; i < planes.size(); ++i) cutter.cut(planes[i], i);
  return cutter.finished();
}

std::vector<Segment> cap_boundary(const PartSection& cut, std::uint32_t plane) {
  std::map<Directed, int> net;
  for (std::size_t t = 0; t < cut.cap_of.size(); ++t) {
    if (cut.cap_of[t] != plane) continue;
    const Triangle& v = cut.part.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = v[k], b = v[(k + 1) % 3];
      net[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  std::vector<Segment> rim;
  for (const auto& [ends, count] : net) {
    if (count == 0) continue;
    const Vec3l p = cut.part.vertices[ends[0]].as<std::int64_t>();
    const Vec3l q = cut.part.vertices[ends[1]].as<std::int64_t>();
    rim.push_back(count > 0 ? Segment{p, q} : Segment{q, p});
  }
  std::ranges::sort(rim);
  return rim;
}

}  // namespace strake::geometry
