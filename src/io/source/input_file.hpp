// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

/// Input files in memory, and the paths of files that they name.
namespace strake::io {

/// A whole file in memory. It is read, not mapped: a mapped file that another program shortens
/// while we read it would end this program.
class FileContent {
 public:
  /// Reads a file, long ones in pieces by the whole team. Errors: input, memory, cancelled.
  [[nodiscard]] static Result<FileContent> read(const std::filesystem::path& path,
                                                const parallel::Context& context = {});

  [[nodiscard]] std::span<const std::byte> bytes() const { return {data_.get(), size_}; }

 private:
  std::unique_ptr<std::byte[]> data_;
  std::size_t size_ = 0;
};

[[nodiscard]] inline std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Returns the text behind the mark that some writers put before UTF-8: it is no part of the first
/// line.
[[nodiscard]] inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

/// Returns the path of a file that another file names, if it lies in the same folder or below;
/// nothing for absolute names, names that climb out of the folder, and URLs, so that a model from
/// elsewhere cannot make this program read what its author should not see.
[[nodiscard]] std::optional<std::filesystem::path> safe_relative_path(
    const std::filesystem::path& referring_file, std::string_view name);

}  // namespace strake::io
