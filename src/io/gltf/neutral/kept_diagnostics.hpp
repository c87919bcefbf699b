// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "io/gltf/json/json.hpp"
#include "strake/core/diagnostics.hpp"

/// What was noticed of the files that a neutral scene was made of: what is not in it is told when
/// it is read, too.
namespace strake::io::gltf {

/// Appends ,"diagnostics":[...] and ,"more":[...], which counts those that are not kept word for
/// word; nothing where there are none. What reading the scene notices again is left out.
void append_diagnostics(std::string& out, const Diagnostics& diagnostics);

/// Reads them from what the asset says of the scene.
[[nodiscard]] Diagnostics diagnostics_of(const JsonValue& scene);

}  // namespace strake::io::gltf
