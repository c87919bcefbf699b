// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_repair/mesh_repair.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "geometry/mesh_repair/make_part.hpp"
#include "geometry/mesh_repair/shell_containment.hpp"
#include "geometry/mesh_repair/topology.hpp"
#include "geometry/mesh_repair/weld.hpp"

namespace strake::geometry {
namespace {

/// Triangles of a mesh, grouped by shell.
struct Grouped {
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> first;

  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t shell) const {
    return std::span(triangles).subspan(first[shell], first[shell + 1] - first[shell]);
  }
};

Grouped group_by_shell(const ShellLabels& labels) {
  Grouped grouped;
  grouped.first.assign(labels.count + 1, 0);
  for (const std::uint32_t s : labels.shell) ++grouped.first[s + 1];
  for (std::size_t s = 1; s < grouped.first.size(); ++s) grouped.first[s] += grouped.first[s - 1];
  grouped.triangles.resize(labels.shell.size());
  std::vector<std::uint32_t> next = grouped.first;
  for (std::uint32_t t = 0; t < labels.shell.size(); ++t)
    grouped.triangles[next[labels.shell[t]]++] = t;
  return grouped;
}

/// For each shell whether it bounds {winding number >= 1} of its nest, the nest having been flipped
/// so that its outermost shell counts +1.
std::vector<bool> bounding(const std::vector<ClosedShell>& shells,
                           const std::vector<std::uint32_t>& parents,
                           const std::vector<std::uint32_t>& roots) {
  std::vector<bool> bounds(shells.size());
  for (std::size_t i = 0; i < shells.size(); ++i) {
    const int outermost = shells[roots[i]].sign;
    int outside = 0;
    for (std::uint32_t p = parents[i]; p != kNoShell; p = parents[p])
      outside += shells[p].sign * outermost;
    bounds[i] = (outside >= 1) != (outside + shells[i].sign * outermost >= 1);
  }
  return bounds;
}

std::vector<std::uint32_t> find_roots(const std::vector<std::uint32_t>& parents) {
  std::vector<std::uint32_t> roots(parents.size());
  for (std::uint32_t i = 0; i < parents.size(); ++i) {
    roots[i] = i;
    while (parents[roots[i]] != kNoShell) roots[i] = parents[roots[i]];
  }
  return roots;
}

/// The solid bounded by the chosen shells of a nest.
Part merge_nest(const Grouped& grouped, const std::vector<ClosedShell>& shells,
                const std::vector<std::uint32_t>& members, bool inverted, RepairScratch& scratch) {
  std::vector<std::uint32_t> triangles;
  for (const std::uint32_t m : members) {
    const auto of = grouped.of(shells[m].label);
    triangles.insert(triangles.end(), of.begin(), of.end());
  }
  std::sort(triangles.begin(), triangles.end());
  extract_submesh(triangles, scratch);
  if (inverted) flip(scratch.piece.triangles);
  return make_part(PartKind::solid,
                   signed_volume_6(scratch.piece.vertices, scratch.piece.triangles), scratch);
}

/// Whether the shells of a nest cancel to a body without thickness.
bool cancel(const std::vector<ClosedShell>& shells, const std::vector<Part>& parts,
            std::uint32_t root, const std::vector<std::uint32_t>& members) {
  double volume = 0;
  for (const std::uint32_t m : members) volume += shells[m].sign * parts[m].volume;
  return members.size() > 1 && is_hollow(std::fabs(volume), parts[root].area);
}

/// Removes back sides from the nests and adds their fins to the sheet.
std::vector<bool> take_off_far_sides(const ShellLabels& labels, const RepairScratch& scratch,
                                     const std::vector<ClosedShell>& shells,
                                     const std::vector<Part>& parts,
                                     std::vector<std::uint32_t>& parents,
                                     std::vector<std::uint32_t>& open) {
  BackShells far = find_back_shells(scratch.welded, labels, shells, parts, parents);
  for (std::uint32_t& p : parents)
    while (p != kNoShell && far.shells[p]) p = parents[p];
  open.insert(open.end(), far.fins.begin(), far.fins.end());
  return std::move(far.shells);
}

/// Makes solids from the closed shells: one part per nest, in the order of their outermost shells.
/// Adds triangles that belong to none to the open ones.
void add_solids(const ShellLabels& labels, const Grouped& grouped,
                const std::vector<ClosedShell>& shells, std::vector<Part> shell_parts,
                std::vector<std::uint32_t>& open, RepairScratch& scratch, RepairedMesh& analysis) {
  std::vector<std::uint32_t> parents = find_containing_shells(shell_parts);
  const std::vector<bool> far =
      take_off_far_sides(labels, scratch, shells, shell_parts, parents, open);
  const std::vector<std::uint32_t> roots = find_roots(parents);
  const std::vector<bool> bounds = bounding(shells, parents, roots);
  std::vector<std::vector<std::uint32_t>> members(shells.size());
  for (std::uint32_t i = 0; i < shells.size(); ++i) {
    if (far[i])
      ++analysis.findings.two_sided_shells;
    else if (bounds[i])
      members[roots[i]].push_back(i);
    else
      ++analysis.findings.nested_shells;
  }
  for (std::uint32_t i = 0; i < shells.size(); ++i) {
    if (members[i].empty()) continue;
    if (cancel(shells, shell_parts, i, members[i])) {
      members[i] = {i};
      ++analysis.findings.two_sided_shells;
    }
    const bool inverted = shells[i].sign < 0;
    Part part = members[i].size() == 1 ? std::move(shell_parts[i])
                                       : merge_nest(grouped, shells, members[i], inverted, scratch);
    part.flags.inverted = inverted;
    analysis.parts.push_back(std::move(part));
  }
}

/// Makes the part of a mesh that is one shell: no splitting.
Part whole(const Topology& topology, ShellLabels labels, RepairScratch& scratch) {
  GridMesh& mesh = scratch.welded;
  const bool closed = labels.closed[0] != 0;
  const __int128 volume = closed ? signed_volume_6(mesh.vertices, mesh.triangles) : 0;
  if (closed && volume == 0) {
    std::vector<std::uint32_t> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    extract_submesh(drop_duplicate_layer(mesh, all), scratch);
    return make_part(PartKind::sheet, 0, scratch);
  }
  if (volume < 0) flip(mesh.triangles);
  Part part = make_part(closed ? PartKind::solid : PartKind::sheet,
                        {mesh, topology, std::move(labels), volume < 0 ? -volume : volume});
  part.flags.inverted = volume < 0;
  return part;
}

void split(const ShellLabels& labels, RepairScratch& scratch, RepairedMesh& analysis) {
  const Grouped grouped = group_by_shell(labels);
  std::vector<ClosedShell> shells;
  std::vector<Part> shell_parts;
  std::vector<std::uint32_t> open;
  for (std::uint32_t s = 0; s < labels.count; ++s) {
    const auto of = grouped.of(s);
    __int128 volume = 0;
    if (labels.closed[s] != 0) {
      extract_submesh(of, scratch);
      volume = signed_volume_6(scratch.piece.vertices, scratch.piece.triangles);
    }
    if (volume == 0) {
      const std::vector<std::uint32_t> layer =
          labels.closed[s] != 0 ? drop_duplicate_layer(scratch.welded, of)
                                : std::vector<std::uint32_t>(of.begin(), of.end());
      open.insert(open.end(), layer.begin(), layer.end());
      continue;
    }
    if (volume < 0) flip(scratch.piece.triangles);
    shells.push_back({s, volume < 0 ? -1 : 1});
    shell_parts.push_back(make_part(PartKind::solid, volume < 0 ? -volume : volume, scratch));
  }
  add_solids(labels, grouped, shells, std::move(shell_parts), open, scratch, analysis);
  if (open.empty()) return;
  std::sort(open.begin(), open.end());
  extract_submesh(open, scratch);
  analysis.parts.push_back(make_part(PartKind::sheet, 0, scratch));
}

}  // namespace

MeshRepairer::MeshRepairer() : scratch_(std::make_unique<RepairScratch>()) {}
MeshRepairer::~MeshRepairer() = default;
MeshRepairer::MeshRepairer(MeshRepairer&&) noexcept = default;
MeshRepairer& MeshRepairer::operator=(MeshRepairer&&) noexcept = default;

RepairedMesh MeshRepairer::repair_mesh(const GridMesh& mesh, const Seams& seams) {
  RepairScratch& scratch = *scratch_;
  RepairedMesh analysis;
  const MeshKey key{mesh.triangles, mesh.faces, weld_vertices(mesh, scratch)};
  const GridMesh& welded = scratch.welded;
  if (const Connectivity* known = scratch.known.find(key))
    if (auto part = make_known_part(*known, scratch.box, welded.vertices, seams.within)) {
      analysis.parts.push_back(std::move(*part));
      return analysis;
    }
  const std::size_t vertices = welded.vertices.size();
  const Topology topology = weld_triangles(mesh, key.renumbered, seams, scratch, analysis.findings);
  if (welded.triangles.empty()) return analysis;
  ShellLabels labels = label_shells(welded.vertices, welded.triangles, topology, scratch.topology);
  if (labels.count > 1) {
    split(labels, scratch, analysis);
    return analysis;
  }
  // Only what does not depend on coordinates applies to other meshes with this key.
  const bool plain =
      welded.vertices.size() == vertices && welded.triangles.size() == mesh.triangles.size() &&
      analysis.findings.degenerate_triangles == 0 && analysis.findings.cut_triangles == 0 &&
      analysis.findings.turned_triangles == 0 && analysis.findings.welded_corners == 0 &&
      !has_nonmanifold_edge(topology);
  const bool closed = labels.closed[0] != 0;
  analysis.parts.push_back(whole(topology, std::move(labels), scratch));
  const Part& part = analysis.parts.front();
  if (plain && closed == (part.kind == PartKind::solid) && scratch.known.should_store_last())
    scratch.known.store(key, {part.triangles, part.faces, part.edges, part.edge_triangles,
                              SharedArray(topology.uneven), SharedArray(topology.folded), closed,
                              part.flags.inverted});
  return analysis;
}

RepairedMesh repair_mesh(const GridMesh& mesh, const Seams& seams) {
  return MeshRepairer().repair_mesh(mesh, seams);
}

}  // namespace strake::geometry
