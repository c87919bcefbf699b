// SPDX-License-Identifier: Apache-2.0
#include "bcf/input/zip_reader.hpp"

#include <zip.h>

#include <algorithm>
#include <utility>

#include "core/text_encoding.hpp"

namespace strake::bcf {
namespace {

constexpr zip_int64_t kMaxListedEntries = 200'000;
constexpr std::size_t kPiece = std::size_t{1} << 16U;

struct EntryCloser {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

}  // namespace

void ZipReader::ArchiveCloser::operator()(zip* archive) const { zip_discard(archive); }

Result<ZipReader> ZipReader::open(const std::filesystem::path& file) {
  const std::string name = file.string();
  int code = 0;
  zip_t* const opened = zip_open(name.c_str(), ZIP_RDONLY, &code);
  if (opened == nullptr) {
    if (code == ZIP_ER_MEMORY) return out_of_memory();
    const bool missing = code == ZIP_ER_NOENT || code == ZIP_ER_OPEN;
    return Error{ErrorCode::input, missing ? "the file cannot be opened" : "this is no BCF file",
                 name, missing ? "check its name" : "a BCF file is a zip archive of topics"};
  }
  ZipReader reader(std::unique_ptr<zip, ArchiveCloser>(opened), name);
  if (const Status status = reader.list(); !status) return status.error();
  return reader;
}

Status ZipReader::list() {
  const zip_int64_t count = zip_get_num_entries(archive_.get(), 0);
  if (count > kMaxListedEntries)
    return Error{ErrorCode::input, "the archive has more than 200000 entries", name_,
                 "split it into several"};
  for (zip_int64_t i = 0; i < count; ++i) {
    const auto index = static_cast<zip_uint64_t>(i);
    const char* const name = zip_get_name(archive_.get(), index, ZIP_FL_ENC_GUESS);
    if (name == nullptr) continue;
    std::string text = valid_utf8(name);
    std::ranges::replace(text, '\\', '/');
    if (!text.empty() && !text.ends_with('/')) entries_.push_back({std::move(text), index});
  }
  std::ranges::sort(entries_, {}, &Entry::name);
  const auto twice = std::ranges::adjacent_find(entries_, {}, &Entry::name);
  if (twice != entries_.end()) return fault(*twice, "the archive has two files of this name");
  return {};
}

Result<std::string> ZipReader::read(const Entry& entry, std::size_t limit) {
  const std::unique_ptr<zip_file_t, EntryCloser> file(
      zip_fopen_index(archive_.get(), entry.index, 0));
  if (!file) {
    const int code = zip_error_code_zip(zip_get_error(archive_.get()));
    if (code == ZIP_ER_MEMORY) return out_of_memory();
    if (code == ZIP_ER_NOPASSWD) return fault(entry, "the file is encrypted");
    return fault(entry, "the file cannot be unpacked");
  }
  std::string bytes;
  for (;;) {
    const std::size_t had = bytes.size();
    bytes.resize(had + kPiece);
    const zip_int64_t got = zip_fread(file.get(), bytes.data() + had, kPiece);
    if (got < 0) return fault(entry, "the file is damaged");
    bytes.resize(had + static_cast<std::size_t>(got));
    unpacked_ += static_cast<std::uint64_t>(got);
    if (bytes.size() > limit) return fault(entry, "the file unpacks to more than it may");
    if (got == 0) return bytes;
  }
}

Error ZipReader::fault(const Entry& entry, std::string message) const {
  return {ErrorCode::input, std::move(message), name_ + ", " + printable(entry.name),
          "have it written again"};
}

}  // namespace strake::bcf
