// SPDX-License-Identifier: Apache-2.0
#include "serve/site/project_answer.hpp"

#include <algorithm>
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

HttpStatus status_of(ErrorCode code) {
  if (code == ErrorCode::usage) return HttpStatus::bad_request;
  // A project that is locked, or on a full disk: another try may do better.
  if (code == ErrorCode::output || code == ErrorCode::cancelled) return HttpStatus::unavailable;
  return HttpStatus::fault;
}

}  // namespace

Result<std::string> project_answer(project::Database& database, std::int64_t event,
                                   const project::DecisionsAsSeen* done) {
  const Result<project::SeenState> now = project::state_now(database);
  if (!now) return now.error();
  Result<std::vector<std::int64_t>> ids = project::changed_since(database, event, kMostChanges + 1);
  if (!ids) return ids.error();
  const bool too_many = ids->size() > kMostChanges;
  if (too_many) ids->clear();
  if (done != nullptr) ids->insert(ids->end(), done->decided.begin(), done->decided.end());
  std::ranges::sort(*ids);
  ids->erase(std::ranges::unique(*ids).begin(), ids->end());
  const Result<std::vector<project::ListedClash>> clashes = project::read_clashes(database, *ids);
  if (!clashes) return clashes.error();
  std::string out = "{\"run\": " + std::to_string(now->run) +
                    ", \"event\": " + std::to_string(now->event) +
                    ", \"too_many\": " + (too_many ? "true" : "false") + ", ";
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
