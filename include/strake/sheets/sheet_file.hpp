// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

struct SheetSpec;

/// The text of the template of that name.
using ReadTemplate = parallel::FunctionRef<Result<std::string>(std::string_view name)>;

struct ComposeOptions {
  hlr::Solver solver = hlr::Solver::gather;
  /// Curved primitives are tessellated for the scale of each view (drawing::sag_for_paper), where
  /// the scene's are coarser. Otherwise they stay as they are.
  bool sag_for_paper = true;
};

/// A file that describes a sheet, understood but not yet held against a model. Immutable; cheap to
/// copy.
///
///     const auto file = sheets::SheetFile::read("deck.toml");
///     const auto sheet = file->compose(*scene, {}, context);
///     sheets::write_svg(*sheet, model, sink);
class SheetFile {
 public:
  /// `file` is what errors and diagnostics call it.
  ///
  /// Errors: input, with line and column, what is wrong there and how to mend it: keys that are not
  /// known, wrong types, names given twice, templates that are no SVG or hold more than drawing.
  [[nodiscard]] static Result<SheetFile> parse(std::string_view text, std::string_view file,
                                               ReadTemplate read_template);
  /// Templates are looked for beside the file.
  [[nodiscard]] static Result<SheetFile> read(const std::filesystem::path& file);

  /// As the file names it, beside itself; empty where it has none.
  [[nodiscard]] const std::string& template_name() const;

  /// Draws the views one after another and puts them on paper. The same for any team.
  ///
  /// Errors: cancelled, memory; input where the views have no room on the sheet at any scale.
  [[nodiscard]] Result<Sheet> compose(const model::Scene& scene, const ComposeOptions& options,
                                      const parallel::Context& context) const;

 private:
  explicit SheetFile(std::shared_ptr<const SheetSpec> what) : what_(std::move(what)) {}
  std::shared_ptr<const SheetSpec> what_;
};

}  // namespace strake::sheets
