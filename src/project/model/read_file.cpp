// SPDX-License-Identifier: Apache-2.0
#include "io/read_file.hpp"

#include <new>
#include <utility>

#include "io/source/input_file.hpp"
#include "project/model/model_store.hpp"
#include "strake/io/importer.hpp"

namespace strake::project {
namespace {

Result<Hash128> hash_of_file(const std::filesystem::path& path, const parallel::Context& context) {
  const Result<io::FileContent> content = io::FileContent::read(path, context);
  if (!content) return content.error();
  Hasher hasher;
  hasher.add(content->bytes());
  for (const std::filesystem::path& other :
       io::files_read_with({path, content->bytes()}, context)) {
    // That one cannot be read changes what is read of the model, too.
    hasher.add(other.filename().string());
    const Result<io::FileContent> more = io::FileContent::read(other, context);
    hasher.add(std::uint64_t{more ? 1U : 0U});
    if (more) hasher.add(more->bytes());
  }
  return hasher.value();
}

Result<FileToStore> read_one(const io::FileToRead& file, const parallel::Context& context) {
  const Result<Hash128> before = hash_of_file(file.path, context);
  if (!before) return before.error();
  Result<io::ReadFile> read = io::read_file(file, io::import_settings_of_environment(), context);
  if (!read) return read.error();
  const Result<Hash128> after = hash_of_file(file.path, context);
  if (!after) return after.error();
  if (*before != *after)
    return Error{ErrorCode::input, "is being written while it is read", file.path.string(),
                 "try again when it is whole"};
  return FileToStore{file.path,          file.options,        *after, std::move(read->model), {},
                     file.path.string(), std::move(read->map)};
}

}  // namespace

Result<Hash128> content_hash(const std::filesystem::path& path, const parallel::Context& context) {
  try {
    return hash_of_file(path, context);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

void call_as_given(FileToStore& file, const std::string& given) {
  const Diagnostics before = std::exchange(file.model.diagnostics, Diagnostics());
  Diagnostics& after = file.model.diagnostics;
  for (Diagnostic one : before.kept()) {
    if (one.where.starts_with(file.given)) one.where.replace(0, file.given.size(), given);
    after.add(std::move(one));
  }
  for (const Diagnostics::Count& count : before.counts())
    if (count.count > Diagnostics::kMaxPerCode)
      after.count_more(count.code, count.count - Diagnostics::kMaxPerCode);
  file.given = given;
}

Result<FileToStore> read_file(const io::FileToRead& file, const parallel::Context& context) {
  try {
    return read_one(file, context);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

}  // namespace strake::project
