// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "python/bindings/drawing.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"

/// The parts of the library's own requests that a request of Python stands for.
namespace strake::python {

[[nodiscard]] Result<hlr::View> view_of(const DrawRequest& request);
[[nodiscard]] Result<hlr::Options> line_options(const DrawRequest& request);
[[nodiscard]] Result<drawing::LayoutOptions> layout_options(const DrawRequest& request);
[[nodiscard]] model::SceneOptions scene_options(const DrawRequest& request);

}  // namespace strake::python
