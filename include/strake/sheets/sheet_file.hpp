// SPDX-License-Identifier: Apache-2.0
// Files that describe a sheet: reading one, and composing the sheet of a model.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

struct SheetSpec;

/// Returns the text of the template of that name.
using ReadTemplate = parallel::FunctionRef<Result<std::string>(std::string_view name)>;

struct ComposeOptions {
  hlr::Solver solver = hlr::Solver::gather;
  /// Curved primitives are tessellated for the scale of each view (drawing::sag_for_paper), where
  /// the scene's are coarser. Otherwise they stay as they are.
  bool sag_for_paper = true;
};

/// A file that describes a sheet or several, parsed but not yet applied to a model. Immutable;
/// cheap to copy.
///
///     const auto file = sheets::SheetFile::read("deck.toml");
///     const auto sheets = file->compose_all(*scene, {}, context);
///     sheets::write_pdf(*sheets, model, sink, context);
class SheetFile {
 public:
  /// Parses a description. `file` is its name in errors and diagnostics.
  ///
  /// Errors: input, with line and column, what is wrong there and how to mend it: keys that are not
  /// known, wrong types, names given twice, templates that are no SVG or hold more than drawing.
  [[nodiscard]] static Result<SheetFile> parse(std::string_view text, std::string_view file,
                                               ReadTemplate read_template);
  /// Reads and parses a file. Templates are looked for beside it.
  [[nodiscard]] static Result<SheetFile> read(const std::filesystem::path& file);

  /// Returns the names of its [[sheet]] tables in their order; one empty name where it describes
  /// a sheet without them.
  [[nodiscard]] std::vector<std::string> names() const;
  /// Returns the file as a part of a set: `before` sheets of other files come before its own, and
  /// there are `of` sheets in all. Title blocks count so.
  [[nodiscard]] SheetFile in_set(std::size_t before, std::size_t of) const;
  /// Returns the names of the templates as the file has them, relative to itself, each once.
  [[nodiscard]] std::vector<std::string> template_names() const;

  /// Draws the views one after another and puts them on paper. The result does not depend on the
  /// team.
  ///
  /// Errors: cancelled, memory; input where the views have no room on the sheet at any scale;
  /// usage where the file describes several sheets.
  [[nodiscard]] Result<Sheet> compose(const model::Scene& scene, const ComposeOptions& options,
                                      const parallel::Context& context) const;
  /// Composes all sheets of the file, one after another. Errors: those of compose().
  [[nodiscard]] Result<std::vector<Sheet>> compose_all(const model::Scene& scene,
                                                       const ComposeOptions& options,
                                                       const parallel::Context& context) const;

 private:
  explicit SheetFile(std::shared_ptr<const std::vector<SheetSpec>> what) : what_(std::move(what)) {}
  std::shared_ptr<const std::vector<SheetSpec>> what_;
};

}  // namespace strake::sheets
