// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>
#include <utility>
#include <vector>

#include "pictures/clash_picture.hpp"
#include "pictures/drawn/caption.hpp"
#include "pictures/drawn/shade.hpp"
#include "pictures/drawn/small_scene.hpp"
#include "pictures/viewpoint/camera.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::pictures {
namespace {

using geometry::Box3l;
using geometry::Vec3d;
using geometry::Vec3l;

/// How lines look, from what is covered to what covers.
enum class LineRole : std::uint8_t { other, hidden_a, hidden_b, a, b, crossing };
constexpr std::size_t kStrokes = 6;

PictureLine styled(LineRole stroke) {
  constexpr double kThin = 0.13, kHidden = 0.2, kWide = 0.5, kCrossing = 0.6;
  constexpr Colour kGrey{0x8c, 0x8c, 0x8c};
  switch (stroke) {
    case LineRole::other:
      return {{}, {}, kThin, kGrey, false};
    case LineRole::hidden_a:
      return {{}, {}, kHidden, kColourOfA, true};
    case LineRole::hidden_b:
      return {{}, {}, kHidden, kColourOfB, true};
    case LineRole::a:
      return {{}, {}, kWide, kColourOfA, false};
    case LineRole::b:
      return {{}, {}, kWide, kColourOfB, false};
    case LineRole::crossing:
      break;
  }
  return {{}, {}, kCrossing, kColourOfMark, false};
}

/// Cuts a segment to the rectangle from (0, 0) to (width, height), as Liang and Barsky do.
std::optional<std::pair<PicturePoint, PicturePoint>> within(const PicturePoint& a,
                                                            const PicturePoint& b, double width,
                                                            double height) {
  double first = 0, last = 1;
  const auto keep = [&](double step, double room) {
    if (step == 0) return room >= 0;
    const double t = room / step;
    if (step < 0)
      first = std::max(first, t);
    else
      last = std::min(last, t);
    return first <= last;
  };
  const double dx = b.x - a.x, dy = b.y - a.y;
  if (!keep(-dx, a.x) || !keep(dx, width - a.x) || !keep(-dy, a.y) || !keep(dy, height - a.y))
    return std::nullopt;
  return std::pair{PicturePoint{a.x + dx * first, a.y + dy * first},
                   PicturePoint{a.x + dx * last, a.y + dy * last}};
}

Vec3l whole(const Vec3d& direction, double scale) {
  return {std::llround(direction.x * scale), std::llround(direction.y * scale),
          std::llround(direction.z * scale)};
}

class ClashDrawer {
 public:
  ClashDrawer(const Scenery& scenery, const Subject& subject, const ClashViewpoint& viewpoint,
              const PictureOptions& options)
      : scenery_(scenery),
        subject_(subject),
        viewpoint_(viewpoint),
        options_(options),
        roles_(scenery.contents(), subject),
        axes_(Axes::of(viewpoint)),
        target_(grid_point(viewpoint.target_mm)) {
    picture_.width_mm = options.width_mm;
    picture_.height_mm = options.height_mm;
    picture_.view_mm = options.height_mm - (options.caption ? kCaptionMm : 0);
    const double half = viewpoint.half_height_mm;
    picture_.mm_per_mm =
        std::max(2 * half / picture_.view_mm, 2 * half * viewpoint.aspect / picture_.width_mm);
  }

  Result<ClashPicture> draw(const parallel::Context& context) && {
    picture_.title = title_of(scenery_.contents(), subject_);
    if (options_.shaded) add_shade();
    if (const Status status = add_lines(context); !status) return status.error();
    add_marks();
    if (options_.caption)
      add_caption(picture_, scenery_.contents().model, roles_, !viewpoint_.clipping_planes.empty());
    return std::move(picture_);
  }

 private:
  [[nodiscard]] PicturePoint paper(const Vec3d& from_target) const {
    return {picture_.width_mm / 2 + dot(from_target, axes_.right) / picture_.mm_per_mm,
            picture_.view_mm / 2 - dot(from_target, axes_.up) / picture_.mm_per_mm};
  }

  void add_shade() {
    constexpr double kPointsPerMm = 4;
    const Vec3d at = geometry::to_mm(target_);
    Window window{axes_, picture_.width_mm * picture_.mm_per_mm / 2,
                  picture_.view_mm * picture_.mm_per_mm / 2,
                  static_cast<std::uint32_t>(std::lround(picture_.width_mm * kPointsPerMm)),
                  static_cast<std::uint32_t>(std::lround(picture_.view_mm * kPointsPerMm))};
    window.eye_mm = dot(viewpoint_.eye_mm - at, axes_.toward);
    window.box = geometry::Box3d{viewpoint_.box_mm.lo - at, viewpoint_.box_mm.hi - at};
    for (const ClippingPlane& plane : viewpoint_.clipping_planes)
      window.planes.push_back({plane.point_mm - at, plane.normal});
    window.closes_cuts = !window.planes.empty();
    double half = 0;
    for (int k = 0; k < 3; ++k)
      half = std::max({half, std::fabs(window.box->lo[k]), std::fabs(window.box->hi[k])});
    picture_.shade =
        shade_of(window, NearTriangles(triangles_near(scenery_, roles_, target_, half)));
  }

  [[nodiscard]] hlr::View view(const Box3l& limits) const {
    constexpr double kDirection = 1 << 18, kNormal = 1 << 16;
    hlr::View view{whole(axes_.toward, kDirection), whole(axes_.up, kDirection), limits};
    for (const ClippingPlane& plane : viewpoint_.clipping_planes)
      view.sections.push_back({whole(plane.normal, kNormal), grid_point(plane.point_mm)});
    return view;
  }

  Status add_lines(const parallel::Context& context) {
    const Box3l limits{grid_point(viewpoint_.box_mm.lo), grid_point(viewpoint_.box_mm.hi)};
    constexpr std::int64_t kRoom = 1000;
    const SmallScene small = small_scene(scenery_, limits.inflated(kRoom));
    hlr::Options options;
    options.hidden = options_.hidden_lines;
    options.clipped = false;
    options.hatch_spacing_mm = 0;
    options.flush_seams = false;
    constexpr double kSagOnPaper = 0.04, kMinSag = 0.001;
    options.sag_mm = std::max(kMinSag, kSagOnPaper * picture_.mm_per_mm);
    const Result<hlr::Drawing> drawn = hlr::draw(small.scene, {}, view(limits), options, context);
    if (!drawn) return drawn.error();
    std::vector<std::vector<PictureLine>> strokes(kStrokes);
    for (const hlr::EdgePiece& piece : drawn->pieces)
      if (const auto stroke = stroke_of(piece, small))
        if (const auto line = line_of(piece, *stroke))
          strokes[static_cast<std::size_t>(*stroke)].push_back(*line);
    for (const std::vector<PictureLine>& lines : strokes)
      picture_.lines.insert(picture_.lines.end(), lines.begin(), lines.end());
    return {};
  }

  [[nodiscard]] std::optional<LineRole> stroke_of(const hlr::EdgePiece& piece,
                                                  const SmallScene& small) const {
    const Role role = roles_.of(small.object[index(piece.object)]);
    const Role other = roles_.of(small.object[index(piece.other)]);
    const bool hidden =
        piece.state == hlr::State::hidden_by_self || piece.state == hlr::State::hidden_by_other;
    if (hidden) {
      // Of a group those of the worst alone: all of them together are a thicket.
      if (role == Role::other || small.object[index(piece.object)] != roles_.first(role))
        return std::nullopt;
      return role == Role::a ? LineRole::hidden_a : LineRole::hidden_b;
    }
    if (piece.state != hlr::State::visible) return std::nullopt;
    if (role != other && role != Role::other && other != Role::other) return LineRole::crossing;
    if (role == Role::other && other == Role::other) return LineRole::other;
    return (role == Role::other ? other : role) == Role::a ? LineRole::a : LineRole::b;
  }

  [[nodiscard]] std::optional<PictureLine> line_of(const hlr::EdgePiece& piece,
                                                   LineRole stroke) const {
    const auto cut =
        within(paper(geometry::to_mm(piece.a - target_)), paper(geometry::to_mm(piece.b - target_)),
               picture_.width_mm, picture_.view_mm);
    if (!cut) return std::nullopt;
    PictureLine line = styled(stroke);
    line.a = cut->first;
    line.b = cut->second;
    return line;
  }

  /// Rings the points of the results, white round the ring so that it shows on anything. The worse
  /// come first, and those behind whose rings would cross theirs are left out: a heap of rings
  /// hides what they are round.
  void add_marks() {
    constexpr double kFirst = 4, kOthers = 1.6;
    struct Mark {
      PicturePoint at;
      double radius;
    };
    std::vector<Mark> marks;
    for (std::size_t i = 0; i < subject_.results.size(); ++i) {
      const clash::Pair& pair = pair_of(scenery_.contents(), subject_.results[i]);
      const PicturePoint at = paper(geometry::to_mm(grid_point(pair.point_mm) - target_));
      if (at.x < 0 || at.y < 0 || at.x > picture_.width_mm || at.y > picture_.view_mm) continue;
      if (!viewpoint_.box_mm.meets({pair.point_mm, pair.point_mm})) continue;
      const double radius = i == 0 ? kFirst : kOthers;
      const bool is_crowded = std::ranges::any_of(marks, [&](const Mark& mark) {
        return std::hypot(mark.at.x - at.x, mark.at.y - at.y) < mark.radius + radius;
      });
      if (!is_crowded) marks.push_back({at, radius});
    }
    for (const Mark& mark : std::views::reverse(marks)) {
      picture_.rings.push_back({mark.at, mark.radius, 1.1, {255, 255, 255}, false});
      picture_.rings.push_back({mark.at, mark.radius, 0.45, kColourOfMark, false});
    }
  }

  const Scenery& scenery_;
  const Subject& subject_;
  const ClashViewpoint& viewpoint_;
  const PictureOptions& options_;
  Roles roles_;
  Axes axes_;
  Vec3l target_;
  ClashPicture picture_;
};

}  // namespace

double view_aspect(const PictureOptions& options) {
  return options.width_mm / (options.height_mm - (options.caption ? kCaptionMm : 0));
}

Result<ClashPicture> draw_clash(const Scenery& scenery, const Subject& subject,
                                const ClashViewpoint& viewpoint, const PictureOptions& options,
                                const parallel::Context& context) {
  constexpr double kMin = 40, kMax = 1000;
  const auto fits = [](double mm) { return mm >= kMin && mm <= kMax; };
  if (!fits(options.width_mm) || !fits(options.height_mm))
    return Error{ErrorCode::usage, "a picture is not between 40 mm and a metre wide and high",
                 "picture", "160 by 120 mm is the usual size"};
  if (const Status status = check_subject(scenery.contents(), subject); !status)
    return status.error();
  return ClashDrawer(scenery, subject, viewpoint, options).draw(context);
}

}  // namespace strake::pictures
