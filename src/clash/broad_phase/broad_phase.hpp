// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/bvh/scene_bvh.hpp"
#include "strake/clash/clash.hpp"
#include "strake/geometry/depth.hpp"
#include "strake/parallel/collect.hpp"

/// The broad phase: the parts of a scene, and the pairs of them that are near enough to be
/// evaluated.
namespace strake::clash {

/// A placed part of the scene, of which the broad phase makes pairs.
struct ScenePart {
  geometry::PlacedPart placed;
  std::uint32_t object = 0;
  std::uint32_t number = 0;  ///< its number within its object
  std::uint32_t unique = 0;  ///< number of the part's geometry, shared by all bodies that place it
  std::uint32_t body = 0;    ///< index into Model::bodies
  float snap = 0;            ///< grid units: how far its surface may lie from the source's
  float step = 0;            ///< grid units: step of the source's numbers if coarse, else 0
};

/// The solids and sheets of the objects in either set, and lines where requested, by object and
/// number.
struct ScenePartList {
  std::vector<ScenePart> parts;
  std::vector<const geometry::Part*> unique;
};

/// Lists the parts of a scene that are tested. Errors: cancelled.
[[nodiscard]] Result<ScenePartList> collect_scene_parts(const model::Scene& scene, const Sets& sets,
                                                        Curves curves,
                                                        const parallel::Context& context);

/// Grid units beyond a tolerance within which the narrow phase decides, since the snap may have
/// moved a part so far.
inline constexpr double kSnapMargin = 4;

/// Returns what boxes are inflated by for a tolerance, both in grid units.
[[nodiscard]] constexpr double search_margin(double tolerance) {
  return tolerance + kSnapMargin + 1;
}

/// Returns the part's box, so much larger that the boxes of two parts overlap where their true
/// surfaces, which may stand out of the tessellation by the sag, come within `reach` grid units, or
/// as near as the coarser one's numbers can tell.
[[nodiscard]] geometry::Box3l inflated_box(const ScenePart& ref, double reach);

/// Returns what the inflated boxes of two parts have in common, mm.
[[nodiscard]] geometry::Box3d common_box_mm(const ScenePart& a, const ScenePart& b, double reach);

/// How far apart the boxes of two parts may be for the search to find them: `of_all`, and what the
/// objects of both add, grid units. An object that adds much finds more pairs of its own, and no
/// others do.
struct SearchReach {
  double of_all = 0;
  std::vector<double> of_object = {};  ///< one entry per object; empty: they add nothing

  /// Returns by what the part's box is inflated, as inflated_box() takes it.
  [[nodiscard]] double of(const ScenePart& part) const {
    return of_object.empty() ? of_all : of_all + 2 * of_object[part.object];
  }
};

/// Pairs of parts of different objects whose boxes come within reach of each other.
struct CandidatePairs {
  std::vector<geometry::IndexPair> pairs;  ///< indices into the list, by (objects, parts)
  std::uint64_t boxes = 0;                 ///< pairs of boxes, within groups too
  bool framed = false;  ///< they were so many that boxes along the parts' own faces came in
};

/// Returns the pairs of parts whose boxes come within reach of each other. Where these are very
/// many, boxes along the parts' own faces have to come as near, too.
[[nodiscard]] Result<CandidatePairs> find_candidate_pairs(const ScenePartList& list,
                                                          const Sets& sets,
                                                          const SearchReach& reach,
                                                          const Options& options,
                                                          const parallel::Context& context);

/// A part of space on the grid, without its upper faces: of cells that fill a space every point
/// lies in one.
struct Cell {
  geometry::Vec3l lo, hi;

  [[nodiscard]] bool contains(const geometry::Vec3l& p) const {
    return p.x >= lo.x && p.y >= lo.y && p.z >= lo.z && p.x < hi.x && p.y < hi.y && p.z < hi.z;
  }
};

/// Returns of each of so many objects the box of its parts, as the search for pairs sees them;
/// empty where it has none.
[[nodiscard]] std::vector<geometry::Box3l> object_boxes(const ScenePartList& list,
                                                        const SearchReach& reach,
                                                        std::size_t objects);

/// Returns the pairs of find_candidate_pairs() that belong to a cell: those where the lower corner
/// of what the boxes of the two objects have in common lies in it. Each belongs to one of the cells
/// that fill a space, and both its objects reach into that. Boxes along the parts' own faces do not
/// come in: whether there are too many pairs is a matter of all cells.
[[nodiscard]] Result<CandidatePairs> find_pairs_of_cell(const ScenePartList& list, const Sets& sets,
                                                        const SearchReach& reach,
                                                        const Options& options, const Cell& cell,
                                                        const parallel::Context& context);

/// Returns the most pairs of boxes that a test over so many parts may have without boxes along
/// their faces.
[[nodiscard]] std::uint64_t max_unframed_pairs(std::uint64_t parts, const Options& options);

/// What became of each object since an earlier run.
enum class Change : std::uint8_t { none, near, changed };

/// Returns the pairs of find_candidate_pairs() of which one object at least has changed, where they
/// need no boxes along faces; nothing where there are more than `limit` pairs of boxes. `change`
/// has an entry per object. Errors: cancelled.
[[nodiscard]] Result<std::optional<CandidatePairs>> find_changed_pairs(
    const ScenePartList& list, const Sets& sets, const SearchReach& reach,
    std::span<const Change> change, std::uint64_t limit, const parallel::Context& context);

/// The pairs of objects behind pairs of parts; the pairs of parts of one pair of objects are
/// neighbours, as find_candidate_pairs() lists them.
class ObjectPairs {
 public:
  ObjectPairs() = default;
  /// Finds the pairs of objects. Errors: cancelled.
  [[nodiscard]] static Result<ObjectPairs> find(std::span<const geometry::IndexPair> pairs,
                                                const ScenePartList& list,
                                                const parallel::Context& context);

  [[nodiscard]] std::size_t size() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  /// The pairs of parts of the k-th pair of objects are [begin(k), end(k)).
  [[nodiscard]] std::size_t begin(std::size_t k) const { return begin_[k]; }
  [[nodiscard]] std::size_t end(std::size_t k) const { return begin_[k + 1]; }

 private:
  explicit ObjectPairs(std::vector<std::size_t> begin) : begin_(std::move(begin)) {}
  std::vector<std::size_t> begin_;  ///< with the number of pairs of parts at the end
};

/// Returns where the runs of a list begin, ascending, and at last the end of the list. An item
/// belongs to the run of the one before it where `same(one before, item)`. Errors: cancelled.
template <class List, class Same>
[[nodiscard]] Result<std::vector<std::size_t>> find_runs(const List& list, std::string_view name,
                                                         const Same& same,
                                                         const parallel::Context& context) {
  /// Only shares the work out: between 4096 and 65'536 no difference can be seen (decision 0073).
  constexpr std::size_t kGrain = 16384;
  return parallel::collect<std::size_t>(
      context, {.name = name, .n = list.size() + 1, .grain = kGrain},
      [&](std::size_t i, std::vector<std::size_t>& out) {
        if (i == 0 || i == list.size() || !same(list[i - 1], list[i])) out.push_back(i);
      });
}

}  // namespace strake::clash
