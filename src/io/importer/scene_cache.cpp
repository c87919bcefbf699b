// SPDX-License-Identifier: Apache-2.0
#include "io/importer/scene_cache.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "io/importer/work_folder.hpp"

namespace strake::io {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

constexpr std::string_view kSuffix = ".scene";
/// No importer works for longer: what is older was left behind by a run that was killed.
constexpr seconds kForgotten = std::chrono::hours(48);

constexpr std::int64_t kNanoseconds = 1'000'000'000;

/// A file of the folder.
struct Found {
  fs::path path;
  std::uint64_t bytes = 0;
  std::int64_t used_ns = 0;  ///< since 1970
  bool work = false;         ///< a folder in which an importer works, or worked
};

std::vector<Found> files_in(const fs::path& folder) {
  std::vector<Found> files;
  std::error_code failed;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
    const std::string name = at->path().filename().string();
    struct stat facts{};
    if (::lstat(at->path().c_str(), &facts) != 0) continue;
    const bool work = name.starts_with(kWorkPrefix) && S_ISDIR(facts.st_mode);
    if (!work && !(name.ends_with(kSuffix) && S_ISREG(facts.st_mode))) continue;
    files.push_back({at->path(), work ? 0 : static_cast<std::uint64_t>(facts.st_size),
                     facts.st_mtim.tv_sec * kNanoseconds + facts.st_mtim.tv_nsec, work});
  }
  return files;
}

std::chrono::system_clock::time_point now() { return std::chrono::system_clock::now(); }

/// Returns how long ago a file was used last.
seconds unused_for(const Found& file, std::chrono::system_clock::time_point at) {
  const std::chrono::nanoseconds since = at.time_since_epoch();
  return std::max(seconds(0), seconds((since.count() - file.used_ns) / kNanoseconds));
}

void remove_forgotten(const std::vector<Found>& files) {
  const auto today = now();
  std::error_code ignored;
  for (const Found& file : files)
    if (file.work && unused_for(file, today) > kForgotten) fs::remove_all(file.path, ignored);
}

/// Appends to a file; returns what is wrong, 0 where nothing is.
int append_to(const fs::path& file, std::string_view text) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return errno;
  int fault = 0;
  while (!text.empty() && fault == 0) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno != EINTR) fault = errno;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::close(descriptor) != 0 && fault == 0) fault = errno;
  return fault;
}

std::string words_of(int fault) { return std::generic_category().message(fault); }

}  // namespace

fs::path SceneCache::file_of(const Hash128& key) const {
  return folder_ / (key.text() + std::string(kSuffix));
}

std::optional<std::string> SceneCache::open() const {
  std::error_code failed;
  fs::create_directories(folder_, failed);
  if (failed) return failed.message();
  if (::access(folder_.c_str(), W_OK | X_OK) != 0) return words_of(errno);
  return std::nullopt;
}

std::optional<EntryFacts> SceneCache::find(const Hash128& key) const {
  std::optional<EntryFacts> facts = read_entry_facts(file_of(key));
  if (!facts) return std::nullopt;
  const bool is_current = std::ranges::all_of(
      facts->importer, [](const FileStamp& was) { return stamp_of(was.path) == was; });
  return is_current ? std::move(facts) : std::nullopt;
}

void SceneCache::touch(const Hash128& key) const {
  ::utimensat(AT_FDCWD, file_of(key).c_str(), nullptr, 0);
}

void SceneCache::remove(const Hash128& key) const { ::unlink(file_of(key).c_str()); }

std::optional<std::string> SceneCache::keep(const Hash128& key, const fs::path& scene,
                                            std::span<const std::byte> bytes,
                                            const EntryFacts& facts) const {
  const std::string trailer = entry_trailer(bytes, facts);
  const std::uint64_t size = bytes.size() + trailer.size();
  if (size > max_bytes_) return "the scene is larger than all of them may be";
  if (const int fault = append_to(scene, trailer); fault != 0) return words_of(fault);
  make_room(size);
  if (::rename(scene.c_str(), file_of(key).c_str()) != 0) return words_of(errno);
  return std::nullopt;
}

void SceneCache::make_room(std::uint64_t bytes) const {
  std::vector<Found> files = files_in(folder_);
  remove_forgotten(files);
  std::ranges::sort(files, [](const Found& x, const Found& y) {
    return std::pair(x.used_ns, x.path) < std::pair(y.used_ns, y.path);
  });
  std::uint64_t all = bytes;
  for (const Found& file : files) all += file.bytes;
  for (const Found& file : files) {
    if (all <= max_bytes_) return;
    if (file.work || ::unlink(file.path.c_str()) != 0) continue;
    all -= file.bytes;
  }
}

std::vector<KeptScene> list_scenes(const fs::path& folder) {
  std::vector<Found> files = files_in(folder);
  std::erase_if(files, [](const Found& file) { return file.work; });
  std::ranges::sort(files, [](const Found& x, const Found& y) {
    return std::pair(-x.used_ns, x.path) < std::pair(-y.used_ns, y.path);
  });
  const auto today = now();
  std::vector<KeptScene> scenes;
  for (const Found& file : files)
    scenes.push_back({file.path, read_entry_facts(file.path).value_or(EntryFacts()), file.bytes,
                      unused_for(file, today)});
  return scenes;
}

Result<Cleared> clear_scenes(const fs::path& folder, seconds unused) {
  const std::vector<Found> files = files_in(folder);
  remove_forgotten(files);
  const auto today = now();
  Cleared cleared;
  for (const Found& file : files) {
    if (file.work || unused_for(file, today) < unused) continue;
    if (::unlink(file.path.c_str()) != 0 && errno != ENOENT)
      return Error{ErrorCode::output, "cannot be removed: " + words_of(errno), file.path.string(),
                   "check the permissions of the folder"};
    ++cleared.scenes;
    cleared.bytes += file.bytes;
  }
  return cleared;
}

}  // namespace strake::io
