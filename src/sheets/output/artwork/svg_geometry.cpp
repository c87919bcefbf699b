// SPDX-License-Identifier: Apache-2.0
#include "sheets/output/artwork/svg_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "drawing/pdf/pdf_path.hpp"
#include "drawing/pdf/pdf_syntax.hpp"
#include "geometry/numeric/trig.hpp"

namespace strake::sheets {

namespace {

using geometry::kPi;

constexpr std::string_view kBlanks = " \t\r\n,";
/// Larger numbers lie off any sheet.
constexpr double kLargest = 1e9;

/// Takes numbers and letters off a text, as paths and lists have them: "1-2.5.5e1".
class SvgScanner {
 public:
  explicit SvgScanner(std::string_view text) : rest_(text) { skip(); }

  [[nodiscard]] bool done() const { return rest_.empty(); }
  [[nodiscard]] char front() const { return rest_.front(); }
  [[nodiscard]] bool at_letter() const {
    const char c = done() ? '\0' : rest_.front();
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  }
  char take() {
    const char c = rest_.front();
    rest_.remove_prefix(1);
    skip();
    return c;
  }
  std::optional<double> number() {
    std::size_t length = 0;
    const auto digits = [&] {
      const std::size_t first = length;
      while (length < rest_.size() && rest_[length] >= '0' && rest_[length] <= '9') ++length;
      return length > first;
    };
    const auto sign = [&](std::size_t at) {
      return at < rest_.size() && (rest_[at] == '-' || rest_[at] == '+');
    };
    if (sign(0)) ++length;
    digits();
    if (length < rest_.size() && rest_[length] == '.') ++length, digits();
    if (length < rest_.size() && (rest_[length] == 'e' || rest_[length] == 'E')) {
      const std::size_t mantissa = length;
      length += sign(length + 1) ? std::size_t{2} : std::size_t{1};
      if (!digits()) length = mantissa;  // the letter is that of a unit
    }
    std::string text(rest_.substr(0, length));
    if (text.ends_with('.')) text.pop_back();
    const std::optional<double> value = parse_number(text);
    if (!value) return std::nullopt;
    rest_.remove_prefix(length);
    skip();
    return std::clamp(*value, -kLargest, kLargest);
  }
  /// A flag of an arc is one digit, which may stand beside the next number.
  std::optional<bool> flag() {
    if (done() || (front() != '0' && front() != '1')) return std::nullopt;
    return take() == '1';
  }

 private:
  void skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size())); }
  std::string_view rest_;
};

Affine turned(double degrees) {
  const geometry::SinCos t = geometry::sin_cos(std::fmod(degrees, 360) * kPi / 180);
  return {t.cos, t.sin, -t.sin, t.cos, 0, 0};
}

double tangent(double degrees) {
  const geometry::SinCos t = geometry::sin_cos(std::fmod(degrees, 360) * kPi / 180);
  return t.cos == 0 ? 0 : t.sin / t.cos;
}

std::optional<Affine> one_transform(std::string_view name, const std::vector<double>& n) {
  if (name == "matrix" && n.size() == 6) return Affine{n[0], n[1], n[2], n[3], n[4], n[5]};
  if (name == "translate" && (n.size() == 1 || n.size() == 2))
    return Affine{1, 0, 0, 1, n[0], n.size() == 2 ? n[1] : 0};
  if (name == "scale" && (n.size() == 1 || n.size() == 2))
    return Affine{n[0], 0, 0, n.back(), 0, 0};
  if (name == "rotate" && n.size() == 1) return turned(n[0]);
  if (name == "rotate" && n.size() == 3)
    return Affine{1, 0, 0, 1, n[1], n[2]}.after(turned(n[0])).after({1, 0, 0, 1, -n[1], -n[2]});
  if (name == "skewX" && n.size() == 1) return Affine{1, 0, tangent(n[0]), 1, 0, 0};
  if (name == "skewY" && n.size() == 1) return Affine{1, tangent(n[0]), 0, 1, 0, 0};
  return std::nullopt;
}

/// Reads the commands of a path one after another.
class PathReader {
 public:
  PathReader(std::string_view d, PathBuilder& path) : scanner_(d), path_(path) {}

  bool read() {
    while (!scanner_.done()) {
      if (scanner_.at_letter())
        command_ = scanner_.take();
      else if (command_ == '\0' || lower() == 'z')
        return false;
      if (!step()) return false;
      last_ = lower();
      // Further pairs behind a move are lines.
      if (command_ == 'M') command_ = 'L';
      if (command_ == 'm') command_ = 'l';
    }
    return true;
  }

 private:
  [[nodiscard]] char lower() const {
    return command_ >= 'A' && command_ <= 'Z' ? static_cast<char>(command_ - 'A' + 'a') : command_;
  }
  [[nodiscard]] bool relative() const { return command_ == lower(); }

  /// Reads n numbers, coordinates by turns from where the pen is.
  bool read(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      const std::optional<double> value = scanner_.number();
      if (!value) return false;
      const double origin = i % 2 == 0 ? path_.x() : path_.y();
      n_[i] = *value + (relative() ? origin : 0);
    }
    return true;
  }

  bool step() {
    if (last_ == '\0' && lower() != 'm') return false;
    switch (lower()) {
      case 'm':
      case 'l':
        if (!read(2)) return false;
        lower() == 'm' ? path_.move(n_[0], n_[1]) : path_.line(n_[0], n_[1]);
        return true;
      case 'h':
        if (!read(1)) return false;
        path_.line(n_[0], path_.y());
        return true;
      case 'v': {
        const std::optional<double> y = scanner_.number();
        if (!y) return false;
        path_.line(path_.x(), *y + (relative() ? path_.y() : 0));
        return true;
      }
      case 'c':
        return read(6) && cubic(n_[0], n_[1], n_[2], n_[3], n_[4], n_[5]);
      case 's': {
        const bool follows = last_ == 'c' || last_ == 's';
        const double x = path_.x(), y = path_.y();
        return read(4) && cubic(follows ? 2 * x - control_x_ : x, follows ? 2 * y - control_y_ : y,
                                n_[0], n_[1], n_[2], n_[3]);
      }
      case 'q':
        return read(4) && quadratic(n_[0], n_[1], n_[2], n_[3]);
      case 't': {
        const bool follows = last_ == 'q' || last_ == 't';
        const double x = path_.x(), y = path_.y();
        return read(2) && quadratic(follows ? 2 * x - control_x_ : x,
                                    follows ? 2 * y - control_y_ : y, n_[0], n_[1]);
      }
      case 'a':
        return arc();
      case 'z':
        path_.close();
        return true;
      default:
        return false;
    }
  }

  bool cubic(double x1, double y1, double x2, double y2, double x, double y) {
    path_.curve(x1, y1, x2, y2, x, y);
    control_x_ = x2, control_y_ = y2;
    return true;
  }

  bool quadratic(double x1, double y1, double x, double y) {
    const double x0 = path_.x(), y0 = path_.y();
    path_.curve(x0 + (x1 - x0) * 2 / 3, y0 + (y1 - y0) * 2 / 3, x + (x1 - x) * 2 / 3,
                y + (y1 - y) * 2 / 3, x, y);
    control_x_ = x1, control_y_ = y1;
    return true;
  }

  bool arc() {
    const auto rx = scanner_.number(), ry = scanner_.number(), turn = scanner_.number();
    if (!rx || !ry || !turn) return false;
    const auto large = scanner_.flag(), sweep = scanner_.flag();
    if (!large || !sweep || !read(2)) return false;
    path_.arc({std::fabs(*rx), std::fabs(*ry), *turn, *large, *sweep}, n_[0], n_[1]);
    return true;
  }

  SvgScanner scanner_;
  PathBuilder& path_;
  char command_ = '\0', last_ = '\0';
  double control_x_ = 0, control_y_ = 0;  ///< the last control point
  std::array<double, 6> n_{};
};

}  // namespace

std::optional<std::vector<double>> svg_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (SvgScanner scanner(text); !scanner.done();) {
    const std::optional<double> number = scanner.number();
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<double> svg_length(std::string_view text) {
  struct Unit {
    std::string_view name;
    double units;
  };
  constexpr std::array<Unit, 5> kUnits{
      {{"px", 1}, {"mm", 96 / 25.4}, {"cm", 96 / 2.54}, {"in", 96}, {"pt", 96.0 / 72}}};
  text = trimmed(text);
  double units = 1;
  for (const Unit& unit : kUnits) {
    if (!text.ends_with(unit.name)) continue;
    text.remove_suffix(unit.name.size());
    units = unit.units;
    break;
  }
  const auto numbers = svg_numbers(text);
  if (!numbers || numbers->size() != 1) return std::nullopt;
  return numbers->front() * units;
}

Affine Affine::after(const Affine& inner) const {
  const drawing::PaperPoint origin = (*this)(inner.e, inner.f);
  return {a * inner.a + c * inner.b,
          b * inner.a + d * inner.b,
          a * inner.c + c * inner.d,
          b * inner.c + d * inner.d,
          origin.x,
          origin.y};
}

double Affine::scale() const { return std::sqrt(std::fabs(a * d - b * c)); }

std::optional<Affine> svg_transform(std::string_view text) {
  Affine all;
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    if (text.empty()) return all;
    const std::size_t open = text.find('('), close = text.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open)
      return std::nullopt;
    const auto numbers = svg_numbers(text.substr(open + 1, close - open - 1));
    if (!numbers) return std::nullopt;
    const auto one = one_transform(trimmed(text.substr(0, open)), *numbers);
    if (!one) return std::nullopt;
    all = all.after(*one);
    text.remove_prefix(close + 1);
  }
}

void PathBuilder::move(double x, double y) {
  drawing::append_pdf_point(out_, to_paper_(x, y));
  out_ += "m\n";
  start_x_ = x, start_y_ = y;
  lines_ = 0;
  go_to(x, y);
}

void PathBuilder::line(double x, double y) {
  has_inside_ = has_inside_ || ++lines_ > 1;
  drawing::append_pdf_point(out_, to_paper_(x, y));
  out_ += "l\n";
  go_to(x, y);
}

void PathBuilder::curve(double x1, double y1, double x2, double y2, double x, double y) {
  has_inside_ = true;
  drawing::append_pdf_point(out_, to_paper_(x1, y1));
  drawing::append_pdf_point(out_, to_paper_(x2, y2));
  drawing::append_pdf_point(out_, to_paper_(x, y));
  out_ += "c\n";
  go_to(x, y);
}

void PathBuilder::arc(const Arc& arc, double x, double y) {
  if (x == x_ && y == y_) return;
  if (arc.rx == 0 || arc.ry == 0) return line(x, y);
  has_inside_ = true;
  // In units of the half axes, turned upright, the arc is one of a circle of radius 1.
  const geometry::SinCos t = geometry::sin_cos(std::fmod(arc.turn_deg, 360) * kPi / 180);
  const double hx = (x - x_) / 2, hy = (y - y_) / 2;
  double rx = arc.rx, ry = arc.ry;
  double ux = (hx * t.cos + hy * t.sin) / rx, uy = (hy * t.cos - hx * t.sin) / ry;
  double half = ux * ux + uy * uy;  // of the chord, squared
  if (half > 1) {                   // too small an ellipse grows
    const double grow = std::sqrt(half);
    rx *= grow, ry *= grow, ux /= grow, uy /= grow;
    half = 1;
  }
  const double apart = std::sqrt((1 - half) / half) * (arc.large == arc.sweep ? -1 : 1);
  const double cx = -uy * apart, cy = ux * apart;  // the centre, from the middle of the chord
  const double from = geometry::arc_tan2(-uy - cy, -ux - cx);
  double turn = geometry::arc_tan2(uy - cy, ux - cx) - from;
  if (arc.sweep && turn < 0) turn += 2 * kPi;
  if (!arc.sweep && turn > 0) turn -= 2 * kPi;
  const Affine to_paper = to_paper_.after({1, 0, 0, 1, x_ + hx, y_ + hy})
                              .after({t.cos, t.sin, -t.sin, t.cos, 0, 0})
                              .after({rx, 0, 0, ry, 0, 0});
  drawing::append_pdf_arc(out_,
                          {to_paper(cx, cy), {to_paper.a, to_paper.b}, {to_paper.c, to_paper.d}},
                          from, turn, to_paper_(x, y));
  go_to(x, y);
}

void PathBuilder::ellipse(double cx, double cy, double rx, double ry) {
  move(cx + rx, cy);
  has_inside_ = true;
  const Affine to_paper = to_paper_.after({rx, 0, 0, ry, cx, cy});
  drawing::append_pdf_arc(out_,
                          {to_paper(0, 0), {to_paper.a, to_paper.b}, {to_paper.c, to_paper.d}}, 0,
                          2 * kPi, to_paper(1, 0));
  close();
}

void PathBuilder::close() {
  out_ += "h\n";
  lines_ = 0;
  go_to(start_x_, start_y_);
}

bool PathBuilder::add(std::string_view d) { return PathReader(d, *this).read(); }

}  // namespace strake::sheets
