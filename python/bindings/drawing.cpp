// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/drawing.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "core/output_format.hpp"
#include "drawing/drawing_writers.hpp"
#include "publish/drawing_formats.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/diagnostics.hpp"
#include "python/bindings/run.hpp"
#include "strake/core/atomic_file.hpp"
#include "strake/drawing/write.hpp"

namespace nb = nanobind;

namespace strake::python {

namespace {

using RunPointer = std::shared_ptr<DrawRun>;
using drawing::Line;

/// The lines lie in the drawing as they are shown.
nb::object segments(const RunPointer& run) {
  static_assert(sizeof(geometry::Vec3d) == 3 * sizeof(double) &&
                sizeof(drawing::PaperPoint) == 2 * sizeof(double) && sizeof(hlr::EdgeKind) == 1 &&
                sizeof(drawing::LineState) == 1);
  const std::vector<Field> fields{{"object", "<u4", offsetof(Line, object)},
                                  {"edge", "<u4", offsetof(Line, edge)},
                                  {"kind", "u1", offsetof(Line, kind)},
                                  {"state", "u1", offsetof(Line, state)},
                                  {"other", "<u4", offsetof(Line, other)},
                                  {"a", "(3,)<f8", offsetof(Line, a_mm)},
                                  {"b", "(3,)<f8", offsetof(Line, b_mm)},
                                  {"a_paper", "(2,)<f8", offsetof(Line, a_paper)},
                                  {"b_paper", "(2,)<f8", offsetof(Line, b_paper)}};
  const std::vector<Line>& lines = run->drawing.lines;
  return records_of(lines.data(), lines.size(), sizeof(Line), fields, keep_alive(run));
}

/// Chains of the lines that get ink: points, where each chain begins, its kind, state and object.
nb::tuple chains(const RunPointer& run) {
  std::vector<double> points;
  std::vector<std::uint32_t> starts, objects;
  std::vector<std::uint8_t> kinds, states;
  const Line* before = nullptr;
  for (const Line& line : run->ink.lines) {
    const bool goes_on = before != nullptr && before->object == line.object &&
                         before->kind == line.kind && before->state == line.state &&
                         before->b_paper == line.a_paper;
    if (!goes_on) {
      starts.push_back(static_cast<std::uint32_t>(points.size() / 2));
      objects.push_back(model::index(line.object));
      kinds.push_back(static_cast<std::uint8_t>(line.kind));
      states.push_back(static_cast<std::uint8_t>(line.state));
      points.insert(points.end(), {line.a_paper.x, line.a_paper.y});
    }
    points.insert(points.end(), {line.b_paper.x, line.b_paper.y});
    before = &line;
  }
  starts.push_back(static_cast<std::uint32_t>(points.size() / 2));
  const std::size_t p = points.size() / 2, c = objects.size();
  return nb::make_tuple(array_of(std::move(points), {p, 2}), array_of(std::move(starts), {c + 1}),
                        array_of(std::move(kinds), {c}), array_of(std::move(states), {c}),
                        array_of(std::move(objects), {c}));
}

nb::list names(std::size_t count, std::string_view (*name_of)(std::size_t)) {
  nb::list all;
  for (std::size_t i = 0; i < count; ++i) all.append(std::string(name_of(i)));
  return all;
}

nb::dict summary(const DrawRun& run) {
  nb::dict counts;
  for (std::size_t s = 0; s < drawing::kLineStates; ++s)
    counts[std::string(drawing::state_name(static_cast<drawing::LineState>(s))).c_str()] =
        run.drawing.count.at(s);
  return counts;
}

nb::bytes svg(const RunPointer& run) {
  std::string text;
  {
    const nb::gil_scoped_release others_may_run;
    drawing::write_svg(run->drawing, run->ink, run->model->model(),
                       [&](std::string_view more) { text.append(more); });
  }
  return nb::bytes(text.data(), text.size());
}

/// Returns what could not be written as it is.
nb::list save(const RunPointer& run, const std::filesystem::path& path, const RunOptions& options) {
  const auto writer = value_or_raise(publish::find_drawing_writer(path.string()));
  Diagnostics noticed;
  run_status(options, "write", [&](const parallel::Context& context) -> Status {
    Result<AtomicFile> file = AtomicFile::create(path);
    if (!file) return file.error();
    Result<Diagnostics> written = writer.write(
        {run->drawing, run->ink, run->model->model(), run->scene.get()},
        [&](std::string_view text) { file->write(text); }, context);
    if (!written) return written.error();
    noticed = std::move(*written);
    return file->commit();
  });
  return listed(noticed);
}

void bind_request(nb::module_& module) {
  nb::class_<DrawRequest>(module, "DrawRequest")
      .def(nb::init<>())
      .def_rw("view", &DrawRequest::view)
      .def_rw("direction", &DrawRequest::direction)
      .def_rw("up", &DrawRequest::up)
      .def_rw("eye", &DrawRequest::eye)
      .def_rw("target", &DrawRequest::target)
      .def_rw("near_mm", &DrawRequest::near_mm)
      .def_rw("field_of_view_deg", &DrawRequest::field_of_view_deg)
      .def_rw("limits", &DrawRequest::limits)
      .def_rw("leave_out_far_objects", &DrawRequest::leave_out_far_objects)
      .def_rw("sections", &DrawRequest::sections)
      .def_rw("select", &DrawRequest::select)
      .def_rw("uncut", &DrawRequest::uncut)
      .def_rw("hatches", &DrawRequest::hatches)
      .def_rw("styles", &DrawRequest::styles)
      .def_rw("hidden", &DrawRequest::hidden)
      .def_rw("centre_lines", &DrawRequest::centre_lines)
      .def_rw("thin", &DrawRequest::thin)
      .def_rw("single_line", &DrawRequest::single_line)
      .def_rw("split_hidden", &DrawRequest::split_hidden)
      .def_rw("break_lines", &DrawRequest::break_lines)
      .def_rw("stage", &DrawRequest::stage)
      .def_rw("intersections", &DrawRequest::intersections)
      .def_rw("own_polylines", &DrawRequest::own_polylines)
      .def_rw("smooth", &DrawRequest::smooth)
      .def_rw("keep_hidden", &DrawRequest::keep_hidden)
      .def_rw("visible_only", &DrawRequest::visible_only)
      .def_rw("flush_seams", &DrawRequest::flush_seams)
      .def_rw("obstructions", &DrawRequest::obstructions)
      .def_rw("insulation", &DrawRequest::insulation)
      .def_rw("sharp_angle_deg", &DrawRequest::sharp_angle_deg)
      .def_rw("contact_distance_mm", &DrawRequest::contact_distance_mm)
      .def_rw("sag_mm", &DrawRequest::sag_mm)
      .def_rw("weld_mm", &DrawRequest::weld_mm)
      .def_rw("scale", &DrawRequest::scale)
      .def_rw("paper", &DrawRequest::paper)
      .def_rw("title", &DrawRequest::title)
      .def_rw("pens", &DrawRequest::pens);
}

}  // namespace

void bind_drawing(nb::module_& module) {
  bind_request(module);
  nb::class_<DrawRun>(module, "DrawRun")
      .def_prop_ro("size_mm",
                   [](const DrawRun& run) {
                     return nb::make_tuple(run.drawing.sheet.width_mm, run.drawing.sheet.height_mm);
                   })
      .def_prop_ro("scale", [](const DrawRun& run) { return run.drawing.sheet.scale_text; })
      .def_prop_ro("summary", &summary)
      .def_prop_ro("model", [](const DrawRun& run) { return run.model; })
      .def_prop_ro("diagnostics", [](const DrawRun& run) { return listed(run.diagnostics); });
  module.attr("LINE_KINDS") =
      names(static_cast<std::size_t>(hlr::kLastEdgeKind) + 1,
            [](std::size_t i) { return drawing::kind_name(static_cast<hlr::EdgeKind>(i)); });
  module.attr("LINE_STATES") = names(drawing::kLineStates, [](std::size_t i) {
    return drawing::state_name(static_cast<drawing::LineState>(i));
  });
  module.def(
      "draw",
      [](const ModelPointer& model, const DrawRequest& request, const RunOptions& options) {
        return run(options, "draw",
                   [&](const parallel::Context& context) { return draw(model, request, context); });
      },
      nb::arg("model"), nb::arg("request"), nb::arg("options"));
  module.def(
      "shows_ink",
      [](const std::filesystem::path& path) {
        return value_or_raise(publish::find_drawing_writer(path.string())).needs_ink;
      },
      nb::arg("path"), "Whether a file shows the lines that get ink, or holds all that there are.");
  module.def("svg", &svg, nb::arg("run"));
  module.def("segments", &segments, nb::arg("run"));
  module.def("chains", &chains, nb::arg("run"));
  module.def("save_drawing", &save, nb::arg("run"), nb::arg("path"), nb::arg("options"));
}

}  // namespace strake::python
