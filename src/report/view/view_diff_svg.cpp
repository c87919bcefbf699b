// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/number.hpp"
#include "report/text/formatting.hpp"
#include "strake/drawing/write.hpp"
#include "strake/report/view_diff.hpp"

namespace strake::report {
namespace {

using drawing::LineState;
using drawing::xml_escaped;

struct SvgPoint {
  double x = 0, y = 0;
};

/// How a change is drawn: in colours that colour-blind eyes tell apart (Okabe and Ito), the lines
/// of interest wide. Later ones are drawn over earlier ones.
struct DiffLineStyle {
  LineChange change;
  std::string_view color;
  double width_mm;
};
constexpr std::array<DiffLineStyle, kLineChanges> kLineStyles{
    {{LineChange::same, "#999", 0.13},
     {LineChange::changed, "#009e73", 0.35},
     {LineChange::gone, "#d55e00", 0.35},
     {LineChange::added, "#0072b2", 0.35}}};

bool is_hidden(LineState state) {
  return state == LineState::hidden_by_self || state == LineState::hidden_by_other;
}
bool has_ink(LineState state) { return state == LineState::visible || is_hidden(state); }

/// Returns what of an interval is seen on paper: what became visible or hidden is new there, what
/// no longer is either is gone.
std::optional<LineChange> visible_change(const ViewDiff& diff, const DiffInterval& s) {
  const bool is = has_ink(diff.piece(s).state);
  if (s.change != LineChange::changed) return is ? std::optional(s.change) : std::nullopt;
  const bool was = has_ink(s.was.state);
  if (is && was) return LineChange::changed;
  if (is) return LineChange::added;
  return was ? std::optional(LineChange::gone) : std::nullopt;
}

bool dashed(const ViewDiff& diff, const DiffInterval& s) {
  const LineState is = diff.piece(s).state;
  return is_hidden(has_ink(is) ? is : s.was.state);
}

SvgPoint at(const ViewPiece& piece, float t) {
  const auto mix = [&](std::size_t k) {
    return static_cast<double>(piece.a_paper.at(k)) +
           (static_cast<double>(piece.b_paper.at(k)) - static_cast<double>(piece.a_paper.at(k))) *
               static_cast<double>(t);
  };
  return {mix(0), mix(1)};
}

/// The shift from the older sheet to the newer one: by the scales, and by a place in the model that
/// both show. If there is none, they lie as they are.
struct Shift {
  double scale = 1;
  SvgPoint from, to;

  [[nodiscard]] SvgPoint operator()(const SvgPoint& p) const {
    return {to.x + (p.x - from.x) * scale, to.y + (p.y - from.y) * scale};
  }
};

Shift shift_of(const ViewDiff& diff) {
  Shift shift{diff.before->scale / diff.after->scale, {}, {}};
  // Both are by object and place, so that a walk over the two finds an end that they share.
  std::map<std::array<std::int64_t, 3>, const ViewPiece*> ends;
  for (const ViewPiece& piece : diff.before->pieces) {
    ends.try_emplace({piece.a.x, piece.a.y, piece.a.z}, &piece);
    if (ends.size() > 100'000) break;
  }
  for (const ViewPiece& piece : diff.after->pieces) {
    const auto found = ends.find({piece.a.x, piece.a.y, piece.a.z});
    if (found == ends.end()) continue;
    shift.from = at(*found->second, 0);
    shift.to = at(piece, 0);
    break;
  }
  return shift;
}

class DiffPicture {
 public:
  DiffPicture(const ViewDiff& diff, Sink sink)
      : diff_(diff), buffer_(sink), shift_(shift_of(diff)) {}

  void write() {
    find_frame();
    head();
    for (const DiffLineStyle& style : kLineStyles)
      for (const bool hidden : {true, false}) layer(style, hidden);
    legend();
    buffer_.text() += "</svg>\n";
  }

 private:
  static constexpr double kLegend = 12;

  [[nodiscard]] SvgPoint paper(const DiffInterval& s, float t) const {
    const SvgPoint p = at(diff_.piece(s), t);
    return s.change == LineChange::gone ? shift_(p) : p;
  }

  /// Fits the newer sheet, made larger where lines lie beyond it.
  void find_frame() {
    hi_ = {diff_.after->width_mm, diff_.after->height_mm};
    for (const DiffInterval& s : diff_.intervals) {
      if (!visible_change(diff_, s)) continue;
      for (const float t : {s.from, s.to}) {
        const SvgPoint p = paper(s, t);
        lo_ = {std::min(lo_.x, p.x), std::min(lo_.y, p.y)};
        hi_ = {std::max(hi_.x, p.x), std::max(hi_.y, p.y)};
      }
    }
    hi_.y += kLegend;
  }

  void head() {
    std::string& out = buffer_.text();
    const std::string x = fixed(lo_.x, 3), y = fixed(lo_.y, 3), width = fixed(hi_.x - lo_.x, 3),
                      height = fixed(hi_.y - lo_.y, 3);
    out += fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" "
        "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
        "width=\"{2}mm\" height=\"{3}mm\" viewBox=\"{0} {1} {2} {3}\">\n<title>",
        x, y, width, height);
    out += xml_escaped(diff_.before->name) + " \xE2\x86\x92 " + xml_escaped(diff_.after->name);
    out +=
        "</title>\n<style>\npath { fill: none; stroke-linecap: round; }\n"
        "text { font-family: sans-serif; font-size: 4px; }\n"
        ".hidden path { stroke-dasharray: 2 0.7; stroke-linecap: butt; }\n"
        ".same.hidden { opacity: 0.5; }\n";
    for (const DiffLineStyle& style : kLineStyles)
      out += fmt::format(
          ".{0} path {{ stroke: {1}; stroke-width: {2}; }}\n.{0} text {{ fill: {1}; }}\n",
          change_name(style.change), style.color, style.width_mm);
    out += fmt::format(
        "</style>\n<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", x, y,
        width, height);
  }

  void layer(const DiffLineStyle& style, bool hidden) {
    std::string& out = buffer_.text();
    const std::string_view name = change_name(style.change);
    bool open = false;
    std::optional<std::uint32_t> object;
    for (const DiffInterval& s : diff_.intervals) {
      if (visible_change(diff_, s) != style.change || dashed(diff_, s) != hidden) continue;
      if (!open)
        out += fmt::format(
            "<g inkscape:groupmode=\"layer\" inkscape:label=\"{0} {1}\" id=\"{0}-{1}\" "
            "class=\"{0} {1}\">\n",
            name, hidden ? "hidden" : "visible");
      open = true;
      const std::uint32_t of = diff_.line_class(s).object;
      if (object != of) {
        const ViewObject& o = *diff_.objects[of];
        out += fmt::format("{}<g data-id=\"{}\" data-name=\"{}\" data-file=\"{}\"><path d=\"",
                           object ? "\"/></g>\n" : "", xml_escaped(o.id), xml_escaped(o.name),
                           xml_escaped(o.file));
        object = of;
      }
      ++painted_[static_cast<std::size_t>(style.change)];
      const SvgPoint a = paper(s, s.from), b = paper(s, s.to);
      out += fmt::format("M{} {}L{} {}", rounded(a.x), rounded(a.y), rounded(b.x), rounded(b.y));
      buffer_.done();
    }
    if (open) out += "\"/></g>\n</g>\n";
  }

  static std::string rounded(double mm) { return shortest(std::round(mm * 1000) / 1000); }

  /// Shows how many intervals have which colour: what is seen here, which is not the count of the
  /// comparison. A line that is not drawn any more has changed, and what is gone is its ink.
  void legend() {
    std::string& out = buffer_.text();
    double x = lo_.x + 10;
    const double y = hi_.y - 5;
    out += "<g id=\"legend\">\n";
    for (const DiffLineStyle& style : kLineStyles) {
      out += fmt::format(
          "<g class=\"{0}\"><path d=\"M{1} {2}h12\"/><text x=\"{3}\" y=\"{4}\">{0}: "
          "{5}</text></g>\n",
          change_name(style.change), fixed(x, 3), fixed(y - 1.4, 3), fixed(x + 14, 3), fixed(y, 3),
          painted_.at(static_cast<std::size_t>(style.change)));
      x += 55;
    }
    out += "</g>\n";
  }

  const ViewDiff& diff_;
  BufferedWriter buffer_;
  Shift shift_;
  SvgPoint lo_, hi_;
  std::array<std::size_t, kLineChanges> painted_{};
};

}  // namespace

void write_view_diff_svg(const ViewDiff& diff, Sink sink) { DiffPicture(diff, sink).write(); }

}  // namespace strake::report
