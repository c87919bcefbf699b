// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/errors.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <array>
#include <cstddef>

namespace nb = nanobind;

namespace strake::python {

void raise(const Error& error) {
  // In the order of ErrorCode.
  constexpr std::array kCodes{"usage", "input", "output", "cancelled", "memory", "internal"};
  const nb::object made = nb::module_::import_("strake._errors")
                              .attr("error_of")(kCodes.at(static_cast<std::size_t>(error.code)),
                                                error.message, error.where, error.mend);
  PyErr_SetObject(made.type().ptr(), made.ptr());
  throw nb::python_error();
}

}  // namespace strake::python
