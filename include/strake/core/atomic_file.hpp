// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "strake/core/result.hpp"

namespace strake {

/// A file that appears whole or not at all.
///
///     Result<AtomicFile> file = AtomicFile::create("clashes.json");
///     if (!file) return file.error();
///     file->write(text);
///     return file->commit();
///
/// What is written goes to a file beside the target; commit() brings it to the disk and renames it
/// over the target. Without a commit the destructor removes it, and what was there before stays.
/// A link is followed: its end is replaced, and the link stays. A file that is replaced hands on
/// its mode, and its owner and group where the writer may give them. A target that is no regular
/// file
/// (/dev/stdout, a pipe) is written directly.
class AtomicFile {
 public:
  [[nodiscard]] static Result<AtomicFile> create(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Writes into a buffer; an error is remembered and returned by commit().
  void write(std::string_view text);
  void write(std::span<const std::byte> bytes);
  [[nodiscard]] Status commit();
  /// The same for a file that is made again where it is lost: the disk gets it when the system
  /// finds the time.
  [[nodiscard]] Status commit_soon();

 private:
  AtomicFile() = default;
  void flush();
  void write_out(const char* data, std::size_t size);
  void discard() noexcept;
  [[nodiscard]] Status put_in_place(bool at_once);

  int descriptor_ = -1;
  int error_ = 0;
  bool direct_ = false;
  std::filesystem::path target_, temporary_;
  std::string buffer_;
};

/// Returns where a chain of links ends, which need not exist yet: what writing to `target`
/// replaces.
[[nodiscard]] std::filesystem::path resolve_links(const std::filesystem::path& target);

/// Writes a whole file through an AtomicFile.
[[nodiscard]] Status write_file(const std::filesystem::path& target, std::string_view text);

/// Removes what this process has begun to write for a target and not committed, for a program that
/// must end at once and cannot unwind.
void remove_partial_files(const std::filesystem::path& target) noexcept;

}  // namespace strake
