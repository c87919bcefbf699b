// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/numeric/trig.hpp"
#include "geometry/primitives/bend_contour.hpp"
#include "geometry/primitives/bend_lacing.hpp"
#include "geometry/primitives/mesh_builder.hpp"

// Bends whose contour from an eye turns quickly from section to section, as from low over their
// plane. Sections have vertices where the contour crosses them and along lines that run round the
// axis: quads between these are planar and have the very normal of the skin in their middle.
// Triangles along the contour look the right way if the skin bends along the sight there as it
// should be told by their third corner (decision 0121), so that each section leaves out the lines
// which would stand in the way.

namespace strake::geometry::tessellation {
namespace {

/// The angle from one to another, in (-pi, pi].
double turn_between(double from, double to) {
  const double turns = (to - from) / (2 * kPi);
  return (turns - std::ceil(turns - 0.5)) * 2 * kPi;
}

/// The same in [0, 2·pi).
double within_turn(double angle) {
  const double turns = angle / (2 * kPi);
  const double rest = angle - std::floor(turns) * 2 * kPi;
  return rest < 2 * kPi ? std::max(0.0, rest) : 0;
}

struct BendSection {
  double angle = 0;                         ///< of the sweep
  std::optional<EyeContour> before, after;  ///< the contour as its two sides see it
  bool is_along = false;  ///< the eye sees it along the tube, and it is the contour all round
};

/// The vertices of a section.
struct BendRing {
  std::vector<double> places;
  std::vector<Vec3d> points;
  std::vector<std::uint32_t> vertices;
};

struct LacedBand {
  SectionArc first, second;
  BandLacing lacing;
};

class ContouredBend {
 public:
  ContouredBend(const CircularTorusPrimitive& p, const TessellationTarget& target, int segments,
                double rest)
      : p_{p.centre_radius, p.tube_radius, std::min(p.angle, 2 * kPi)},
        target_(target),
        eye_(*target.eye),
        contour_(p, eye_),
        segments_(segments),
        step_(2 * kPi / segments),
        full_(is_full_turn(p.angle)),
        start_(full_ ? contour_.towards() : 0) {
    const int quarters = static_cast<int>(std::ceil(p_.angle / (kPi / 2) * (1 - 1e-6)));
    sweep_step_ =
        p_.angle / std::max({1, quarters, arc_segments(outer(), p_.angle, rest, kMostBendSteps)});
    // A circle that is seen along the tube is off the true contour by no more than an eighth.
    const double turning = contour_.turning();
    turns_at_once_ = outer() * turning * turning / 2 < target.sag / 8;
  }

  [[nodiscard]] std::optional<Tessellation> make() {
    if (!contour_.is_clear()) return std::nullopt;
    choose_sections();
    choose_lines();
    lace();
    if (!is_whole()) return std::nullopt;
    return meshed();
  }

 private:
  static constexpr int kMostBendSteps = 1024;
  /// In length: sections that are nearer to each other are told apart by rounding to the grid.
  static constexpr double kLeastApart = 4e-3;
  /// In steps of a section: how far the contour may turn from one to the next.
  static constexpr double kMostTurn = 1;
  /// In steps: lines through the contour's places are that far from each other, those of a rim from
  /// them; those of sections that are near come nearer.
  static constexpr double kApart = 0.4, kApartFromRim = 0.5, kApartNearby = 0.04;
  static constexpr double kSteepEnd = 0.75;  ///< of a usual step of the sweep
  static constexpr std::size_t kNearby = 3;
  /// In steps: a line that is nearer to the contour is left out; and the widest between neighbours.
  static constexpr double kNear = 0.14, kWidest = 1.4;
  static constexpr double kSame = 1e-9;  ///< radians

  [[nodiscard]] double outer() const { return p_.centre_radius + p_.tube_radius; }

  [[nodiscard]] BendSection plain(double angle) const {
    const auto here = contour_.at(angle);
    return {angle, here, here, false};
  }

  // Which sections.

  /// Calls use(angle) for each of some angles of the sweep that lies between its ends.
  template <class Use>
  void within_sweep(const std::vector<double>& angles, double from_ends, Use&& use) const {
    for (const double a : angles) {
      const double angle = start_ + within_turn(a - start_);
      if (angle > start_ + from_ends && angle < start_ + p_.angle - from_ends) use(angle);
    }
  }

  /// An end that is nearly seen along the tube has the lines of its side.
  [[nodiscard]] BendSection at_end(double angle, double inside) const {
    BendSection end = plain(angle);
    if (!turns_at_once_) return end;
    for (const double along : contour_.seen_along())
      if (std::fabs(turn_between(along, angle)) < 2 * contour_.turning())
        end = {angle, contour_.at(along + inside), contour_.at(along + inside), true};
    return end;
  }

  void choose_sections() {
    const double least = kLeastApart / outer();
    std::vector<BendSection> corners;
    if (turns_at_once_) {
      const double aside = 2 * contour_.turning();
      within_sweep(contour_.seen_along(), aside, [&](double angle) {
        corners.push_back({angle, contour_.at(angle - aside), contour_.at(angle + aside), true});
      });
    } else {
      within_sweep(contour_.meetings(kLeastApart), least, [&](double angle) {
        const double place = contour_.meeting_place(angle);
        corners.push_back({angle, EyeContour{place, place}, EyeContour{place, place}, false});
      });
    }
    const double inside = 2 * contour_.turning();
    corners.push_back(full_ ? plain(start_) : at_end(start_, inside));
    corners.push_back(full_ ? plain(start_ + p_.angle) : at_end(start_ + p_.angle, -inside));
    std::ranges::sort(corners, {}, &BendSection::angle);
    sections_ = {corners.front()};
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) divide(corners[i], corners[i + 1]);
    add_cusps();
  }

  void divide(const BendSection& from, const BendSection& to) {
    const double span = to.angle - from.angle;
    int parts = std::max(1, static_cast<int>(std::ceil(span / sweep_step_ * (1 - 1e-9))));
    // Between two meetings there is no contour, which takes a section to see.
    if (parts == 1 && from.after && to.before && !contour_.at(from.angle + span / 2)) parts = 2;
    BendSection before = from;
    for (int k = 1; k <= parts; ++k) {
      const BendSection next = k == parts ? to : plain(from.angle + span * k / parts);
      add(before, next, 0);
      before = next;
    }
  }

  /// Adds a section, and before it such that the contour does not turn too far.
  void add(const BendSection& from, const BendSection& to, int depth) {
    constexpr int kDeepest = 24;
    const BendSection middle = plain((from.angle + to.angle) / 2);
    if (depth < kDeepest && turns_far(from, middle, to)) {
      add(from, middle, depth + 1);
      add(middle, to, depth + 1);
      return;
    }
    sections_.push_back(to);
  }

  [[nodiscard]] bool may_divide(const BendSection& from, const BendSection& to) const {
    const double span = to.angle - from.angle;
    if (span * outer() < 2 * kLeastApart) return false;
    return !(from.is_along || to.is_along) || span > 4 * contour_.turning();
  }

  [[nodiscard]] bool turns_far(const BendSection& from, const BendSection& middle,
                               const BendSection& to) const {
    if (!from.after || !middle.before || !to.before || !may_divide(from, to)) return false;
    for (const auto line : {&EyeContour::first, &EyeContour::second}) {
      const double here = (*middle.before).*line;
      const double turn = std::max(std::fabs(turn_between((*from.after).*line, here)),
                                   std::fabs(turn_between(here, (*to.before).*line)));
      if (turn > kMostTurn * step_ / 2) return true;
    }
    return false;
  }

  /// The contour has a vertex at each cusp, so that no chord runs on both sides of it.
  void add_cusps() {
    std::vector<BendSection> cusps;
    for (std::size_t j = 0; j + 1 < sections_.size(); ++j)
      for (const auto line : {&EyeContour::first, &EyeContour::second})
        if (const auto cusp = cusp_between(sections_[j], sections_[j + 1], line))
          cusps.push_back(plain(*cusp));
    sections_.insert(sections_.end(), cusps.begin(), cusps.end());
    std::ranges::sort(sections_, {}, &BendSection::angle);
  }

  [[nodiscard]] std::optional<double> cusp_between(const BendSection& from, const BendSection& to,
                                                   double EyeContour::* line) const {
    if (!from.after || !to.before || from.is_along || to.is_along) return std::nullopt;
    const auto is_outside = [&](double angle, const EyeContour& at) {
      return contour_.bend_along_sight(angle, at.*line) > 0;
    };
    const bool at_first = is_outside(from.angle, *from.after);
    if (is_outside(to.angle, *to.before) == at_first) return std::nullopt;
    double low = from.angle, high = to.angle;
    constexpr int kHalvings = 40;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = (low + high) / 2;
      const auto at = contour_.at(middle);
      if (!at) return std::nullopt;
      (is_outside(middle, *at) == at_first ? low : high) = middle;
    }
    // A sliver of a band would do more harm than a chord that runs a little beyond the cusp.
    const double least = std::max(kLeastApart / outer(), 0.2 * (to.angle - from.angle));
    if (low - from.angle < least || to.angle - low < least) return std::nullopt;
    return low;
  }

  // Which vertices each of them has.

  /// The circle of a pipe at an end.
  [[nodiscard]] std::vector<double> rim_at(double angle) const {
    TessellationTarget of_pipe{target_.linear, target_.sag, std::nullopt,
                               Vec3d{contour_.outward(angle), contour_.up(), 0}};
    const SinCos a = sin_cos(angle);
    const Vec3d radial = column(target_.linear, 0) * a.cos + column(target_.linear, 1) * a.sin;
    const auto seen = rim_from_eye(of_pipe, p_.tube_radius);
    const auto points =
        seen ? *seen : rim(segments_, canonical_phase(radial, column(target_.linear, 2)));
    std::vector<double> places;
    for (const SinCos& s : points) places.push_back(within_turn(arc_tan2(s.sin, s.cos)));
    return places;
  }

  /// Chooses lines that run round the axis, of which sections have their vertices. Where a contour
  /// turns quickly, they go through its places in the sections there: so quads are planar.
  void choose_lines() {
    second_lines_from_ = second_half();
    if (full_) {
      rims_[0].clear();
      for (int k = 0; k < segments_; ++k) rims_[0].push_back(k * step_);
      rims_[1] = rims_[0];
    } else {
      rims_ = {rim_at(start_), rim_at(start_ + p_.angle)};
    }
    const std::size_t count = sections_.size();
    lines_[0] = lines_of(0, second_lines_from_, rims_[0], is_steep(0));
    lines_[1] = lines_of(second_lines_from_, count, rims_[1], is_steep(count - 1));
  }

  /// Returns the section from which on those of the second end are: behind the widest band between
  /// two sections that are seen along the tube, or of all.
  [[nodiscard]] std::size_t second_half() const {
    std::vector<double> along;
    within_sweep(contour_.seen_along(), 0, [&](double angle) { along.push_back(angle); });
    std::ranges::sort(along);
    const bool is_between = along.size() == 2;
    double widest = 0;
    std::size_t from = sections_.size();
    for (std::size_t j = 0; j + 1 < sections_.size(); ++j) {
      const double here = sections_[j].angle, next = sections_[j + 1].angle;
      if (is_between && (here < along[0] || next > along[1])) continue;
      if (next - here < widest * (1 + 1e-9)) continue;
      widest = next - here;
      from = j + 1;
    }
    return from;
  }

  /// Adds a line unless there is one that is nearer than so many steps.
  void take(std::vector<double>& lines, double place, double apart) const {
    const double line = within_turn(place);
    if (std::ranges::none_of(lines, [&](double other) {
          return std::fabs(turn_between(other, line)) < apart * step_;
        }))
      lines.push_back(line);
  }
  void take_contour(std::vector<double>& lines, std::size_t j, double apart) const {
    for (const auto& contour : {sections_[j].before, sections_[j].after}) {
      if (!contour) continue;
      take(lines, contour->first, apart);
      take(lines, contour->second, apart);
    }
  }

  [[nodiscard]] std::vector<double> lines_of(std::size_t from, std::size_t to,
                                             const std::vector<double>& rim,
                                             bool has_whole_rim) const {
    struct Steep {
      double span = 0;
      std::size_t section = 0;
    };
    std::vector<Steep> order;
    for (std::size_t j = from; j < to; ++j) order.push_back({span_beside(j), j});
    std::ranges::sort(order, [](const Steep& a, const Steep& b) {
      return a.span < b.span || (a.span == b.span && a.section < b.section);
    });
    std::vector<double> lines;
    for (const Steep& steep : order) take_contour(lines, steep.section, kApart);
    for (const Steep& steep : order)
      for (const double middle : middles_inside(steep.section)) take(lines, middle, kApart / 2);
    for (const double line : rim) take(lines, line, has_whole_rim ? kApartNearby : kApartFromRim);
    return lines;
  }

  /// Whether the contour turns quickly at an end, so that its section has lines as well as those of
  /// its rim, and the sections by it those of the rim, too.
  [[nodiscard]] bool is_steep(std::size_t j) const {
    return !full_ && span_beside(j) < kSteepEnd * sweep_step_;
  }

  [[nodiscard]] double span_beside(std::size_t j) const {
    double span = kPi;
    if (j > 0) span = std::min(span, sections_[j].angle - sections_[j - 1].angle);
    if (j + 1 < sections_.size())
      span = std::min(span, sections_[j + 1].angle - sections_[j].angle);
    return span;
  }

  /// Returns the places half-way to the contour's in the next section, where the sight runs on into
  /// the body: there a vertex has to lie between the two.
  [[nodiscard]] std::vector<double> middles_inside(std::size_t j) const {
    std::vector<double> middles;
    if (j + 1 >= sections_.size()) return middles;
    const auto &from = sections_[j].after, &to = sections_[j + 1].before;
    if (!from || !to) return middles;
    const double middle = (sections_[j].angle + sections_[j + 1].angle) / 2;
    for (const auto line : {&EyeContour::first, &EyeContour::second}) {
      const double turn = turn_between((*from).*line, (*to).*line);
      const double place = (*from).*line + turn / 2;
      if (std::fabs(turn) > kSame && !(contour_.bend_along_sight(middle, place) > 0))
        middles.push_back(place);
    }
    return middles;
  }

  /// The section beside one; none at an end.
  [[nodiscard]] const BendSection* beside(std::size_t j, bool behind) const {
    const std::size_t last = sections_.size() - 1;
    if (behind && j == last) return full_ ? &sections_[1] : nullptr;
    if (!behind && j == 0) return full_ ? &sections_[last - 1] : nullptr;
    return &sections_[behind ? j + 1 : j - 1];
  }

  /// Part of a circle where lines are left out, from a place on it.
  struct Gap {
    double at = 0, from = 0, to = 0;

    [[nodiscard]] bool holds(double place) const {
      const double turn = turn_between(at, place);
      return turn > from && turn < to;
    }
  };

  /// What the contour in a section and in one beside it want of it.
  void keep_off(const BendSection& here, const BendSection* other, bool behind,
                std::vector<Gap>& gaps, std::vector<double>& places) const {
    const auto& contour = behind ? here.after : here.before;
    if (!contour) return;
    for (const auto line : {&EyeContour::first, &EyeContour::second}) {
      const double place = (*contour).*line;
      places.push_back(within_turn(place));
      Gap gap{place, -kNear * step_, kNear * step_};
      const auto& next = other == nullptr ? contour : behind ? other->before : other->after;
      if (next && other != nullptr) {
        const double turn = turn_between(place, (*next).*line);
        const double near = std::min(kNear * step_, std::max(0.02 * step_, 0.4 * std::fabs(turn)));
        gap.from = -near;
        gap.to = near;
      }
      gaps.push_back(gap);
    }
  }

  [[nodiscard]] static double nearby(double angle, double other) {
    return angle + turn_between(angle, other);
  }

  [[nodiscard]] std::vector<double> places_of(std::size_t j) const {
    std::vector<Gap> gaps;
    std::vector<double> places;
    for (const bool behind : {false, true})
      keep_off(sections_[j], beside(j, behind), behind, gaps, places);
    const bool is_end = !full_ && (j == 0 || j + 1 == sections_.size());
    const auto may_have = [&](double place) {
      return std::ranges::none_of(gaps, [&](const Gap& gap) { return gap.holds(place); });
    };
    const std::size_t half = j < second_lines_from_ ? 0 : 1;
    std::vector<double> lines = is_end ? rims_[half] : std::vector<double>();
    if (!is_end || is_steep(j)) {
      const std::size_t from = j > kNearby ? j - kNearby : 0;
      const std::size_t to = std::min(j + kNearby, sections_.size() - 1);
      for (std::size_t i = from; i <= to; ++i) take_contour(lines, i, kApartNearby);
      for (std::size_t i = from; i < to; ++i)
        for (const double middle : middles_inside(i)) take(lines, middle, kApartNearby);
      for (const double line : lines_[half]) take(lines, line, kApartNearby);
    }
    for (std::size_t k = 0; k < lines.size(); ++k)
      if ((is_end && k < rims_[half].size()) || may_have(lines[k])) places.push_back(lines[k]);
    std::ranges::sort(places);
    std::vector<double> distinct;
    for (const double place : places)
      if (distinct.empty() || place - distinct.back() > kSame) distinct.push_back(place);
    if (distinct.size() > 1 && distinct.front() + 2 * kPi - distinct.back() < kSame)
      distinct.pop_back();
    if (is_end) return distinct;
    std::vector<double> filled;
    for (std::size_t i = 0; i < distinct.size(); ++i) {
      filled.push_back(distinct[i]);
      const bool last = i + 1 == distinct.size();
      const double next = last ? distinct.front() + 2 * kPi : distinct[i + 1];
      const double middle = (distinct[i] + next) / 2;
      if (next - distinct[i] > kWidest * step_ && middle < 2 * kPi && may_have(middle))
        filled.push_back(middle);
    }
    return filled;
  }

  [[nodiscard]] Vec3d point(double angle, double place) const {
    const SinCos a = sin_cos(angle), b = sin_cos(place);
    const double out = p_.centre_radius + p_.tube_radius * b.cos;
    return {out * a.cos, out * a.sin, p_.tube_radius * b.sin};
  }

  // How the bands between them are cut.

  void lace() {
    rings_.clear();
    std::uint32_t vertices = 0;
    const std::size_t distinct = sections_.size() - (full_ ? 1 : 0);
    for (std::size_t j = 0; j < distinct; ++j) {
      BendRing ring{places_of(j), {}, {}};
      for (const double place : ring.places) {
        ring.points.push_back(point(sections_[j].angle, place));
        ring.vertices.push_back(vertices++);
      }
      rings_.push_back(std::move(ring));
    }
    if (full_) rings_.push_back(rings_.front());
    bands_.clear();
    for (std::size_t j = 0; j + 1 < sections_.size(); ++j) bands_.push_back(bands_between(j));
  }

  [[nodiscard]] std::vector<LacedBand> bands_between(std::size_t j) const {
    const BendRing &a = rings_[j], &b = rings_[j + 1];
    const auto &from = sections_[j].after, &to = sections_[j + 1].before;
    std::vector<LacedBand> bands;
    if (from && to) {
      add_band(bands, arc_of(a, from->first, from->second, false),
               arc_of(b, to->first, to->second, false), true);
      add_band(bands, arc_of(a, from->second, from->first, true),
               arc_of(b, to->second, to->first, true), false);
      return bands;
    }
    const double at = from ? from->first : to ? to->first : a.places.front();
    add_band(bands, arc_of(a, at, at, true), arc_of(b, at, at, true), false);
    return bands;
  }

  void add_band(std::vector<LacedBand>& bands, SectionArc first, SectionArc second,
                bool faces_eye) const {
    if (first.angles.size() + second.angles.size() < 3) return;
    const double turns =
        std::floor((first.angles.front() - second.angles.front()) / (2 * kPi) + 0.5);
    for (double& angle : second.angles) angle += 2 * kPi * turns;
    BandLacing lacing = lace_band(first, second, eye_, faces_eye, step_, target_.sag / 20);
    bands.push_back({std::move(first), std::move(second), std::move(lacing)});
  }

  /// Returns a section's points from one place to another; where both are one, that alone or all
  /// round.
  [[nodiscard]] static SectionArc arc_of(const BendRing& ring, double from, double to, bool round) {
    const auto nearest = [&](double place) {
      const auto apart = [&](double other) { return std::fabs(turn_between(place, other)); };
      const auto found = std::ranges::min_element(ring.places, {}, apart);
      return static_cast<std::size_t>(found - ring.places.begin());
    };
    const std::size_t count = ring.places.size(), first = nearest(from), last = nearest(to);
    std::size_t length = (last + count - first) % count;
    if (length == 0 && round) length = count;
    SectionArc arc;
    for (std::size_t k = 0; k <= length; ++k) {
      const std::size_t at = (first + k) % count;
      arc.angles.push_back(ring.places[at] + (first + k >= count ? 2 * kPi : 0));
      arc.points.push_back(ring.points[at]);
      arc.vertices.push_back(ring.vertices[at]);
    }
    return arc;
  }

  /// Whether each band goes from end to end: sections are too unlike each other otherwise.
  [[nodiscard]] bool is_whole() const {
    return std::ranges::all_of(bands_, [](const std::vector<LacedBand>& bands) {
      return std::ranges::all_of(bands, [](const LacedBand& band) {
        return band.lacing.second_goes_on.size() + 2 ==
               band.first.angles.size() + band.second.angles.size();
      });
    });
  }

  [[nodiscard]] Tessellation meshed() const {
    MeshBuilder builder(std::nullopt, eye_);
    for (std::size_t j = 0; j < rings_.size() - (full_ ? 1 : 0); ++j)
      for (const Vec3d& v : rings_[j].points) builder.vertex(v);
    double sag = 0;
    for (std::size_t j = 0; j < bands_.size(); ++j) {
      const double along = sections_[j + 1].angle - sections_[j].angle;
      for (const LacedBand& band : bands_[j]) sag = std::max(sag, add_facets(builder, band, along));
    }
    if (!full_) {
      builder.polygon(rings_.front().vertices);
      builder.polygon(rings_.back().vertices, true);
    }
    return std::move(builder).take(sag);
  }

  /// Returns how far they are from the skin, at most.
  double add_facets(MeshBuilder& builder, const LacedBand& band, double along) const {
    const SectionArc &a = band.first, &b = band.second;
    const auto& steps = band.lacing.second_goes_on;
    const double by_sweep = outer() * along * along;
    const auto bent = [&](double across) { return by_sweep + p_.tube_radius * across * across; };
    double sag = 0;
    std::size_t i = 0, k = 0;
    const auto is_level = [&] { return std::fabs(a.angles[i] - b.angles[k]) < kSame; };
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const std::size_t i0 = i, k0 = k;
      const bool level = is_level();
      ++(steps[s] ? k : i);
      if (level && s + 1 < steps.size() && steps[s + 1] != steps[s]) {
        ++(steps[s] ? i : k);
        if (is_level()) {
          builder.quad(a.vertices[i0], b.vertices[k0], b.vertices[k], a.vertices[i]);
          sag = std::max(sag, bent(a.angles[i] - a.angles[i0]) / 8);
          ++s;
          continue;
        }
        --(steps[s] ? i : k);
      }
      const std::array corners{a.vertices[i0], b.vertices[k0],
                               steps[s] ? b.vertices[k] : a.vertices[i]};
      builder.polygon(corners);
      const double across =
          std::max({std::fabs(a.angles[i0] - b.angles[k0]), std::fabs(a.angles[i] - b.angles[k]),
                    a.angles[i] - a.angles[i0], b.angles[k] - b.angles[k0]});
      sag = std::max(sag, bent(across) / 6);
    }
    return sag;
  }

  const CircularTorusPrimitive p_;  ///< which turns once at most
  const TessellationTarget& target_;
  Vec3d eye_;
  BendContour contour_;
  int segments_;
  double step_;
  bool full_;
  double start_;  ///< of the sweep
  double sweep_step_ = 0;
  bool turns_at_once_ = false;  ///< the contour, where the eye sees the tube along
  std::vector<BendSection> sections_;
  std::array<std::vector<double>, 2> rims_, lines_;
  std::size_t second_lines_from_ = 0;  ///< the section
  std::vector<BendRing> rings_;
  std::vector<std::vector<LacedBand>> bands_;  ///< between sections: towards the eye and away
};

}  // namespace

std::optional<Tessellation> contoured_bend(const CircularTorusPrimitive& p,
                                           const TessellationTarget& target, int segments,
                                           double rest) {
  return ContouredBend(p, target, segments, rest).make();
}

}  // namespace strake::geometry::tessellation
