// SPDX-License-Identifier: Apache-2.0
#include "pictures/folder.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "pictures/drawn/caption.hpp"
#include "pictures/folder/shown_subjects.hpp"
#include "strake/core/atomic_file.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/write.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::pictures {
namespace {

namespace fs = std::filesystem;

/// A folder that appears whole or not at all: files are put into one beside it, which takes its
/// place at the end. Without a commit the destructor removes what was put there.
class NewFolder {
 public:
  /// Errors: output.
  [[nodiscard]] static Result<NewFolder> beside(const std::filesystem::path& target);
  ~NewFolder();
  NewFolder(NewFolder&& other) noexcept;
  NewFolder& operator=(NewFolder&& other) = delete;
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// Where files go for now.
  [[nodiscard]] const std::filesystem::path& path() const { return temporary_; }
  /// Puts it in the place of the target, which is removed where it is there. Errors: output.
  [[nodiscard]] Status commit();

 private:
  NewFolder() = default;

  std::filesystem::path target_, temporary_;
};

Error cannot_write(const fs::path& target, const std::error_code& why) {
  return {ErrorCode::output, "cannot write the folder: " + why.message(), target.string(),
          "choose a place that can be written to"};
}

Result<NewFolder> NewFolder::beside(const fs::path& target) {
  NewFolder folder;
  std::error_code fault;
  folder.target_ = fs::absolute(target, fault).lexically_normal();
  if (fault) return cannot_write(target, fault);
  if (!folder.target_.has_filename()) folder.target_ = folder.target_.parent_path();
  // What the mask of the process allows holds for this folder as for any other.
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries && !fault; ++i) {
    const fs::path name = folder.target_.parent_path() /
                          ("." + folder.target_.filename().string() + ".new" + std::to_string(i));
    if (!fs::create_directory(name, fault)) continue;
    folder.temporary_ = name;
    return folder;
  }
  return cannot_write(target, fault ? fault : std::make_error_code(std::errc::file_exists));
}

NewFolder::NewFolder(NewFolder&& other) noexcept
    : target_(std::move(other.target_)), temporary_(std::exchange(other.temporary_, {})) {}

NewFolder::~NewFolder() {
  std::error_code fault;
  if (!temporary_.empty()) fs::remove_all(temporary_, fault);
}

Status NewFolder::commit() {
  std::error_code fault;
  const fs::path old = temporary_.string() + ".old";
  const bool replaces = fs::exists(target_, fault);
  if (replaces) fs::rename(target_, old, fault);
  if (fault) return cannot_write(target_, fault);
  fs::rename(temporary_, target_, fault);
  if (fault) {
    std::error_code ignored;
    if (replaces) fs::rename(old, target_, ignored);
    return cannot_write(target_, fault);
  }
  temporary_.clear();
  if (replaces) fs::remove_all(old, fault);
  return {};
}

constexpr std::string_view kIndex = "index.html";
constexpr std::string_view kFirstLine = "<!DOCTYPE html><!-- pictures of clashes by Strake -->";

std::string_view suffix(PictureFormat format) {
  return format == PictureFormat::svg ? ".svg" : ".png";
}

/// Whether a file is one of those that a folder of pictures has.
bool is_picture(const fs::path& file) {
  constexpr std::size_t kKey = 26;
  const std::string stem = file.stem().string();
  return stem.size() == kKey &&
         stem.find_first_not_of("0123456789abcdefghjkmnpqrstvwxyz") == std::string::npos &&
         (file.extension() == ".svg" || file.extension() == ".png");
}

/// Whether a folder is empty or holds nothing but pictures with the index that is written here.
bool may_be_replaced(const fs::path& folder, std::error_code& fault) {
  bool index = false, any = false;
  for (fs::directory_iterator at(folder, fault), end; !fault && at != end; at.increment(fault)) {
    any = true;
    if (at->path().filename() == kIndex)
      index = true;
    else if (!is_picture(at->path()))
      return false;
  }
  if (!any || !index) return !any;
  std::string line;
  std::ifstream file(folder / kIndex);
  return std::getline(file, line) && line == kFirstLine;
}

std::string index_page(const std::vector<NamedSubject>& shown,
                       const report::ClashContents& contents, PictureFormat format,
                       std::size_t drawn) {
  using drawing::xml_escaped;
  std::string out{kFirstLine};
  out += R"(
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Pictures of clashes</title>
<style>
body{font:15px/1.4 system-ui,sans-serif;margin:1.5rem;color:#222;background:#fff}
main{display:grid;grid-template-columns:repeat(auto-fill,minmax(20rem,1fr));gap:1rem}
figure{margin:0;border:1px solid #bbb}img{display:block;width:100%;height:auto}
figcaption{padding:.5rem;overflow-wrap:anywhere}code{color:#555}
</style></head><body>
<h1>Pictures of clashes</h1>
)";
  out += "<p>" + std::to_string(drawn) + " of " + std::to_string(shown.size()) +
         ", the worst first.</p>\n<main>\n";
  for (std::size_t i = 0; i < drawn; ++i) {
    const NamedSubject& one = shown[i];
    const std::string title = xml_escaped(title_of(contents, one.subject));
    const std::string file = one.key + std::string(suffix(format));
    out += "<figure id=\"" + one.key + "\"><a href=\"" + file + "\"><img loading=\"lazy\" src=\"" +
           file + "\" alt=\"" + title + "\"></a><figcaption>" + std::to_string(one.number) + ". " +
           (one.name.empty() ? "" : "<b>" + xml_escaped(one.name) + "</b><br>") + title +
           "<br><code>" + one.key + "</code></figcaption></figure>\n";
  }
  out += "</main></body></html>\n";
  return out;
}

/// Draws one picture of many, which are drawn side by side. Returns whether it is cut open.
class FolderDrawer {
 public:
  FolderDrawer(const Scenery& scenery, const FolderOptions& options, const fs::path& folder)
      : scenery_(scenery), options_(options), folder_(folder) {}

  Result<std::uint8_t> draw(const NamedSubject& shown, const parallel::Context& context) const {
    const auto viewpoint =
        choose_viewpoint(scenery_, shown.subject, {view_aspect(options_.picture)}, context);
    if (!viewpoint) return viewpoint.error();
    const auto picture = draw_clash(scenery_, shown.subject, *viewpoint, options_.picture, context);
    if (!picture) return picture.error();
    const Result<std::string> bytes = bytes_of(*picture);
    if (!bytes) return bytes.error();
    const fs::path file = folder_ / (shown.key + std::string(suffix(options_.format)));
    if (const Status status = write_file(file, *bytes); !status) return status.error();
    return static_cast<std::uint8_t>(viewpoint->clipping_planes.empty() ? 0 : 1);
  }

 private:
  [[nodiscard]] Result<std::string> bytes_of(const ClashPicture& picture) const {
    if (options_.format == PictureFormat::png) {
      const double height = options_.width_px * picture.height_mm / picture.width_mm;
      return png_of(picture, options_.width_px, static_cast<std::uint32_t>(height + 0.5));
    }
    std::string text;
    const Status status = write_svg(picture, [&](std::string_view piece) { text += piece; });
    if (!status) return status.error();
    return text;
  }

  const Scenery& scenery_;
  const FolderOptions& options_;
  const fs::path& folder_;
};

}  // namespace

Status check_picture_folder(const fs::path& folder) {
  std::error_code fault;
  const fs::file_status there = fs::status(folder, fault);
  if (there.type() == fs::file_type::not_found) return {};
  if (!fault && fs::is_directory(there) && may_be_replaced(folder, fault) && !fault) return {};
  return Error{
      ErrorCode::output, fault ? fault.message() : "holds something else than pictures of clashes",
      folder.string(), "name a folder that is not there yet, or an earlier one of pictures"};
}

Result<FolderCount> write_picture_folder(const report::ClashContents& contents,
                                         const fs::path& folder, const FolderOptions& options,
                                         const parallel::Context& context) {
  if (const Status status = check_picture_folder(folder); !status) return status.error();
  const Result<Scenery> scenery = Scenery::of(contents, context);
  if (!scenery) return scenery.error();
  const std::vector<NamedSubject> shown = shown_subjects(contents);
  FolderCount count;
  count.drawn = std::min(shown.size(), options.max_pictures);
  count.left_out = shown.size() - count.drawn;
  Result<NewFolder> made = NewFolder::beside(folder);
  if (!made) return made.error();
  const FolderDrawer drawer(*scenery, options, made->path());
  const auto cut = parallel::transform(
      context, {.name = "pictures of clashes", .n = count.drawn}, [&](std::size_t i) {
        return drawer.draw(shown[i], parallel::Context{.stop = context.stop});
      });
  if (!cut) return cut.error();
  for (const std::uint8_t one : *cut) count.cut_open += one;
  const Status written =
      write_file(made->path() / kIndex, index_page(shown, contents, options.format, count.drawn));
  if (!written) return written.error();
  if (const Status status = made->commit(); !status) return status.error();
  return count;
}

}  // namespace strake::pictures
