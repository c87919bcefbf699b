// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/gltf/container.hpp"
#include "io/gltf/json/json.hpp"
#include "strake/io/reader.hpp"

namespace strake::io::gltf {

struct ImportInput {
  const FileBytes& file;
  const ReadOptions& options;
  const parallel::Context& context;
};

/// Turns a document whose version and extensions were checked into a model.
[[nodiscard]] Result<model::Model> import_document(const ImportInput& input,
                                                   const Container& container,
                                                   const JsonValue& root);

}  // namespace strake::io::gltf
