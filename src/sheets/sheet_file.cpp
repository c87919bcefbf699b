// SPDX-License-Identifier: Apache-2.0
#include "strake/sheets/sheet_file.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "settings/text_file.hpp"
#include "sheets/compose_sheet.hpp"
#include "sheets/spec/sheet_spec.hpp"

namespace strake::sheets {

Result<SheetFile> SheetFile::parse(std::string_view text, std::string_view file,
                                   ReadTemplate read_template) {
  Result<std::vector<SheetSpec>> found = parse_sheet_specs(text, file, read_template);
  if (!found) return found.error();
  return SheetFile(std::make_shared<const std::vector<SheetSpec>>(std::move(*found)));
}

Result<SheetFile> SheetFile::read(const std::filesystem::path& file) {
  const Result<std::string> text =
      settings::read_text_file(file, "sheet file", "; models come before --sheet");
  if (!text) return text.error();
  return parse(*text, file.filename().string(), [&](std::string_view name) {
    return settings::read_text_file(file.parent_path() / name, "template", "");
  });
}

std::vector<std::string> SheetFile::names() const {
  std::vector<std::string> names;
  for (const SheetSpec& sheet : *what_) names.push_back(sheet.name);
  return names;
}

SheetFile SheetFile::in_set(std::size_t before, std::size_t of) const {
  std::vector<SheetSpec> sheets = *what_;
  for (SheetSpec& sheet : sheets) {
    sheet.number += before;
    sheet.of = of;
  }
  return SheetFile(std::make_shared<const std::vector<SheetSpec>>(std::move(sheets)));
}

std::vector<std::string> SheetFile::template_names() const {
  std::vector<std::string> names;
  for (const SheetSpec& sheet : *what_)
    if (!sheet.template_name.empty() &&
        std::ranges::find(names, sheet.template_name) == names.end())
      names.push_back(sheet.template_name);
  return names;
}

Result<Sheet> SheetFile::compose(const model::Scene& scene, const ComposeOptions& options,
                                 const parallel::Context& context) const {
  if (what_->size() != 1)
    return Error{ErrorCode::usage,
                 "the file describes " + std::to_string(what_->size()) + " sheets, not one",
                 what_->front().file, "compose all of them"};
  return sheets::compose(what_->front(), scene, options, context);
}

Result<std::vector<Sheet>> SheetFile::compose_all(const model::Scene& scene,
                                                  const ComposeOptions& options,
                                                  const parallel::Context& context) const {
  std::vector<Sheet> sheets;
  for (const SheetSpec& what : *what_) {
    Result<Sheet> sheet = sheets::compose(what, scene, options, context);
    if (!sheet) return sheet.error();
    sheets.push_back(std::move(*sheet));
  }
  return sheets;
}

}  // namespace strake::sheets
