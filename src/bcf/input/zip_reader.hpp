// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "strake/core/result.hpp"

struct zip;  // NOLINT(readability-identifier-naming): libzip's own name

namespace strake::bcf {

/// A zip archive of which nothing is believed: no entry is written to the disk under its name, and
/// what one unpacks to is bounded whatever it states.
class ZipReader {
 public:
  struct Entry {
    std::string name;  ///< with '/' between folders, whatever the archive has
    std::uint64_t index = 0;
  };

  /// Opens an archive and lists its files. Errors: input for what is no archive, for more than
  /// 200,000 entries and for two files of one name.
  [[nodiscard]] static Result<ZipReader> open(const std::filesystem::path& file);

  /// The files, by name; folders are not among them.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

  /// Returns the bytes of a file. Errors: input where it is encrypted, damaged, packed by a method
  /// that is not known, or unpacks to more than `limit` bytes.
  [[nodiscard]] Result<std::string> read(const Entry& entry, std::size_t limit);

  /// How many bytes all that was read came to, that of files which were refused as well.
  [[nodiscard]] std::uint64_t unpacked() const { return unpacked_; }

 private:
  struct ArchiveCloser {
    void operator()(zip* archive) const;
  };
  ZipReader(std::unique_ptr<zip, ArchiveCloser> archive, std::string name)
      : archive_(std::move(archive)), name_(std::move(name)) {}
  Status list();
  [[nodiscard]] Error fault(const Entry& entry, std::string message) const;

  std::unique_ptr<zip, ArchiveCloser> archive_;
  std::string name_;
  std::vector<Entry> entries_;
  std::uint64_t unpacked_ = 0;
};

}  // namespace strake::bcf
