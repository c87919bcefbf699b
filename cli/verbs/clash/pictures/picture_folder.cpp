// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/pictures/picture_folder.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>

#include "cli/options/options.hpp"
#include "core/text/counted.hpp"
#include "pictures/folder.hpp"

namespace strake::cli {
namespace {

Result<pictures::FolderOptions> folder_options(const PictureInput& given) {
  pictures::FolderOptions options;
  std::uint64_t max_pictures = options.max_pictures;
  if (const Status status = whole_number(max_pictures, given.max_pictures, "--top-pictures");
      !status)
    return status.error();
  options.max_pictures = max_pictures;
  if (given.format == "png") options.format = pictures::PictureFormat::png;
  return options;
}

}  // namespace

void add_picture_options(CLI::App& command, PictureInput& options) {
  const pictures::FolderOptions defaults;
  CLI::Option* const folder =
      command
          .add_option("--pictures", options.folder,
                      "A picture of each group, or of each clash without --group-by, in a folder "
                      "with an index: both objects coloured, what is round them thin")
          ->type_name("FOLDER")
          ->group("Result");
  command
      .add_option("--top-pictures", options.max_pictures,
                  fmt::format("Most pictures, of the worst (default {})", defaults.max_pictures))
      ->type_name("N")
      ->needs(folder)
      ->group("Result");
  add_choice(command, "--picture-format", options.format, {"svg", "png"},
             "Format of the pictures (default svg)")
      ->needs(folder)
      ->group("Result");
}

Status check_pictures(const PictureInput& given) {
  if (const auto options = folder_options(given); !options) return options.error();
  return given.folder.empty() ? Status{} : pictures::check_picture_folder(given.folder);
}

Status write_pictures(Session& session, const PictureInput& given,
                      const report::ClashContents& contents) {
  if (given.folder.empty()) return {};
  const Result<pictures::FolderOptions> options = folder_options(given);
  if (!options) return options.error();
  const auto timer = session.step("draw pictures");
  const auto count =
      pictures::write_picture_folder(contents, given.folder, *options, session.context());
  if (!count) return count.error();
  std::string summary = fmt::format("wrote {}: {}", given.folder, counted(count->drawn, "picture"));
  if (count->left_out > 0)
    summary += fmt::format(", {} more left out (--top-pictures)", count->left_out);
  if (count->cut_open > 0) summary += fmt::format(", {} cut open", count->cut_open);
  session.console().note(summary);
  return {};
}

}  // namespace strake::cli
