// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

#include <string>

#include "strake/core/diagnostics.hpp"

namespace strake::python {

/// Returns what was kept of diagnostics, each as severity, code, message, where.
[[nodiscard]] inline nanobind::list listed(const Diagnostics& diagnostics) {
  nanobind::list all;
  for (const Diagnostic& one : diagnostics.kept())
    all.append(nanobind::make_tuple(std::string(severity_name(one.severity)), one.code, one.message,
                                    one.where));
  return all;
}

}  // namespace strake::python
