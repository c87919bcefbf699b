// SPDX-License-Identifier: Apache-2.0
#include "report/document/document_reader.hpp"

#include <filesystem>
#include <system_error>

namespace strake::report {

Error document_error(const std::string& name, const DocumentKind& kind,
                     const DocumentFault& fault) {
  const std::string mend =
      fault.edited
          ? "it was cut short or edited: " + std::string(kind.again) + " or copy the file anew"
          : "give a file that '" + std::string(kind.writer) + "' of this version wrote";
  return {ErrorCode::input, fault.where + " " + fault.what, name, mend};
}

Error document_error(const std::string& name, const DocumentKind& kind,
                     const JsonReader::Fault& fault) {
  if (fault.what == JsonReader::Fault::What::deep)
    return document_error(name, kind, DocumentFault{"the document", "is nested too deeply"});
  const std::string where = name + ":" + std::to_string(fault.line);
  if (fault.what == JsonReader::Fault::What::cut)
    return {ErrorCode::input, "the file ends too soon", where,
            "it was cut off: " + std::string(kind.again) + " or copy the file anew"};
  return {ErrorCode::input, "this is no JSON", where,
          "give a file that '" + std::string(kind.writer) + "' wrote"};
}

Result<std::ifstream> open_document(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    return Error{ErrorCode::input, "is a folder", name, "name a file in it"};
  std::ifstream in(file, std::ios::binary);
  if (!in && !std::filesystem::exists(file, ignored))
    return Error{ErrorCode::input, "cannot be read: there is no such file", name, "check the path"};
  if (!in) return Error{ErrorCode::input, "cannot be read", name, "check who may read it"};
  return in;
}

}  // namespace strake::report
