// SPDX-License-Identifier: Apache-2.0
#include "cli/session.hpp"

#include "strake/core/atomic_file.hpp"

namespace strake::cli {

Session::Session(const CommonOptions& options, unsigned workers, Console& console,
                 Interrupts& interrupts)
    : options_(options), console_(console), interrupts_(interrupts) {
  console_.set_quiet(options.quiet);
  if (workers > 1) team_ = std::make_unique<parallel::Team>(workers);
  if (!options.quiet) line_.emplace(console_, progress_);
}

parallel::Context Session::context() {
  return {.team = team_.get(),
          .stop = interrupts_.token(),
          .progress = options_.quiet ? nullptr : &progress_,
          .report = options_.stats ? &report_ : nullptr};
}

Status Session::write(const std::filesystem::path& target, std::string_view text) {
  // Between computing and writing a run may have been cancelled: then there is no output at all.
  if (interrupts_.token().stop_requested()) return Error{ErrorCode::cancelled, "cancelled", {}, {}};
  const auto timer = stats_.time("write " + target.filename().string());
  if (Status status = write_file(target, text); !status) return status;
  console_.say("wrote " + target.string());
  return {};
}

Status Session::write_stdout(std::string_view text) {
  if (cli::write_stdout(text)) return {};
  return Error{ErrorCode::output, "cannot be written", "standard output", {}};
}

void Session::finish() {
  line_.reset();
  if (!options_.stats) return;
  const auto regions = report_.regions();
  console_.print(options_.json ? stats_.json(regions) : stats_.text(regions));
}

}  // namespace strake::cli
