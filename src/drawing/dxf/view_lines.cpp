// SPDX-License-Identifier: Apache-2.0
#include "drawing/dxf/view_lines.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "drawing/buffered_writer.hpp"
#include "drawing/dxf/entities.hpp"
#include "drawing/dxf/handles.hpp"
#include "drawing/ink/dash_fit.hpp"
#include "drawing/strokes/dash_runs.hpp"
#include "drawing/strokes/layer_pens.hpp"
#include "drawing/strokes/layers.hpp"
#include "drawing/strokes/strokes.hpp"
#include "geometry/numeric/trig.hpp"
#include "strake/parallel/deal.hpp"

namespace strake::drawing::dxf {

namespace {

using geometry::kPi;

/// Arcs whose ends are nearer than this, mm, and that are no full turns are drawn as their chords:
/// ends that are written alike would make a full turn of them.
constexpr double kShortestArc = 0.01;
/// What the axes of a circle may differ by, mm; and the share of a turn that may lack from a whole.
constexpr double kRound = 5e-4, kFull = 1e-7;

double rounded(double value, double per_unit) {
  return std::nearbyint(value * per_unit) / per_unit + 0.0;
}
PaperPoint rounded(const PaperPoint& p, double per_unit) {
  return {rounded(p.x, per_unit), rounded(p.y, per_unit)};
}

/// An arc against the clock, by its parameters from the major axis.
struct Arc {
  PaperPoint centre;
  EllipseAxes axes;
  double from = 0, to = 0;
  bool full = false;
};

double positive_turn(double angle) { return angle < 0 ? angle + 2 * kPi : angle; }

Arc arc_of(const Stroke& stroke, const StrokeRun& run) {
  // As the ends of lines, a centre is known to a micrometre.
  Arc arc{rounded(run.curve->centre, 1e3), axes_of(*run.curve)};
  arc.full = std::fabs(turn_of(stroke, run)) >= 2 * kPi * (1 - kFull) &&
             stroke.points[run.first] == stroke.points[run.last];
  const auto turn = geometry::sin_cos(arc.axes.turn_rad);
  const auto parameter = [&](const PaperPoint& p) {
    const double x = p.x - arc.centre.x, y = p.y - arc.centre.y;
    return positive_turn(geometry::arc_tan2((y * turn.cos - x * turn.sin) / arc.axes.minor,
                                            (x * turn.cos + y * turn.sin) / arc.axes.major));
  };
  arc.from = parameter(stroke.points[run.first]);
  arc.to = parameter(stroke.points[run.last]);
  if (run.forward == is_left_handed(*run.curve)) std::swap(arc.from, arc.to);
  return arc;
}

void append_curve(std::string& out, const EntityHead& head, const Arc& arc) {
  const auto degrees = [](double rad) { return rounded(rad * 180 / kPi, 1e8); };
  const auto& [major, minor, turn_rad] = arc.axes;
  if (major - minor <= kRound) {
    const double radius = rounded((major + minor) / 2, 1e6);
    if (arc.full) return append_circle(out, head, arc.centre, radius);
    const auto angle = [&](double parameter) {
      const double turned = degrees(parameter + turn_rad);
      return turned < 0 ? turned + 360 : turned >= 360 ? turned - 360 : turned;
    };
    return append_arc(out, head, arc.centre, radius, angle(arc.from), angle(arc.to));
  }
  const auto turn = geometry::sin_cos(turn_rad);
  append_ellipse(out, head, arc.centre,
                 rounded(PaperPoint{major * turn.cos, major * turn.sin}, 1e6),
                 rounded(minor / major, 1e10), arc.full ? 0 : rounded(arc.from, 1e10),
                 arc.full ? 2 * kPi : rounded(arc.to, 1e10));
}

/// Returns by what factor dashes are stretched for a run, which is an entity and begins with a dash
/// of its own.
double stretch_of_run(const Stroke& stroke, const StrokeRun& run, std::span<const double> dash) {
  double length = 0;
  for (std::size_t i = run.first; i < run.last; ++i)
    length += length_along(run.curve, stroke.points[i], stroke.points[i + 1]);
  const bool closed =
      run.last > run.first + 2 && stroke.points[run.first] == stroke.points[run.last];
  return fitted_stretch(length, closed ? DashEnds::closed : DashEnds::open, dash);
}

/// Appends the entity of a run of a stroke.
void append_run(std::string& out, const EntityHead& head, const Stroke& stroke,
                const StrokeRun& run, bool dashed) {
  const PaperPoint &a = stroke.points[run.first], &b = stroke.points[run.last];
  if (run.curve != nullptr) {
    const Arc arc = arc_of(stroke, run);
    const bool is_long =
        std::hypot(b.x - a.x, b.y - a.y) >= kShortestArc || std::fabs(turn_of(stroke, run)) > kPi;
    if (arc.full || is_long) return append_curve(out, head, arc);
  }
  if (run.curve != nullptr || run.last == run.first + 1) return append_line(out, head, a, b);
  append_polyline(out, head, std::span(stroke.points).subspan(run.first, run.last - run.first + 1),
                  dashed);
}

/// Says whose an entity is.
std::string object_data(const model::Object& object, const model::Model& model) {
  std::string data;
  Groups groups(data);
  groups.text(1001, kApplication);
  for (const std::string_view value : {std::string_view(object.id), std::string_view(object.name),
                                       std::string_view(model.files[object.file].label)})
    groups.text(1000, value_text(value, kMaxOfData));
  return data;
}

/// Returns the entities of the centre lines of a view.
std::string centre_lines_of(const ViewLines& view, const model::Model& model,
                            const LayerStyle& layer, Handle first) {
  const bool dashed = !layer.dash_mm.empty();
  std::string out;
  for (const CentreLine& line : view.ink.centre_lines) {
    Chain points;
    for (const PaperPoint& point : line.points) points.push_back(view.plane.place(point));
    const double stretch = dashed ? stretch_of(line, layer.dash_mm) : 1;
    const EntityHead head{Space::model, first++, layer.name, stretch};
    if (points.size() == 2)
      append_line(out, head, points.front(), points.back());
    else
      append_polyline(out, head, points, dashed);
    out += object_data(model.object(line.object), model);
  }
  return out;
}

/// Returns the entities of the break lines of a view.
std::string break_lines_of(const ViewLines& view, const model::Model& model,
                           std::span<const LayerStyle> layers, Handle first) {
  constexpr auto kLayer = static_cast<std::size_t>(ViewLayer::break_line);
  std::string out;
  for (const BreakLinesOfStyle& part : break_lines_by_style(view.ink)) {
    const bool plain = part.style == ObjectStyles::kPlain;
    const LayerStyle& layer =
        layers[plain ? kLayer : view.style_layers[part.style - 1].at(kLayer).value_or(kLayer)];
    for (const BreakLine* const line : part.lines) {
      Chain points;
      for (const PaperPoint& point : line->points) points.push_back(view.plane.place(point));
      append_polyline(out, {Space::model, first++, layer.name}, points, !layer.dash_mm.empty());
      out += object_data(model.object(line->object), model);
    }
  }
  return out;
}

/// The lines of a view by layers, those of an object side by side.
struct SortedLines {
  struct LinesOfObject {
    std::size_t layer = 0;  ///< its number
    bool dashes_fit = false;
    std::size_t begin = 0, end = 0;
  };
  std::vector<const Line*> lines;
  std::vector<LinesOfObject> objects;
};

bool is_hidden_layer(std::size_t layer) {
  return layer == static_cast<std::size_t>(ViewLayer::hidden_by_other) ||
         layer == static_cast<std::size_t>(ViewLayer::hidden_by_self);
}

Result<SortedLines> sorted_lines(const Ink& ink, const StyleLayers& style_layers,
                                 const parallel::Context& context) {
  const std::vector<Line>& all = ink.in_model_space();
  const auto of_layer = parallel::deal<const Line*, kViewLayers>(
      context, "lines of layers", all.size(),
      [&](std::size_t i) { return static_cast<std::size_t>(layer_of(all[i])); },
      [&](std::size_t i) { return &all[i]; });
  if (!of_layer) return of_layer.error();
  SortedLines sorted;
  sorted.lines.reserve(ink.in_model_space().size());
  for (std::size_t layer = 0; layer < kViewLayers; ++layer)
    for (const LinesOfStyle& part : by_style((*of_layer)[layer], ink)) {
      const bool plain = part.style == ObjectStyles::kPlain;
      const std::size_t number =
          plain ? layer : style_layers[part.style - 1].at(layer).value_or(layer);
      // Dashes of hidden lines fit each line, and so do those that a style requests.
      const bool fit = !plain || is_hidden_layer(layer);
      for_each_object(std::span<const Line* const>(part.lines),
                      [&](std::span<const Line* const> lines) {
                        const std::size_t begin = sorted.lines.size();
                        sorted.lines.insert(sorted.lines.end(), lines.begin(), lines.end());
                        sorted.objects.push_back({number, fit, begin, sorted.lines.size()});
                      });
    }
  return sorted;
}

/// Cuts the objects into shares of work of some thousand lines, or one object; returns where each
/// begins, and the end.
std::vector<std::size_t> shares_of(const std::vector<SortedLines::LinesOfObject>& objects) {
  constexpr std::size_t kLines = 4096;
  std::vector<std::size_t> begins{0};
  for (std::size_t i = 1; i < objects.size(); ++i)
    if (objects[i].end - objects[begins.back()].begin > kLines) begins.push_back(i);
  if (!objects.empty()) begins.push_back(objects.size());
  return begins;
}

/// Returns the dashes of a layer in mm of model space.
std::vector<double> dashes_in_model(const LayerStyle& style, double scale) {
  std::vector<double> dashes;
  for (const double dash : style.dash_mm) dashes.push_back(dash * scale);
  return dashes;
}

}  // namespace

Status write_view_lines(const ViewLines& view, const model::Model& model,
                        std::span<const LayerStyle> layers, Handle first, Sink sink,
                        const parallel::Context& context) {
  const Result<SortedLines> by_layer = sorted_lines(view.ink, view.style_layers, context);
  if (!by_layer) return by_layer.error();
  const SortedLines& sorted = *by_layer;
  const PaperCurves curves = view.plane.curves(view.curves);
  const auto append_object = [&](const SortedLines::LinesOfObject& of_object, std::string& out) {
    std::vector<Line> placed;
    std::vector<const Line*> lines;
    placed.reserve(of_object.end - of_object.begin);
    for (std::size_t i = of_object.begin; i < of_object.end; ++i) {
      const Line& line = *sorted.lines[i];
      placed.push_back(line);
      placed.back().a_paper = view.plane.place(line.a_mm, line.a_paper);
      placed.back().b_paper = view.plane.place(line.b_mm, line.b_paper);
    }
    for (const Line& line : placed) lines.push_back(&line);
    const std::string data = object_data(model.object(placed.front().object), model);
    const LayerStyle& layer = layers[of_object.layer];
    const std::vector<double> dash =
        of_object.dashes_fit ? dashes_in_model(layer, view.plane.scale()) : std::vector<double>{};
    Handle handle = first + of_object.begin;
    const auto append_stroke = [&](const Stroke& stroke) {
      for (const StrokeRun& run : stroke.runs) {
        const double stretch = dash.empty() ? 1 : stretch_of_run(stroke, run, dash);
        append_run(out, {Space::model, handle++, layer.name, stretch}, stroke, run,
                   !layer.dash_mm.empty());
        out += data;
      }
    };
    for (const JoinedLines& chain : join_lines(lines)) {
      if (dash.empty())
        append_stroke(stroke_of(chain, curves));
      else
        for (const DashRun& run : dash_runs(chain, curves, dash))
          append_stroke(stroke_of(run.chain, curves));
    }
  };
  const std::vector<std::size_t> shares = shares_of(sorted.objects);
  const parallel::ProgressPhase phase(context.progress, "dxf", sorted.lines.size());
  const Status status = make_in_order(
      "dxf", shares.size() - 1,
      [&](std::size_t share) {
        std::string text;
        for (std::size_t i = shares[share]; i < shares[share + 1]; ++i)
          append_object(sorted.objects[i], text);
        return text;
      },
      [&](const std::string& text, std::size_t share) {
        sink(text);
        phase.add(sorted.objects[shares[share + 1] - 1].end - sorted.objects[shares[share]].begin);
      },
      context);
  if (!status) return status;
  const Handle next = first + sorted.lines.size();
  sink(centre_lines_of(view, model, layers[static_cast<std::size_t>(ViewLayer::centre)], next));
  sink(break_lines_of(view, model, layers, next + view.ink.centre_lines.size()));
  return {};
}

}  // namespace strake::drawing::dxf
