// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/pages/bar_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string_view>

#include "strake/drawing/write.hpp"

namespace strake::cli {

namespace {

constexpr double kChartWidth = 900, kMarginLeft = 56, kMarginRight = 12, kMarginTop = 46,
                 kPlotHeight = 240, kNamesHeight = 96;
constexpr double kLegendHeight = 20;
/// Colours that remain apart for all kinds of colour vision (Okabe, Ito 2008).
constexpr std::array<std::string_view, 5> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                   "#56b4e9"};

/// Returns the step between the lines of a scale from 0 to `maximum`: 1, 2 or 5 times a power of
/// ten.
double step_of(double maximum) {
  constexpr double kLines = 6;
  const double power = std::pow(10, std::floor(std::log10(maximum / kLines)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (maximum / (factor * power) <= kLines) return factor * power;
  return 10 * power;
}

/// Writes one chart.
class ChartWriter {
 public:
  explicit ChartWriter(const BarChart& chart) : chart_(chart) {
    for (const BarChart::Series& series : chart.series)
      for (const double value : series.values) maximum_ = std::max(maximum_, value);
    for (const BarChart::Level& level : chart.levels) maximum_ = std::max(maximum_, level.value);
    if (!(maximum_ > 0) || !std::isfinite(maximum_)) maximum_ = 1;
    maximum_ *= 1.05;
  }

  std::string write() {
    put(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}" role="img" )"
        R"(font-family="sans-serif" font-size="12">)",
        kChartWidth, kMarginTop + kPlotHeight + kNamesHeight + kLegendHeight);
    put("<title>{}</title>", text(chart_.title));
    put(R"(<rect width="100%" height="100%" fill="#ffffff"/>)");
    put(R"(<text x="{}" y="22" font-size="15" font-weight="bold">{}</text>)", kMarginLeft,
        text(chart_.title));
    write_scale();
    for (std::size_t i = 0; i < chart_.names.size(); ++i) write_group(i);
    for (const BarChart::Level& level : chart_.levels) write_level(level);
    write_legend();
    text_ += "</svg>\n";
    return std::move(text_);
  }

 private:
  template <class... Values>
  void put(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    text_ += '\n';
  }
  static std::string text(std::string_view plain) { return drawing::xml_escaped(plain); }
  [[nodiscard]] double y(double value) const {
    return kMarginTop + kPlotHeight * (1 - value / maximum_);
  }

  void write_scale() {
    const double step = step_of(maximum_);
    for (int i = 0; i * step <= maximum_; ++i) {
      const double at = y(i * step);
      put(R"(<line x1="{}" x2="{}" y1="{:.1f}" y2="{:.1f}" stroke="#dddddd"/>)", kMarginLeft,
          kChartWidth - kMarginRight, at, at);
      put(R"(<text x="{}" y="{:.1f}" text-anchor="end">{:g}</text>)", kMarginLeft - 6, at + 4,
          i * step);
    }
    put(R"(<text x="{}" y="{}" text-anchor="end">{}</text>)", kMarginLeft - 6, kMarginTop - 8,
        text(chart_.unit));
  }

  void write_group(std::size_t i) {
    const double group =
        (kChartWidth - kMarginLeft - kMarginRight) / static_cast<double>(chart_.names.size());
    const double from = kMarginLeft + group * static_cast<double>(i);
    const double bar = group * 0.8 / static_cast<double>(chart_.series.size());
    for (std::size_t s = 0; s < chart_.series.size(); ++s) {
      const double value = chart_.series[s].values[i];
      if (!(value > 0)) continue;
      const double x = from + group * 0.1 + bar * static_cast<double>(s);
      put(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}">)"
          R"(<title>{}, {}: {:.3g}</title></rect>)",
          x, y(value), bar, kMarginTop + kPlotHeight - y(value), kColours[s % kColours.size()],
          text(chart_.names[i]), text(chart_.series[s].name), value);
      constexpr double kRoomForNumber = 26;
      if (bar >= kRoomForNumber)
        put(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle" font-size="10">{:.2f}</text>)",
            x + bar / 2, y(value) - 3, value);
    }
    const double middle = from + group / 2, under = kMarginTop + kPlotHeight + 14;
    put(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="end" )"
        R"svg(transform="rotate(-35 {:.1f} {:.1f})">{}</text>)svg",
        middle, under, middle, under, text(chart_.names[i]));
  }

  void write_level(const BarChart::Level& level) {
    put(R"(<line x1="{}" x2="{}" y1="{:.1f}" y2="{:.1f}" stroke="#333333" )"
        R"(stroke-dasharray="6 4"/>)",
        kMarginLeft, kChartWidth - kMarginRight, y(level.value), y(level.value));
    put(R"(<text x="{}" y="{:.1f}" text-anchor="end" fill="#333333">{}</text>)",
        kChartWidth - kMarginRight, y(level.value) - 4, text(level.label));
  }

  void write_legend() {
    constexpr double kWidest = 210;
    const double each =
        std::min(kWidest, (kChartWidth - kMarginLeft) / static_cast<double>(chart_.series.size()));
    double x = kMarginLeft;
    const double at = kMarginTop + kPlotHeight + kNamesHeight + 4;
    for (std::size_t s = 0; s < chart_.series.size(); ++s, x += each) {
      put(R"(<rect x="{}" y="{}" width="12" height="12" fill="{}"/>)", x, at,
          kColours[s % kColours.size()]);
      put(R"(<text x="{}" y="{}">{}</text>)", x + 18, at + 11, text(chart_.series[s].name));
    }
  }

  const BarChart& chart_;
  double maximum_ = 0;
  std::string text_;
};

}  // namespace

std::string bar_chart_svg(const BarChart& chart) { return ChartWriter(chart).write(); }

}  // namespace strake::cli
