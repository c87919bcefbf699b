// SPDX-License-Identifier: Apache-2.0
#include "serve/site/project_answer.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "project/results/clash_queries.hpp"
#include "project/results/positional_rows.hpp"
#include "report/json/json_writer.hpp"
#include "strake/report/decisions.hpp"

namespace strake::serve {
namespace {

void append_text(std::string& out, std::string_view name, std::string_view text) {
  report::append_key(out, name);
  append_json_string(out, text);
}

void append_clash(std::string& out, const project::ListedClash& clash) {
  const report::Decision decision = project::decision_of(clash.row, clash.test);
  out += '{';
  append_text(out, "key", clash.row.key);
  out += ", ";
  append_text(out, "status", report::name(clash.status));
  out += ", ";
  append_text(out, "by", decision.by);
  out += ", ";
  append_text(out, "on", decision.date);
  out += ", ";
  append_text(out, "assignee", clash.row.assignee);
  out += ", ";
  append_text(out, "comment", clash.row.comment);
  out += '}';
}

/// Which clashes are reported, by the ids of their rows.
struct ReportedChanges {
  std::vector<std::int64_t> clashes;
  bool too_many = false;  ///< more changed than is reported
};

/// What the page itself has just decided is reported however much it is.
Result<ReportedChanges> changes_for_page(project::Database& database, std::int64_t event,
                                         const project::DecideOutcome* done) {
  std::vector<std::int64_t> own;
  if (done != nullptr) own = done->decided;
  std::ranges::sort(own);
  own.erase(std::ranges::unique(own).begin(), own.end());
  const Result<std::vector<std::int64_t>> changed =
      project::changed_since(database, event, kMaxChanges + 1 + own.size());
  if (!changed) return changed.error();
  std::vector<std::int64_t> others;
  std::ranges::set_difference(*changed, own, std::back_inserter(others));
  if (others.size() > kMaxChanges) return ReportedChanges{std::move(own), true};
  std::vector<std::int64_t> all;
  std::ranges::merge(own, others, std::back_inserter(all));
  return ReportedChanges{std::move(all), false};
}

HttpStatus status_of(ErrorCode code) {
  if (code == ErrorCode::usage) return HttpStatus::bad_request;
  // A project that is locked, or on a full disk: another try may do better.
  if (code == ErrorCode::output || code == ErrorCode::cancelled) return HttpStatus::unavailable;
  return HttpStatus::fault;
}

}  // namespace

Result<std::string> project_answer(project::Database& database, std::int64_t event,
                                   const project::DecideOutcome* done) {
  const Result<project::KnownState> now = project::current_state(database);
  if (!now) return now.error();
  const Result<ReportedChanges> reported = changes_for_page(database, event, done);
  if (!reported) return reported.error();
  const Result<std::vector<project::ListedClash>> clashes =
      project::read_clashes(database, reported->clashes);
  if (!clashes) return clashes.error();
  std::string out = "{\"run\": " + std::to_string(now->run) +
                    ", \"event\": " + std::to_string(now->event) +
                    ", \"too_many\": " + (reported->too_many ? "true" : "false") + ", ";
  report::append_list(out, "clashes", *clashes,
                      [&](const project::ListedClash& clash) { append_clash(out, clash); });
  if (done != nullptr) {
    out += ", \"changed\": " + std::to_string(done->changed) + ", ";
    report::append_list(out, "refused", done->refused,
                        [&](const project::RefusedDecision& refused) {
                          out += '{';
                          append_text(out, "key", refused.key);
                          out += ", ";
                          append_text(out, "why", refused.why);
                          out += '}';
                        });
  }
  out += "}\n";
  return out;
}

Answer error_answer(const Error& error) {
  std::string out = "{";
  append_text(out, "error",
              error.where.empty() ? error.message : error.where + ": " + error.message);
  out += ", ";
  append_text(out, "mend", error.mend);
  out += "}\n";
  return {status_of(error.code), "application/json",
          std::make_shared<const std::string>(std::move(out))};
}

}  // namespace strake::serve
