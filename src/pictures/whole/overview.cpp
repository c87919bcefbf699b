// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/number.hpp"
#include "core/text/counted.hpp"
#include "pictures/folder/shown_subjects.hpp"
#include "pictures/scenery/clash_place.hpp"
#include "pictures/viewpoint/camera.hpp"
#include "pictures/whole/class_colours.hpp"
#include "pictures/whole_run.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::pictures {
namespace {

using clash::Class;
using geometry::Vec3d;
using geometry::Vec3l;

constexpr double kMarginMm = 10, kLegendMm = 62, kLegendText = 2.5;
constexpr Colour kDark{0x22, 0x22, 0x22}, kWhite{0xff, 0xff, 0xff};
/// From the most to the least urgent.
constexpr std::array kClasses{Class::hit, Class::clearance_violation, Class::contact};

/// A rectangle in the plane of the view, mm of the model.
struct OverviewExtent {
  double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;

  void include(double x, double y) {
    left = std::min(left, x);
    right = std::max(right, x);
    bottom = std::min(bottom, y);
    top = std::max(top, y);
  }
};

class Overview {
 public:
  explicit Overview(const report::ClashContents& contents)
      : contents_(contents), worst_(worst_classes(contents)), shown_(shown_subjects(contents)) {
    picture_.width_mm = 420;
    picture_.height_mm = 297;
    picture_.view_mm = 297;
    picture_.title =
        "Clashes: " + (contents.grouping != nullptr ? counted(shown_.size(), "group")
                                                    : std::to_string(shown_.size()) + " marked");
  }

  Result<ClashPicture> draw(const parallel::Context& context) && {
    hlr::View view;
    view.direction = {4, -5, 3};
    axes_ = Axes::towards(view.direction.as<double>());
    hlr::Options options;
    options.hidden = false;
    options.flush_seams = false;
    options.intersections = hlr::Intersections::off;
    options.sag_mm = 0;
    const Result<hlr::Drawing> drawn = hlr::draw(*contents_.scene, {}, view, options, context);
    if (!drawn) return drawn.error();
    origin_ = drawn->origin;
    fit(*drawn);
    add_lines(*drawn);
    add_marks();
    add_legend();
    return std::move(picture_);
  }

 private:
  [[nodiscard]] double across(const Vec3l& grid) const {
    return dot(geometry::to_mm(grid - origin_), axes_.right);
  }
  [[nodiscard]] double upward(const Vec3l& grid) const {
    return dot(geometry::to_mm(grid - origin_), axes_.up);
  }
  [[nodiscard]] PicturePoint paper(const Vec3l& grid) const {
    return {left_ + (across(grid) - extent_.left) / picture_.mm_per_mm,
            top_ + (extent_.top - upward(grid)) / picture_.mm_per_mm};
  }

  void fit(const hlr::Drawing& drawn) {
    for (const hlr::EdgePiece& piece : drawn.pieces)
      if (piece.state == hlr::State::visible)
        for (const Vec3l& end : {piece.a, piece.b}) extent_.include(across(end), upward(end));
    if (extent_.left > extent_.right) extent_ = {0, 1, 0, 1};
    const double width = picture_.width_mm - kLegendMm - 2 * kMarginMm;
    const double height = picture_.height_mm - 2 * kMarginMm;
    const double wide = extent_.right - extent_.left, high = extent_.top - extent_.bottom;
    constexpr double kMinScale = 0.01;
    picture_.mm_per_mm = std::max({wide / width, high / height, kMinScale});
    left_ = kMarginMm + (width - wide / picture_.mm_per_mm) / 2;
    top_ = kMarginMm + (height - high / picture_.mm_per_mm) / 2;
  }

  [[nodiscard]] static PictureLine styled(Class cls) {
    constexpr double kThin = 0.13, kWide = 0.35;
    if (cls == Class::no_hit) return {{}, {}, kThin, {0x90, 0x90, 0x90}, false};
    return {{}, {}, kWide, colour_of_class(cls), false};
  }

  /// Adds visible lines, those of the worst classes last, which cover the others.
  void add_lines(const hlr::Drawing& drawn) {
    constexpr double kShortest = 0.02;
    for (const Class cls :
         {Class::no_hit, Class::contact, Class::clearance_violation, Class::hit}) {
      PictureLine line = styled(cls);
      for (const hlr::EdgePiece& piece : drawn.pieces) {
        if (piece.state != hlr::State::visible || worst_[index(piece.object)] != cls) continue;
        line.a = paper(piece.a);
        line.b = paper(piece.b);
        if (std::fabs(line.a.x - line.b.x) + std::fabs(line.a.y - line.b.y) >= kShortest)
          picture_.lines.push_back(line);
      }
    }
  }

  /// Marks the subjects, the worst last: it covers the others.
  void add_marks() {
    constexpr double kRadius = 2.6, kDot = 0.9, kEdge = 0.3;
    for (std::size_t i = shown_.size(); i-- > 0;) {
      const clash::Pair& pair = pair_of(contents_, shown_[i].subject.results.front());
      const PicturePoint at = paper(grid_point(pair.point_mm));
      const bool numbered = i < kMaxNumbers;
      const double radius = numbered ? kRadius : kDot;
      picture_.rings.push_back({at, radius + kEdge, 0, kWhite, true});
      picture_.rings.push_back({at, radius, 0, colour_of_class(pair.cls), true});
      if (!numbered) continue;
      const std::string number = std::to_string(shown_[i].number);
      const double height = number.size() < 3 ? 2.0 : 1.5;
      picture_.texts.push_back({{at.x, at.y + height / 2}, height, number, kWhite, true, true});
    }
  }

  void add_legend() {
    const double left = picture_.width_mm - kMarginMm - kLegendMm + 6;
    double line = kMarginMm + 6;
    const auto text = [&](std::string words, double height, bool bold) {
      picture_.texts.push_back({{left, line}, height, std::move(words), kDark, false, bold});
      line += height * 2.2;
    };
    text("Clashes", 4, true);
    std::array<std::uint64_t, kClasses.size()> counts{};
    for (const clash::Report& test : contents_.findings.tests) {
      counts[0] += test.count_hit;
      counts[1] += test.count_clearance;
      counts[2] += test.count_contact;
    }
    constexpr std::array kNames{"hit", "clearance violation", "contact"};
    for (std::size_t k = 0; k < kClasses.size(); ++k) {
      picture_.blocks.push_back({{left, line - 2.6}, 3, 3, colour_of_class(kClasses[k])});
      picture_.texts.push_back(
          {{left + 5, line}, kLegendText, counted(counts[k], kNames[k]), kDark, false, false});
      line += 6;
    }
    line += 3;
    text(contents_.grouping != nullptr
             ? counted(shown_.size(), "group, as numbered", "groups, as numbered")
             : std::to_string(shown_.size()) + " marked, 1 is the worst",
         kLegendText, false);
    if (shown_.size() > kMaxNumbers)
      text("the first " + std::to_string(kMaxNumbers) + " have numbers", kLegendText, false);
    const double scale = picture_.mm_per_mm;
    text("about 1:" + std::to_string(std::llround(std::max(1.0, scale))), kLegendText, false);
  }

  static constexpr std::size_t kMaxNumbers = 200;

  const report::ClashContents& contents_;
  std::vector<Class> worst_;
  std::vector<NamedSubject> shown_;
  Axes axes_;
  Vec3l origin_;
  OverviewExtent extent_;
  double left_ = 0, top_ = 0;
  ClashPicture picture_;
};

}  // namespace

Status write_overview(const report::ClashContents& contents, report::Sink sink,
                      const parallel::Context& context) {
  if (contents.scene == nullptr)
    return Error{ErrorCode::usage,
                 "a drawing of clashes needs the model, and there are only results", "picture",
                 "give the model files or the project along with the results"};
  const Result<ClashPicture> picture = Overview(contents).draw(context);
  if (!picture) return picture.error();
  return write_svg(*picture, sink);
}

}  // namespace strake::pictures
