// SPDX-License-Identifier: Apache-2.0
#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/output_format.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/diagnostics.hpp"
#include "python/bindings/model.hpp"
#include "python/bindings/run.hpp"
#include "sheets/output/sheet_writers.hpp"
#include "strake/core/atomic_file.hpp"
#include "strake/sheets/sheet_file.hpp"
#include "strake/sheets/write.hpp"

namespace nb = nanobind;

namespace strake::python {

namespace {

/// A sheet composed for a model.
struct SheetRun {
  ModelPointer model;
  sheets::Sheet sheet;
};

std::shared_ptr<SheetRun> compose(const sheets::SheetFile& file, const ModelPointer& model,
                                  const RunOptions& options) {
  return run(options, "sheet",
             [&](const parallel::Context& context) -> Result<std::shared_ptr<SheetRun>> {
               const auto scene = model->scene({}, context);
               if (!scene) return scene.error();
               Result<sheets::Sheet> sheet = file.compose(**scene, {}, context);
               if (!sheet) return sheet.error();
               return std::make_shared<SheetRun>(SheetRun{model, std::move(*sheet)});
             });
}

nb::bytes svg(const SheetRun& run) {
  std::string text;
  {
    const nb::gil_scoped_release others_may_run;
    sheets::write_svg(run.sheet, run.model->model(),
                      [&](std::string_view more) { text.append(more); });
  }
  return nb::bytes(text.data(), text.size());
}

/// Returns what could not be written as it is.
nb::list save(const SheetRun& run, const std::filesystem::path& path) {
  const auto writer = value_or_raise(find_writer(sheets::sheet_writers(), path.string()));
  AtomicFile file = value_or_raise(AtomicFile::create(path));
  const Diagnostics noticed =
      value_or_raise(writer.write({std::span(&run.sheet, 1), run.model->model()},
                                  [&](std::string_view text) { file.write(text); }, {}));
  check(file.commit());
  return listed(noticed);
}

}  // namespace

void bind_sheet(nb::module_& module) {
  nb::class_<sheets::SheetFile>(module, "SheetFile");
  nb::class_<SheetRun>(module, "SheetRun")
      .def_prop_ro("size_mm",
                   [](const SheetRun& run) {
                     return nb::make_tuple(run.sheet.width_mm, run.sheet.height_mm);
                   })
      .def_prop_ro("diagnostics", [](const SheetRun& run) { return listed(run.sheet.diagnostics); })
      .def_prop_ro("svg", &svg);
  module.def(
      "read_sheet",
      [](const std::filesystem::path& path) {
        return value_or_raise(sheets::SheetFile::read(path));
      },
      nb::arg("path"));
  module.def("compose_sheet", &compose, nb::arg("file"), nb::arg("model"), nb::arg("options"));
  module.def("save_sheet", &save, nb::arg("run"), nb::arg("path"));
}

}  // namespace strake::python
