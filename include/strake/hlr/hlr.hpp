// SPDX-License-Identifier: Apache-2.0
// Hidden-line removal: what may be drawn of a scene in a view, and draw(), which finds the
// visibility of each edge. docs/hlr.md defines the states.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/ellipse.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

enum class Stage : std::uint8_t { none, local, global };
/// The algorithm that finds what is hidden; all give the same pieces. `push` is the scheme of the
/// source thesis, whose counters of work depend on the schedule.
enum class Solver : std::uint8_t { gather, brute_force, push };

/// Which parts' intersections are drawn.
enum class Intersections : std::uint8_t {
  off,
  objects,     ///< those of different objects
  primitives,  ///< also those of one object, where a primitive passes through another part of it
  parts,       ///< those of all parts
};

/// What the faces of an object do to the polylines of the same object; those of others hide them in
/// any case. A polyline on a face, within the contact distance, is in no case hidden by that face.
enum class OwnPolylines : std::uint8_t {
  visible,  ///< they hide none: a centre line is seen through its pipe
  hidden,   ///< they hide them as they hide the edges of the object's other parts
};

/// Which smooth edges are drawn. An edge is smooth where its faces turn by no more than the sharp
/// angle.
enum class Smooth : std::uint8_t {
  off,
  tangent,  ///< those where a curved skin begins or ends
  all,
};

enum class EdgeKind : std::uint8_t {
  sharp,
  contour,  ///< computer graphics says silhouette: one face looks towards the viewer, one does not
  boundary,
  non_manifold,
  polyline,
  intersection,  ///< where the skins of two parts pass through each other
  section,       ///< where a section plane cuts a part
  hatch,         ///< a hatch line on the face of a cut through a solid
  smooth,        ///< where two faces turn by no more than the sharp angle, if requested
  single_line,   ///< the axis of a pipe that is drawn as a line: see model::pipes_as_lines()
};
inline constexpr EdgeKind kLastEdgeKind = EdgeKind::single_line;
enum class State : std::uint8_t {
  visible,
  hidden_by_self,
  hidden_by_other,
  projecting,  ///< a point on paper: parallel to the view, in line with the eye, or a speck
  clipped,     ///< outside the limits or the frustum, or cut away by a section
};

/// A plane through a grid point. What lies on it and on the side that `normal` points to is cut
/// away, by the rule of geometry::CutPlane: it is neither drawn nor hides. Solids are closed where
/// they are cut.
struct Section {
  geometry::Vec3l normal{0, 0, 1};  ///< |component| <= 2^20, not zero
  geometry::Vec3l point;            ///< grid units
};

/// A central projection from a point. The paper is square to View::direction; lengths on it are
/// true in the plane through the target.
struct Perspective {
  geometry::Vec3l eye;     ///< grid units
  geometry::Vec3l target;  ///< grid units; lies before the eye
  /// The near plane: what is nearer to the eye, measured along the view, is not drawn (but hides).
  double near_mm = 100;
  double field_of_view_deg = 90;  ///< from side to side of the square that is drawn; 1 to 160
};

/// An orthographic or perspective view. Directions are integers so that every decision is exact.
struct View {
  geometry::Vec3l direction{1, -1, 1};  ///< points to the viewer; |component| <= 2^20
  geometry::Vec3l up{0, 0, 1};
  std::optional<geometry::Box3l> limits =
      std::nullopt;  ///< grid units; lines outside are clipped, points outside do not hide
  std::vector<Section> sections = {};  ///< in any order, 16 at most
  std::optional<Perspective> perspective = std::nullopt;
};

/// The half-space normal · p >= least, with p relative to the eye in grid units.
struct HalfSpace {
  geometry::Vec3l normal;
  std::int64_t least = 0;
};

/// Returns the view frustum: what is drawn in perspective lies in all of these half-spaces,
/// exactly. They are the near plane and the four sides of the field of view, whose normals are
/// rounded to 20 bits. Orthographic views have none. The view must be one that draw() takes.
[[nodiscard]] std::vector<HalfSpace> window(const View& view);

/// How the sections of an object are hatched; negative values are chosen automatically.
struct Hatch {
  double angle_deg = -1;   ///< from the horizontal of the paper, seen square; at most 180
  double spacing_mm = -1;  ///< in the model; 0: none
  friend bool operator==(const Hatch&, const Hatch&) = default;
};

struct Options {
  Stage stage = Stage::global;
  Solver solver = Solver::gather;
  double sharp_angle_deg = 20;
  Smooth smooth = Smooth::off;
  /// The contact distance δ, mm; negative: derived from the sources' precision.
  double contact_distance_mm = -1;
  Intersections intersections = Intersections::primitives;
  OwnPolylines own_polylines = OwnPolylines::visible;
  /// Draw flush seams, edges along which parts of one colour are joined into one flat surface;
  /// docs/hlr.md defines them. Without them the other pieces and the fates of objects are the same.
  bool flush_seams = true;
  /// The largest distance of tessellated curved primitives from their true surfaces, as far as the
  /// most segments of each kind allow. Meshes of the scene that are coarser are made anew where the
  /// view may show them; 0: as in the scene. See drawing::sag_for_paper.
  double sag_mm = 0;
  bool culling = true;  ///< changes the work, never the answer
  static constexpr std::int32_t kNoBuckets = 0, kBucketsByData = -1;
  static constexpr std::int32_t kMaxBuckets = 4096;
  /// How the faces of a part are found. A number from 1 to kMaxBuckets: by so many buckets along
  /// the longer side of the part on paper, fewer where they would list its faces over and over.
  /// kBucketsByData: by as many as suit its faces and edges, or a tree. kNoBuckets: each face is
  /// tested. Changes the work, never the answer.
  std::int32_t bucketing = kBucketsByData;
  /// Keep hidden pieces. Without them, and what else is left of objects of which nothing is
  /// visible, a drawing takes less time and memory; its other pieces and the fates of its objects
  /// are the same.
  bool hidden = true;
  /// Keep the pieces of edges that have none but clipped ones (decision 0125). Without them,
  /// counted in Drawing::clipped_left_out, the other pieces and the fates of objects are the same.
  bool clipped = true;
  /// Keep specks, pieces shorter than the precision of the sources can tell, each in its exact
  /// state. Otherwise their neighbours absorb them, and specks that join nothing become points.
  bool keep_specks = false;
  /// The usual distance of hatch lines in the model, mm; 0: no hatch; negative: derived from the
  /// size of what is drawn.
  double hatch_spacing_mm = -1;
  /// The hatch of each object; empty: chosen so that neighbours differ in angle and colours in
  /// spacing.
  std::vector<Hatch> hatches = {};
  /// The objects that sections leave whole, one entry each (empty: none), as bolts, shafts and ribs
  /// along the section (ISO 128-3). Of these each that some plane cuts and no plane cuts away
  /// wholly is neither cut nor hatched; it hides and is hidden as a solid, on both sides of the
  /// planes. The others are cut away, or not touched, like everything else.
  std::vector<bool> uncut = {};
};

/// A piece of an edge in one state: a visible or hidden segment. Coordinates are grid units,
/// rounded once from exact values.
struct EdgePiece {
  model::ObjectId object{};
  std::uint32_t edge = 0;  ///< number of the feature edge among those of its object
  EdgeKind kind = EdgeKind::sharp;
  State state = State::visible;
  model::ObjectId other{};  ///< the second object of an intersection; otherwise equal to `object`
  geometry::Vec3l a, b;
};

struct Counters {
  std::uint64_t feature_edges = 0;
  std::uint64_t covered_edges = 0;  ///< edges whose rest the occlusion buffer hides
  std::uint64_t face_tests = 0;     ///< tests of an edge against a face
  std::uint64_t exact_fallbacks = 0;
  std::uint64_t crossing_pairs = 0;  ///< pairs of parts searched for intersections, equal ones once
  std::uint64_t crossing_tests = 0;  ///< tests of two triangles, for those pairs
  /// Pieces that were absorbed or made points, see Options::keep_specks; without hidden pieces
  /// those of edges that are seen in part.
  std::uint64_t specks = 0;
  std::uint64_t left_out = 0;  ///< edges with hidden pieces that were dropped, see Options::hidden
  std::uint64_t seams = 0;     ///< edges without their flush seams: see Options::flush_seams
  std::uint64_t uncut_objects = 0;  ///< objects that sections left whole: see Options::uncut
  std::uint64_t shared_shapes = 0;  ///< shapes whose own faces were tested once for several bodies
  std::uint64_t shared_bodies = 0;  ///< the bodies that share what these tests found
};

/// What became of an object. Each selected object has one fate other than `unselected`: none
/// vanishes silently.
enum class Fate : std::uint8_t {
  unselected,
  drawn,       ///< at least one of its lines is visible
  coincident,  ///< all that is visible of it lies on lines of others, which are drawn, or on flush
               ///< seams that are left out: see lay_out()
  hidden,      ///< none of its lines is visible, some are hidden
  clipped,     ///< all of its lines are outside the limits, or cut away
  degenerate,  ///< it makes no line in this view: nothing but points, or too small for the grid
  failed,      ///< none of its geometry could be read or placed
  left_out,    ///< all of its bodies are of categories that the scene was made without
};
inline constexpr std::size_t kFates = 8;

/// Why an object is degenerate or failed, or drawn without some of its geometry.
struct Defect {
  model::ObjectId object{};
  /// "only-points", "no-lines", or the code of a model::Lacking; a literal.
  std::string_view code;
  friend bool operator==(const Defect&, const Defect&) = default;
};

struct Account {
  std::vector<Fate> fates;  ///< the fate of each object of the model
  std::array<std::uint64_t, kFates> count{};
  std::uint64_t in_part = 0;    ///< objects that lack some of their geometry, but not all
  std::vector<Defect> defects;  ///< those of degenerate, failed and partial objects, by object

  [[nodiscard]] std::uint64_t of(Fate fate) const { return count[static_cast<std::size_t>(fate)]; }
  /// Returns the number of selected objects.
  [[nodiscard]] std::uint64_t objects() const {
    return std::accumulate(count.begin() + 1, count.end(), std::uint64_t{0});
  }
};

/// A circle of a round primitive, or the ellipse that its placement makes of it: millimetres from
/// `origin`, which is in grid units.
struct Curve {
  geometry::Vec3l origin;
  geometry::Ellipse at;
};

/// An edge that is a chord of a curve: its ends lie on the curve but for the snap.
struct CurvedEdge {
  model::ObjectId object{};
  std::uint32_t edge = 0;   ///< as EdgePiece::edge
  std::uint32_t curve = 0;  ///< index into Curves::all
};

/// The straight edges of a drawing that stand for curves.
struct Curves {
  std::vector<Curve> all;
  std::vector<CurvedEdge> edges;  ///< sorted by (object, edge)
};

/// The lines of one object, counted: what Counters sum up.
struct LineCount {
  std::uint32_t edges = 0;   ///< as Counters::feature_edges
  std::uint32_t specks = 0;  ///< as Counters::specks
  friend bool operator==(const LineCount&, const LineCount&) = default;
};

struct Drawing {
  View view;
  Options options;
  double contact_distance_mm = 0;  ///< the largest that was applied
  double weld_mm = -1;             ///< the scene's model::SceneOptions::weld_mm
  double sag_mm = 0;               ///< the sag requested of curved primitives; 0: unknown
  std::vector<EdgePiece> pieces;   ///< sorted by (object, edge, parameter)
  Curves curves;
  /// By object: edges whose hidden pieces were left out, and clipped pieces that were, if any.
  std::vector<std::uint32_t> left_out, clipped_left_out;
  std::vector<LineCount> counted;  ///< by object
  std::vector<Hatch> hatches;      ///< by object, as sections chose them; empty: nothing is hatched
  /// A reference point, grid units: the middle of all that is drawn; in perspective the target.
  geometry::Vec3l origin;
  Counters counters;
  Account account;
  /// Reports on sections (planes that miss, solids that are cut but not closed) and on defective
  /// objects.
  Diagnostics diagnostics;
};

/// Returns the lines of the scene in one view, each piece with its state. `drawn` selects the
/// objects, one entry each (empty: all); the others are neither drawn nor hide anything. Bodies
/// whose colour is transparent can be hidden by others, but hide nothing. Errors: usage for a
/// selection of the wrong size and a view that makes no sense, input for one that reaches too far;
/// cancelled.
[[nodiscard]] Result<Drawing> draw(const model::Scene& scene, const std::vector<bool>& drawn,
                                   const View& view, const Options& options,
                                   const parallel::Context& context);

/// What Solver::brute_force has to do for a view: each edge against each triangle that may hide it.
struct BruteForceWork {
  std::uint64_t edges = 0;      ///< edges and lines of what is drawn
  std::uint64_t triangles = 0;  ///< triangles that hide
  std::uint64_t tests = 0;      ///< pairs of them, those that the stage leaves out aside
};

/// Returns the work of the brute force, counted at the cost of the preparation of a view. Errors:
/// as those of draw().
[[nodiscard]] Result<BruteForceWork> brute_force_work(const model::Scene& scene,
                                                      const std::vector<bool>& drawn,
                                                      const View& view, const Options& options,
                                                      const parallel::Context& context);

}  // namespace strake::hlr
