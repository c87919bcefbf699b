// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "document.hpp"
#include "meshed_piece.hpp"
#include "report.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"

namespace strake::import_step {

/// How a document becomes a scene.
struct SceneOptions {
  MeshOptions mesh;
  SourceKind kind = SourceKind::step;
  std::string file_name;  ///< that names what the file leaves without a name
};

/// Makes the model of a document: assemblies are groups, instances of parts are objects, their
/// shapes are shared. What cannot be in it is reported in the report.
/// Errors: input, where nothing becomes an object, or there are too many.
[[nodiscard]] Result<model::Model> make_scene_model(const Document& document,
                                                    const SceneOptions& options, Report& report,
                                                    const Handle(ReportProgress) & progress);

}  // namespace strake::import_step
