// SPDX-License-Identifier: Apache-2.0
#include "io/importer/host/import_host.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "io/gltf/json/json.hpp"

namespace strake::io {
namespace {

namespace fs = std::filesystem;

/// How long a host may take for what needs no time.
constexpr double kPatienceS = 5;

/// Returns what a host is told of a file: its words but for the program, and where it writes.
std::string job_text(const ChildProgram& program) {
  std::string text = R"({"arguments":[)";
  for (std::size_t i = 1; i < program.words.size(); ++i) {
    if (i > 1) text += ',';
    append_json_string(text, program.words[i]);
  }
  text += R"(],"log":)";
  append_json_string(text, program.log.string());
  return text + "}\n";
}

/// Returns what a host answered of a file; nothing where it is no answer.
std::optional<ChildEnd> answer_in(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  const Result<gltf::JsonDocument> document = gltf::JsonDocument::parse(text);
  if (!document || !document->root().is_object()) return std::nullopt;
  const auto [status, signal] = document->root().pick<2>({"status", "signal"});
  const auto is_byte = [](double number) { return number >= 0 && number <= 255; };
  if (const auto code = status.number(); code && is_byte(*code))
    return ChildEnd{ChildEnd::How::exited, static_cast<int>(*code), {}};
  if (const auto number = signal.number(); number && is_byte(*number))
    return ChildEnd{ChildEnd::How::killed, static_cast<int>(*number), {}};
  return std::nullopt;
}

}  // namespace

/// A file that a host has a process for. The host answers in the file's folder, so that threads
/// have nothing in common.
class HostedFile final : public RunningChild {
 public:
  HostedFile(const ImportHost& host, fs::path folder, std::stop_token stop)
      : host_(host),
        folder_(std::move(folder)),
        answer_(folder_ / "ended"),
        stop_(std::move(stop)) {}
  ~HostedFile() override {
    if (!has_ended()) stop_it();
  }
  HostedFile(const HostedFile&) = delete;
  HostedFile& operator=(const HostedFile&) = delete;
  HostedFile(HostedFile&&) = delete;
  HostedFile& operator=(HostedFile&&) = delete;

  [[nodiscard]] bool has_ended() const override {
    std::error_code failed;
    return fs::exists(answer_, failed) || host_.has_ended();
  }
  void kill() const override {
    // When the run is cancelled all files end, and with the host at once. One that cannot be told
    // of an end has ended, and all with it.
    if (stop_.stop_requested() || !host_.order("end", folder_)) host_.kill();
  }
  /// Whether the host did not end the file's process as it was told to.
  [[nodiscard]] bool has_killed_host() const { return has_killed_host_; }
  ChildEnd end() override {
    stop_it();
    if (auto end = answer_in(answer_)) return *std::move(end);
    return {ChildEnd::How::lost, 0, {}};
  }

 private:
  /// Has what is left of it killed. A host that does not do so is killed itself.
  void stop_it() {
    if (has_ended()) return;
    kill();
    has_killed_host_ = !wait_for_end(*this, kPatienceS);
    if (has_killed_host_) host_.kill();
  }

  const ImportHost& host_;
  fs::path folder_, answer_;
  std::stop_token stop_;
  bool has_killed_host_ = false;
};

std::unique_ptr<ImportHost> ImportHost::start(const fs::path& program) {
  std::error_code failed;
  const fs::path temporary = fs::temp_directory_path(failed);
  std::unique_ptr<WorkFolder> folder = failed ? nullptr : WorkFolder::make(temporary);
  if (!folder) return nullptr;
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return nullptr;
  ChildProgram child;
  child.words = {fs::absolute(program, failed).string()};
  child.log = folder->path() / "log";
  child.folder = folder->path();
  child.input = ends[1];
  std::unique_ptr<RunningChild> process = start_child(child);
  ::close(ends[1]);
  if (process)
    return std::unique_ptr<ImportHost>(
        new ImportHost(std::move(folder), std::move(process), ends[0]));
  ::close(ends[0]);
  return nullptr;
}

ImportHost::~ImportHost() {
  // All files have ended: it holds nothing worth waiting for, and is killed with its process.
  ::close(orders_);
}

bool ImportHost::order(std::string_view word, const fs::path& folder) const {
  const std::string line = std::string(word) + ' ' + folder.string() + '\n';
  // So short a text is sent as a whole, whichever other threads send something. Who does not read
  // hundreds of them is as good as gone.
  return ::send(orders_, line.data(), line.size(), MSG_NOSIGNAL | MSG_DONTWAIT) ==
         static_cast<ssize_t>(line.size());
}

bool ImportHost::takes(const ChildProgram& program) {
  return program.folder.string().find('\n') == std::string::npos &&
         std::ranges::all_of(program.words,
                             [](const std::string& word) { return is_utf8(word); }) &&
         is_utf8(program.log.string());
}

ChildEnd ImportHost::run(const ChildProgram& program, const std::stop_token& stop) const {
  {
    std::ofstream out(program.folder / "job.json", std::ios::binary);
    out << job_text(program);
    if (!out.flush()) return {ChildEnd::How::lost, 0, {}};
  }
  if (!order("run", program.folder)) return {ChildEnd::How::lost, 0, {}};
  HostedFile file(*this, program.folder, stop);
  ChildEnd end = watch_child(file, program, stop);
  // A host that does not obey may be why there was no progress: that is nothing in the file.
  if (file.has_killed_host() &&
      (end.how == ChildEnd::How::refused || end.how == ChildEnd::How::over_limit))
    end.how = ChildEnd::How::lost;
  return end;
}

}  // namespace strake::io
