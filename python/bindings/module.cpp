// SPDX-License-Identifier: Apache-2.0
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <string>
#include <string_view>

#include "core/units.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/errors.hpp"
#include "strake/core/version.hpp"

namespace nb = nanobind;

NB_MODULE(_core, module) {
  using namespace strake;  // the macro opens a function
  module.doc() = "What the package strake is built on. Its names may change in any version.";
  module.def("version", [] { return std::string(version()); });
  module.def(
      "length_mm",
      [](std::string_view text) { return python::value_or_raise(parse_distance_mm(text)); },
      nb::arg("text"), "Parses a length as the program does: '25mm', '1in'.");
  module.def(
      "unit_mm", [](std::string_view text) { return python::value_or_raise(parse_unit_mm(text)); },
      nb::arg("text"), "Returns how many millimetres a unit has.");
  python::bind_model(module);
  python::bind_given_meshes(module);
  python::bind_generate(module);
  python::bind_clash(module);
  python::bind_drawing(module);
  python::bind_sheet(module);
  python::bind_project(module);
  python::bind_tiles(module);
  python::bind_tiled_drawing(module);
}
