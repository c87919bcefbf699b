// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "report/document_fault.hpp"
#include "report/json_reader.hpp"
#include "strake/core/result.hpp"

namespace strake::report {

/// What errors about a kind of document tell to do.
struct DocumentKind {
  std::string_view writer;  ///< "strake clash -o FILE.json"
  std::string_view again;   ///< "run the test again"
};

[[nodiscard]] Error document_error(const std::string& name, const DocumentKind& kind,
                                   const JsonReader::Fault& fault);
[[nodiscard]] Error document_error(const std::string& name, const DocumentKind& kind,
                                   const DocumentFault& fault);

/// Errors: input for a folder and for what cannot be opened.
[[nodiscard]] Result<std::ifstream> open_document(const std::filesystem::path& file);

/// Runs what reads a document; what it throws becomes an error that names the file.
template <class Read>
[[nodiscard]] Status read_guarded(const std::string& name, const DocumentKind& kind, Read&& read) {
  try {
    std::forward<Read>(read)();
  } catch (const DocumentFault& fault) {
    return document_error(name, kind, fault);
  } catch (const JsonReader::Fault& fault) {
    return document_error(name, kind, fault);
  }
  return {};
}

}  // namespace strake::report
