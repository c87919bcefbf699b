// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

#include "strake/core/result.hpp"

namespace strake::io {

/// A file that appears under its name only when it is complete: the bytes go to a partial file
/// beside it, which commit() renames and the destructor otherwise removes.
///
/// Something that is not a regular file (a pipe, /dev/null) is written directly. A write that
/// fails is remembered and reported by commit(); writes after it do nothing.
class OutputFile {
 public:
  [[nodiscard]] static Result<OutputFile> create(const std::filesystem::path& path);

  OutputFile(OutputFile&&) noexcept;
  OutputFile& operator=(OutputFile&&) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  void write(std::string_view bytes);
  /// Makes the file appear, replacing one of that name. To be called once.
  [[nodiscard]] Status commit();

 private:
  struct State;
  explicit OutputFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Writes a whole text or byte string that way.
[[nodiscard]] Status write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace strake::io
