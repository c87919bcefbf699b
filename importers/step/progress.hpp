// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Message_ProgressIndicator.hxx>
#include <optional>

#include "report.hpp"

namespace strake::import_step {

/// Writes the progress of Open CASCADE to the report, and has it give up what takes too long.
class ReportProgress : public Message_ProgressIndicator {
 public:
  explicit ReportProgress(Report& report) : report_(report) {}

  /// The next work is from this to that part of all; it may take so many seconds of processor time.
  void next(double from, double to, std::optional<double> limit_s = {});
  /// Whether the work that next() began was given up.
  [[nodiscard]] bool is_over_limit() const;
  /// Whether most of the time is left that next() gave, so that work may be done again.
  [[nodiscard]] bool is_early() const;

 protected:
  Standard_Boolean UserBreak() override { return is_over_limit(); }
  void Show(const Message_ProgressScope& scope, Standard_Boolean is_force) override;

 private:
  Report& report_;
  double from_ = 0, to_ = 1;
  std::optional<double> until_;  ///< processor time of this process, in seconds
  double early_until_ = 0;
};

}  // namespace strake::import_step
