// SPDX-License-Identifier: Apache-2.0
#include "cli/run/session.hpp"

#include "strake/core/atomic_file.hpp"

namespace strake::cli {

Session::Session(const CommonOptions& options, unsigned workers, Console& console,
                 Interrupts& interrupts)
    : options_(options), console_(console), interrupts_(interrupts) {
  console_.set_quiet(options.quiet);
  if (workers > 1) team_ = std::make_unique<parallel::Team>(workers);
  if (options.quiet) return;
  line_.emplace(console_, progress_, [this] {
    const std::lock_guard lock(step_mutex_);
    return step_;
  });
}

Stats::Timer Session::step(std::string_view name) {
  {
    const std::lock_guard lock(step_mutex_);
    step_ = name;
  }
  return stats_.time(name);
}

parallel::Context Session::context() {
  return {.team = team_.get(),
          .stop = interrupts_.token(),
          .progress = options_.quiet ? nullptr : &progress_,
          .report = options_.stats || measures_ ? &report_ : nullptr,
          .distribution = distribution_of(options_)};
}

const parallel::RunReport& Session::measured() {
  measures_ = true;
  return report_;
}

Status Session::will_write(const std::filesystem::path& target) {
  if (Status status = files_.check(target); !status) return status;
  interrupts_.guard(target);
  return {};
}

Status Session::write(const std::filesystem::path& target, Producer producer) {
  // Between computing and writing a run may have been cancelled: then there is no output at all.
  if (interrupts_.token().stop_requested()) return Error{ErrorCode::cancelled, "cancelled", {}, {}};
  const auto timer = step("write " + target.filename().string());
  if (Status status = will_write(target); !status) return status;
  Result<AtomicFile> file = AtomicFile::create(target);
  if (!file) return file.error();
  if (Status status = producer([&](std::string_view text) { file->write(text); }); !status)
    return status;
  if (Status status = file->commit(); !status) return status;
  console_.note("wrote " + target.string());
  return {};
}

Status Session::write_stdout(Producer producer) {
  Status written;
  const Status produced = producer([&](std::string_view text) {
    if (written) written = cli::write_stdout(text);
  });
  return produced ? written : produced;
}

Status Session::write_stdout(std::string_view text) {
  return write_stdout([&](Sink sink) {
    sink(text);
    return Status{};
  });
}

void Session::finish() {
  line_.reset();
  if (!options_.stats) return;
  console_.print(options_.json ? stats_.json(report_) : stats_.text(report_));
}

}  // namespace strake::cli
