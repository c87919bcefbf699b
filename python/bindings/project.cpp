// SPDX-License-Identifier: Apache-2.0
#include "strake/project/project.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "python/bindings/bindings.hpp"
#include "python/bindings/model.hpp"
#include "python/bindings/run.hpp"
#include "strake/project/listing.hpp"

namespace nb = nanobind;

namespace strake::python {

namespace {

ModelPointer model_of(const std::filesystem::path& path, const RunOptions& options) {
  return std::make_shared<LoadedModel>(
      run(options, "load", [&](const parallel::Context& context) -> Result<model::Model> {
        Result<project::Project> opened = project::Project::open(path, {});
        if (!opened) return opened.error();
        return opened->model(context);
      }));
}

/// Names of columns, then the rows.
nb::tuple list_of(const std::filesystem::path& path, std::string_view kind, std::uint64_t limit,
                  const RunOptions& options) {
  const auto found = std::ranges::find(project::kListNames, kind);
  if (found == project::kListNames.end())
    raise({ErrorCode::usage, fmt::format("there is no list of '{}'", kind), "kind",
           fmt::format("write one of {}", fmt::join(project::kListNames, ", "))});
  const auto which = static_cast<project::ListKind>(found - project::kListNames.begin());
  const project::Listing listing =
      run(options, "list", [&](const parallel::Context& context) -> Result<project::Listing> {
        Result<project::Project> opened = project::Project::open(path, {});
        if (!opened) return opened.error();
        return project::list(*opened, which, limit, context);
      });
  return nb::make_tuple(listing.columns, listing.rows);
}

}  // namespace

void bind_project(nb::module_& module) {
  module.def(
      "create_project",
      [](const std::filesystem::path& path) {
        (void)value_or_raise(project::Project::create(path));
      },
      nb::arg("path"));
  module.def("is_project", &project::is_project, nb::arg("path"));
  module.def("project_model", &model_of, nb::arg("path"), nb::arg("options"));
  module.def("project_list", &list_of, nb::arg("path"), nb::arg("kind"), nb::arg("most"),
             nb::arg("options"));
}

}  // namespace strake::python
