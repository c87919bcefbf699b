// SPDX-License-Identifier: Apache-2.0
#include "progress.hpp"

#include <ctime>

namespace strake::import_step {
namespace {

/// Returns the processor time of all threads of this process, which other programs do not lengthen.
double processor_seconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

}  // namespace

void ReportProgress::next(double from, double to, std::optional<double> limit_s) {
  from_ = from;
  to_ = to;
  until_.reset();
  if (limit_s) {
    constexpr double kEarly = 0.1;
    const double now = processor_seconds();
    until_ = now + *limit_s;
    early_until_ = now + kEarly * *limit_s;
  }
  report_.progress(from);
}

bool ReportProgress::is_over_limit() const { return until_ && processor_seconds() > *until_; }

bool ReportProgress::is_early() const { return !until_ || processor_seconds() < early_until_; }

void ReportProgress::Show(const Message_ProgressScope& /*scope*/, Standard_Boolean /*is_force*/) {
  report_.progress(from_ + (to_ - from_) * GetPosition());
}

}  // namespace strake::import_step
