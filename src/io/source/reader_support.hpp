// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/source/units_and_axes.hpp"
#include "strake/io/reader.hpp"

namespace strake::io {

/// Returns what every reader starts with: a model of one file whose facts that do not depend on the
/// content are filled in.
[[nodiscard]] model::Model start_model(const FileBytes& file, std::string format,
                                       const ReadOptions& options, const FrameDefault& fallback);

/// Returns what every reader ends with: the model and what its numbers can carry, or an error when
/// no object is left of the file. Other errors: cancelled, out of memory.
[[nodiscard]] Result<model::Model> end_model(const FileBytes& file, model::Model&& model,
                                             const parallel::Context& context);

[[nodiscard]] Error cancelled(const FileBytes& file);

/// Returns the extension in lower case, with the point: ".obj".
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

/// What a body has besides its shape and placement.
struct BodyAttributes {
  model::Color color = {};
  double half_spacing_mm = 0;  ///< half the spacing of the numbers that say where it is
};

/// What an object lacks because it needs a vertex that has no position or does not exist.
struct LeftOut {
  std::uint64_t faces = 0, lines = 0;
  std::string why, where;  ///< the reason and place of the first

  [[nodiscard]] bool any() const { return faces + lines != 0; }
};

/// Adds a diagnostic of what the object lacks, if anything; it is incomplete then.
void note_left_out(model::Model& model, model::Object& object, const LeftOut& lacks);

/// Appends a body with a shape of its own to the object that owns the last bodies of the model.
void add_body(model::Model& model, model::Object& object, model::Shape shape,
              const BodyAttributes& attributes);

}  // namespace strake::io
