// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/gltf/container.hpp"
#include "io/gltf/document.hpp"
#include "io/source/units_and_axes.hpp"
#include "strake/io/reader.hpp"

namespace strake::io::gltf {

struct ImportInput {
  const FileBytes& file;
  const ReadOptions& options;
  const parallel::Context& context;
};

/// Returns the standard's metres with y up, unless the file says otherwise as our own writer does.
[[nodiscard]] FrameDefault stated_frame(const JsonValue& root);

/// Turns a document whose version and extensions were checked into a model.
[[nodiscard]] Result<model::Model> import_document(const ImportInput& input,
                                                   const Container& container,
                                                   const Document& document);

/// Puts the file before the byte offset of an error of Document.
[[nodiscard]] Error error_in_json(const FileBytes& file, Error error);

}  // namespace strake::io::gltf
