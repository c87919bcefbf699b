// SPDX-License-Identifier: Apache-2.0
#include "io/importer/import_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "io/importer/child_process.hpp"

namespace strake::io {
namespace {

namespace fs = std::filesystem;

/// What no importer has a reason to exceed: a GLB counts its bytes in 32 bits, and a report has a
/// line for an object at most.
constexpr std::uintmax_t kMaxScene = std::uintmax_t{1} << 32U, kMaxReport = 512U << 20U;
constexpr std::uintmax_t kMaxLog = 16U << 20U;

/// Returns a path that says the same in another folder.
fs::path anywhere(const fs::path& path) {
  std::error_code failed;
  const fs::path absolute = fs::absolute(path, failed);
  return failed ? path : absolute;
}

std::uintmax_t size_of(const fs::path& file) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(file, failed);
  return failed ? 0 : size;
}

/// A file that another program is writing, read as it grows.
class GrowingFile {
 public:
  explicit GrowingFile(fs::path file) : file_(std::move(file)) {}
  ~GrowingFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;
  GrowingFile(GrowingFile&&) = delete;
  GrowingFile& operator=(GrowingFile&&) = delete;

  /// Calls take(text) with what is new, a bounded piece at a time; returns whether there was any.
  template <class Take>
  bool read_more(Take&& take) {
    if (descriptor_ < 0)
      descriptor_ = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    if (descriptor_ < 0) return false;
    const std::uintmax_t before = bytes_;
    std::array<char, std::size_t{1} << 16U> piece{};
    // What is there is read even while more comes, up to a limit that the caller looks at.
    while (bytes_ - before < kMaxAtOnce) {
      const ssize_t got = ::read(descriptor_, piece.data(), piece.size());
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) break;
      bytes_ += static_cast<std::uintmax_t>(got);
      take(std::string_view(piece.data(), static_cast<std::size_t>(got)));
    }
    return bytes_ != before;
  }
  [[nodiscard]] std::uintmax_t bytes() const { return bytes_; }

 private:
  static constexpr std::uintmax_t kMaxAtOnce = 4U << 20U;

  fs::path file_;
  int descriptor_ = -1;
  std::uintmax_t bytes_ = 0;
};

/// Watches one importer.
class ImportRun {
 public:
  ImportRun(const ImportTask& task, const ImportRunOptions& options)
      : task_(task),
        options_(options),
        name_(task.program.file.filename().string()),
        folder_(anywhere(task.folder)),
        scene_(scene_file(folder_)),
        report_file_(folder_ / "report.jsonl") {}

  Result<SceneFacts> run() {
    ChildProgram child;
    child.words = {anywhere(task_.program.file).string(),
                   "--input",
                   anywhere(task_.file).string(),
                   "--output",
                   scene_.string(),
                   "--report",
                   report_file_.string(),
                   "--threads",
                   std::to_string(options_.threads)};
    if (task_.sag_mm) child.words.insert(child.words.end(), {"--sag", shortest(*task_.sag_mm)});
    child.log = folder_ / "log";
    // What a stranger put beside the model is not found by a program that looks around it.
    child.folder = folder_;
    child.max_log_bytes = kMaxLog;
    child.may_go_on = [this] { return may_go_on(); };
    last_progress_ = std::chrono::steady_clock::now();
    const ChildEnd end = options_.host != nullptr && ImportHost::takes(child)
                             ? options_.host->run(child, options_.stop)
                             : run_child(child, options_.stop);
    is_lost_ = end.how == ChildEnd::How::lost;
    while (!is_report_too_long() && read_report()) {
    }
    report_.end();
    return outcome(end);
  }
  /// Whether nothing came of it since a host has ended, and not for anything in the file.
  [[nodiscard]] bool is_lost() const { return is_lost_; }

 private:
  [[nodiscard]] bool is_report_too_long() const { return file_.bytes() > kMaxReport; }

  bool read_report() {
    const bool more = file_.read_more([&](std::string_view text) { report_.feed(text); });
    if (more) options_.progress(report_.progress());
    return more;
  }

  /// A report or a scene that grows is progress; what it prints is none.
  bool may_go_on() {
    if (options_.given_up.stop_requested()) return false;
    const auto now = std::chrono::steady_clock::now();
    const std::uintmax_t scene_bytes = size_of(scene_);
    if (read_report() || scene_bytes != scene_bytes_) last_progress_ = now;
    scene_bytes_ = scene_bytes;
    is_too_long_ = scene_bytes > kMaxScene || is_report_too_long();
    return !is_too_long_ && now - last_progress_ < std::chrono::duration<double>(task_.silence_s);
  }

  Result<SceneFacts> outcome(const ChildEnd& end);
  [[nodiscard]] Error ended(std::string how, const ChildEnd& end, std::string mend) const;
  [[nodiscard]] Error failed_by_itself(const ChildEnd& end) const;

  const ImportTask& task_;
  const ImportRunOptions& options_;
  std::string name_;
  fs::path folder_, scene_, report_file_;
  GrowingFile file_{report_file_};
  ImportReport report_;
  std::chrono::steady_clock::time_point last_progress_;
  std::uintmax_t scene_bytes_ = 0;
  bool is_too_long_ = false, is_lost_ = false;
};

/// Returns the error of an importer, with what it printed last.
Error ImportRun::ended(std::string how, const ChildEnd& end, std::string mend) const {
  constexpr std::size_t kTail = 400;
  std::string output;
  for (const char c : tail_of(end.output, kTail)) output += c == '\n' || c == '\t' ? ' ' : c;
  std::string message = name_ + ' ' + std::move(how);
  if (!output.empty()) message += "; it printed last: " + printable(output);
  return {ErrorCode::input, std::move(message), task_.file.string(), std::move(mend)};
}

Error ImportRun::failed_by_itself(const ChildEnd& end) const {
  if (const auto& fault = report_.fault())
    return {ErrorCode::input, fault->message.empty() ? name_ + " failed" : fault->message,
            task_.file.string(), fault->mend};
  // Neither its report nor its log can say so.
  constexpr std::uintmax_t kNoRoom = 4096;
  std::error_code failed;
  if (fs::space(folder_, failed).available < kNoRoom && !failed)
    return ended(
        fmt::format("ended with exit status {} on a disk without room", end.code), end,
        "make room for " + folder_.parent_path().string() + ", or let TMPDIR name another folder");
  return ended(fmt::format("ended with exit status {} and gave no reason", end.code), end,
               "check that the file is whole, or convert it to glTF by another program");
}

Result<SceneFacts> ImportRun::outcome(const ChildEnd& end) {
  if (end.how == ChildEnd::How::stopped ||
      ((end.how == ChildEnd::How::refused || end.how == ChildEnd::How::lost) &&
       options_.given_up.stop_requested()))
    return Error{ErrorCode::cancelled, "reading was cancelled", task_.file.string(), ""};
  switch (end.how) {
    case ChildEnd::How::not_started:
      return Error{ErrorCode::input,
                   "the importer " + task_.program.file.string() + " cannot be started",
                   task_.file.string(), "check that it is a program for this machine"};
    case ChildEnd::How::refused:
    case ChildEnd::How::over_limit:
      if (is_too_long_)
        return ended("was ended because it wrote without end", end,
                     "try a newer version of the importer");
      return ended(fmt::format("was ended after {} s without progress", shortest(task_.silence_s)),
                   end, "give it more time by STRAKE_IMPORT_LIMIT, in seconds");
    case ChildEnd::How::killed:
      return ended("crashed on the file: it was ended by " + signal_text(end.code), end,
                   "try a newer version of the importer, or convert the file to glTF by another "
                   "program");
    case ChildEnd::How::lost:
      return ended("is gone, and what it made with it", end, "try again");
    case ChildEnd::How::stopped:
    case ChildEnd::How::exited:
      break;
  }
  if (end.code != 0 || report_.fault()) return failed_by_itself(end);
  if (!report_.is_complete())
    return ended("ended well but its report has no end", end, "tell the importer's author of it");
  std::error_code failed;
  if (fs::symlink_status(scene_, failed).type() != fs::file_type::regular)
    return ended("ended well but made no scene", end, "tell the importer's author of it");
  return report_.take_facts();
}

}  // namespace

fs::path scene_file(const fs::path& folder) { return folder / "scene.glb"; }

Result<SceneFacts> run_importer(const ImportTask& task, const ImportRunOptions& options) {
  ImportRun run(task, options);
  Result<SceneFacts> facts = run.run();
  if (!run.is_lost() || options.stop.stop_requested() || options.given_up.stop_requested())
    return facts;
  std::error_code failed;
  for (fs::directory_iterator at(task.folder, failed), end; !failed && at != end;
       at.increment(failed))
    fs::remove_all(at->path(), failed);
  ImportRunOptions alone = options;
  alone.host = nullptr;
  return ImportRun(task, alone).run();
}

}  // namespace strake::io
