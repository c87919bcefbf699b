// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TDocStd_Document.hxx>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "progress.hpp"
#include "source_file.hpp"
#include "strake/core/result.hpp"

namespace strake::import_step {

/// A file as Open CASCADE has it: products, places, colours and layers, all lengths in mm.
struct Document {
  Handle(TDocStd_Document) content;
  std::string unit;                      ///< of the file, "mm"; empty where it is none of ours
  std::size_t unknown = 0;               ///< entities of kinds that Open CASCADE does not know
  std::vector<std::string> not_read;     ///< entities of which no shape was made
  std::vector<std::string> outer_files;  ///< STEP files that this one refers to, as it spells them
  std::vector<std::string> missing_files;  ///< those of them that could not be read
};

/// Has Open CASCADE read a file. Errors: input, where it cannot.
[[nodiscard]] Result<Document> read_document(const std::filesystem::path& file, SourceKind kind,
                                             const Handle(ReportProgress) & progress);

}  // namespace strake::import_step
