// SPDX-License-Identifier: Apache-2.0
// Joining lines into chains, and writing chains with the arcs of their curves.
#include "drawing/svg/svg_path.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/number.hpp"
#include "geometry/numeric/trig.hpp"

namespace strake::drawing {

namespace {

/// A point of the sheet in whole micrometres: points that are written alike are equal.
struct Key {
  std::int64_t x, y;
  friend auto operator<=>(const Key&, const Key&) = default;
};

Key key_of(const PaperPoint& p) { return {std::llround(p.x * 1000), std::llround(p.y * 1000)}; }

class Joiner {
 public:
  explicit Joiner(std::span<const Line* const> lines) : lines_(lines), used_(lines.size(), false) {
    for (std::uint32_t i = 0; i < lines.size(); ++i) {
      const Key a = key_of(lines[i]->a_paper), b = key_of(lines[i]->b_paper);
      used_[i] = a == b;
      if (used_[i]) continue;
      ends_.emplace_back(a, i);
      ends_.emplace_back(b, i);
    }
    std::sort(ends_.begin(), ends_.end());
  }

  std::vector<JoinedLines> join() {
    for (const bool free_ends : {true, false})
      for (std::uint32_t i = 0; i < lines_.size(); ++i) {
        if (used_[i]) continue;
        const bool from_a = degree(key_of(lines_[i]->a_paper)) != 2;
        if (free_ends && !from_a && degree(key_of(lines_[i]->b_paper)) == 2) continue;
        follow(i, from_a || !free_ends);
      }
    return std::move(chains_);
  }

 private:
  using End = std::pair<Key, std::uint32_t>;

  [[nodiscard]] std::pair<std::vector<End>::const_iterator, std::vector<End>::const_iterator> at(
      const Key& key) const {
    return {std::lower_bound(ends_.begin(), ends_.end(), End(key, 0)),
            std::upper_bound(ends_.begin(), ends_.end(), End(key, 0xffffffffU))};
  }
  [[nodiscard]] std::ptrdiff_t degree(const Key& key) const {
    const auto [first, last] = at(key);
    return last - first;
  }

  void follow(std::uint32_t line, bool from_a) {
    JoinedLines chain{{from_a ? lines_[line]->a_paper : lines_[line]->b_paper}, {}};
    for (;;) {
      used_[line] = true;
      const PaperPoint& next = from_a ? lines_[line]->b_paper : lines_[line]->a_paper;
      chain.points.push_back(next);
      chain.lines.push_back(lines_[line]);
      const Key key = key_of(next);
      const auto [first, last] = at(key);
      const auto found = std::find_if(first, last, [&](const End& e) { return !used_[e.second]; });
      if (found == last) break;
      line = found->second;
      from_a = key_of(lines_[line]->a_paper) == key;
    }
    chains_.push_back(std::move(chain));
  }

  std::span<const Line* const> lines_;
  std::vector<bool> used_;
  std::vector<End> ends_;
  std::vector<JoinedLines> chains_;
};

}  // namespace

std::vector<JoinedLines> join_lines(std::span<const Line* const> lines) {
  return Joiner(lines).join();
}

namespace {

using geometry::kPi;

/// An ellipse narrower than this, mm, is drawn as the straight lines that it is on paper.
constexpr double kNarrowest = 0.01;
/// The longest arc, since an SVG arc is given by its ends, which hardly determine it at half a
/// turn.
constexpr double kLongestArc = 0.7 * kPi;

void append_point(std::string& out, const PaperPoint& p) {
  out += shortest(p.x);
  out += ' ';
  out += shortest(p.y);
}

double rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

/// An ellipse by its axes, the form of SVG.
struct Axes {
  double major = 0, minor = 0, turn_deg = 0;
};

Axes axes_of(const PaperCurve& c) {
  // The matrix u·uᵀ + v·vᵀ has the squares of the half axes as eigenvalues.
  const double a = c.u.x * c.u.x + c.v.x * c.v.x, b = c.u.x * c.u.y + c.v.x * c.v.y,
               d = c.u.y * c.u.y + c.v.y * c.v.y;
  const double middle = (a + d) / 2, half = (a - d) / 2, off = std::sqrt(half * half + b * b);
  const double major = std::sqrt(middle + off);
  const double area = std::fabs(c.u.x * c.v.y - c.u.y * c.v.x);
  const bool round = off <= 1e-9 * middle;
  return {major, major > 0 ? area / major : 0,
          round ? 0 : geometry::arc_tan2(b, half) / 2 * 180 / kPi};
}

/// Returns the parameter of a point on the curve, or of the curve's point that it is beside.
double parameter(const PaperCurve& c, const PaperPoint& p) {
  const double x = p.x - c.centre.x, y = p.y - c.centre.y;
  const double area = c.u.x * c.v.y - c.u.y * c.v.x;
  return geometry::arc_tan2((c.u.x * y - c.u.y * x) / area, (x * c.v.y - y * c.v.x) / area);
}

double turn_between(const PaperCurve& c, const PaperPoint& from, const PaperPoint& to) {
  const double turn = parameter(c, to) - parameter(c, from);
  return turn > kPi ? turn - 2 * kPi : turn <= -kPi ? turn + 2 * kPi : turn;
}

class SvgPathWriter {
 public:
  SvgPathWriter(std::string& out, const JoinedLines& chain, const PaperCurves& curves)
      : out_(out), points_(chain.points) {
    for (const Line* line : chain.lines) {
      const PaperCurve* curve = curves.of(*line);
      of_.push_back(curve != nullptr && axes_of(*curve).minor >= kNarrowest ? curve : nullptr);
    }
  }

  [[nodiscard]] bool straight() const {
    return std::ranges::all_of(of_, [](const auto* c) { return c == nullptr; });
  }

  void write() {
    turn_to_a_change();
    out_ += 'M';
    append_point(out_, points_.front());
    bool line = false;
    for (std::size_t i = 0; i < of_.size();) {
      if (of_[i] == nullptr) {
        out_ += line ? ' ' : 'L';
        append_point(out_, points_[++i]);
        line = true;
        continue;
      }
      line = false;
      i = arcs(i);
    }
    if (points_.size() > 3 && points_.front() == points_.back()) out_ += 'Z';
  }

 private:
  /// Rotates a closed chain to begin where one curve ends and another begins.
  void turn_to_a_change() {
    if (points_.size() < 3 || !(points_.front() == points_.back())) return;
    std::size_t at = 0;
    while (at < of_.size() && of_[at] == of_.back()) ++at;
    if (at == 0 || at == of_.size()) return;
    points_.pop_back();
    std::ranges::rotate(points_, points_.begin() + static_cast<std::ptrdiff_t>(at));
    std::ranges::rotate(of_, of_.begin() + static_cast<std::ptrdiff_t>(at));
    points_.push_back(points_.front());
  }

  /// Writes the run of one curve's chords, one way round, that begins with segment i; returns its
  /// end.
  std::size_t arcs(std::size_t i) {
    const PaperCurve& curve = *of_[i];
    const bool forward = turn_between(curve, points_[i], points_[i + 1]) > 0;
    const Axes axes = axes_of(curve);
    const bool left_handed = curve.u.x * curve.v.y < curve.u.y * curve.v.x;
    double turned = 0;
    for (; i < of_.size() && of_[i] == &curve; ++i) {
      const double turn = turn_between(curve, points_[i], points_[i + 1]);
      if ((turn > 0) != forward) break;
      if (turned > 0 && turned + std::fabs(turn) > kLongestArc) {
        arc(axes, forward != left_handed, points_[i]);
        turned = 0;
      }
      turned += std::fabs(turn);
    }
    arc(axes, forward != left_handed, points_[i]);
    return i;
  }

  void arc(const Axes& axes, bool sweep, const PaperPoint& end) {
    out_ += 'A';
    out_ += shortest(rounded(axes.major, 1000));
    out_ += ' ';
    out_ += shortest(rounded(axes.minor, 1000));
    out_ += ' ';
    out_ += shortest(rounded(axes.turn_deg, 1000) + 0.0);
    out_ += sweep ? " 0 1 " : " 0 0 ";
    append_point(out_, end);
  }

  std::string& out_;
  Chain points_;
  std::vector<const PaperCurve*> of_;
};

}  // namespace

void append_svg_chain(std::string& out, const Chain& chain) {
  const bool closed = chain.size() > 3 && chain.front() == chain.back();
  out += 'M';
  append_point(out, chain.front());
  for (std::size_t i = 1; i + (closed ? 1 : 0) < chain.size(); ++i) {
    out += i == 1 ? 'L' : ' ';
    append_point(out, chain[i]);
  }
  if (closed) out += 'Z';
}

void append_svg_path(std::string& out, const JoinedLines& chain, const PaperCurves& curves) {
  SvgPathWriter path(out, chain, curves);
  if (path.straight()) return append_svg_chain(out, chain.points);
  path.write();
}

}  // namespace strake::drawing
