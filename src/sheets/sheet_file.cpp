// SPDX-License-Identifier: Apache-2.0
#include "strake/sheets/sheet_file.hpp"

#include <utility>

#include "settings/text_file.hpp"
#include "sheets/compose.hpp"
#include "sheets/description.hpp"

namespace strake::sheets {

Result<SheetFile> SheetFile::parse(std::string_view text, std::string_view file,
                                   ReadTemplate read_template) {
  Result<Description> found = parse_description(text, file, read_template);
  if (!found) return found.error();
  return SheetFile(std::make_shared<const Description>(std::move(*found)));
}

Result<SheetFile> SheetFile::read(const std::filesystem::path& file) {
  const Result<std::string> text =
      settings::read_text_file(file, "sheet file", "; models come before --sheet");
  if (!text) return text.error();
  return parse(*text, file.filename().string(), [&](std::string_view name) {
    return settings::read_text_file(file.parent_path() / name, "template", "");
  });
}

const std::string& SheetFile::template_name() const { return what_->template_name; }

Result<Sheet> SheetFile::compose(const model::Scene& scene, const ComposeOptions& options,
                                 const parallel::Context& context) const {
  return sheets::compose(*what_, scene, options, context);
}

}  // namespace strake::sheets
