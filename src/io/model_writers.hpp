// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "core/output_format.hpp"
#include "strake/core/result.hpp"
#include "strake/io/writer.hpp"

namespace strake::io {

/// One format that models are written in.
struct ModelWriter {
  OutputFormat format;
  /// Errors: output, cancelled.
  Status (*write)(const model::Model& model, const std::filesystem::path& path,
                  const WriteOptions& options, const parallel::Context& context);
};

/// Returns the writers of all formats, in the order of help and errors.
[[nodiscard]] std::span<const ModelWriter> model_writers();

}  // namespace strake::io
