// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

/// What the extension is made of, a source each.
namespace strake::python {

void bind_model(nanobind::module_& module);
void bind_given_meshes(nanobind::module_& module);
void bind_generate(nanobind::module_& module);
void bind_clash(nanobind::module_& module);
void bind_drawing(nanobind::module_& module);
void bind_sheet(nanobind::module_& module);
void bind_project(nanobind::module_& module);
void bind_tiles(nanobind::module_& module);
void bind_tiled_drawing(nanobind::module_& module);

}  // namespace strake::python
