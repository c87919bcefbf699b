// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "step_syntax.hpp"
#include "strake/core/result.hpp"

namespace strake::import_step {

enum class SourceKind { step, iges };

/// What the bytes of a file say of it before Open CASCADE sees any.
struct SourceFile {
  SourceKind kind = SourceKind::step;
  std::string format;  ///< "STEP AP214", "IGES"
  StepReferences references;
};

/// Looks at a file: whether it is one that can be read, and whole.
/// Errors: input, with what is wrong and how to mend it.
[[nodiscard]] Result<SourceFile> inspect_source(const std::filesystem::path& file);

}  // namespace strake::import_step
