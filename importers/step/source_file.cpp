// SPDX-License-Identifier: Apache-2.0
#include "source_file.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "iges_syntax.hpp"
#include "io/source/input_file.hpp"
#include "io/source/reader_support.hpp"

namespace strake::import_step {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// Returns the end of a text: enough for what a file ends with.
std::string_view end_of(std::string_view text) {
  constexpr std::size_t kEnd = std::size_t{1} << 12U;
  return text.substr(text.size() - std::min(text.size(), kEnd));
}

Error refused(const std::filesystem::path& file, std::string message, std::string mend) {
  return {ErrorCode::input, std::move(message), file.string(), std::move(mend)};
}

/// Returns which application protocol the schema of the head names.
std::string step_format(std::string_view schema) {
  struct Protocol {
    std::string_view word, name;
  };
  constexpr std::array<Protocol, 7> kProtocols{{{"AP242", "STEP AP242"},
                                                {"AP214", "STEP AP214"},
                                                {"AP203", "STEP AP203"},
                                                {"AP209", "STEP AP209"},
                                                {"AUTOMOTIVE_DESIGN", "STEP AP214"},
                                                {"CONFIG_CONTROL_DESIGN", "STEP AP203"},
                                                {"STRUCTURAL_FRAME", "STEP CIS/2"}}};
  const auto* const known = std::ranges::find_if(
      kProtocols, [&](const Protocol& p) { return schema.find(p.word) != std::string_view::npos; });
  return known == kProtocols.end() ? "STEP" : std::string(known->name);
}

Result<SourceFile> inspect_step(const std::filesystem::path& file, std::string_view text) {
  constexpr std::size_t kHead = std::size_t{1} << 16U;
  const std::string_view head = text.substr(0, kHead), end = end_of(text);
  const std::size_t at = head.find("FILE_SCHEMA");
  const std::string_view schema =
      at == std::string_view::npos ? "" : head.substr(at, head.find(';', at) - at);
  if (schema.find("'IFC") != std::string_view::npos)
    return refused(file, "the file is an IFC model, which this importer does not read",
                   "name it .ifc and install its importer: pip install 'strake[ifc]'");
  if (end.find("END-ISO-10303-21") == std::string_view::npos)
    return refused(file, "the file ends too soon: END-ISO-10303-21 is missing at its end",
                   "copy or export it again");
  Result<StepReferences> references = check_step_syntax(text, file);
  if (!references) return references.error();
  return SourceFile{SourceKind::step, step_format(schema), std::move(*references)};
}

Result<SourceFile> inspect_iges(const std::filesystem::path& file, std::string_view text) {
  if (const Status whole = check_iges_syntax(text, file); !whole) return whole.error();
  return SourceFile{SourceKind::iges, "IGES", {}};
}

}  // namespace

Result<SourceFile> inspect_source(const std::filesystem::path& file) {
  const Result<io::FileContent> content = io::FileContent::read(file);
  if (!content) return content.error();
  if (content->bytes().empty()) return refused(file, "is empty", "export the model again");
  const std::string_view whole = io::as_text(content->bytes());
  std::string_view text = io::without_byte_order_mark(whole);
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  // Lines are counted from the beginning of the file.
  if (text.starts_with("ISO-10303-21")) return inspect_step(file, whole);
  const std::string_view first = whole.substr(0, whole.find('\n'));
  if (is_iges_line(first, 'S')) return inspect_iges(file, whole);
  if (is_iges_line(first, 'B') || is_iges_line(first, 'C'))
    return refused(file, "the file is binary or compressed IGES, which is not read",
                   "export it as IGES in ASCII, or as STEP");
  if (text.starts_with("PK"))
    return refused(file, "the file is a zip archive", "unpack it and read what is in it");
  return refused(file,
                 "the file is neither STEP nor IGES: it does not begin with ISO-10303-21, nor has "
                 "its first line an S in column 73",
                 "export the model as STEP AP214 or AP242");
}

}  // namespace strake::import_step
