// SPDX-License-Identifier: Apache-2.0
#include "serve/site/site.hpp"

#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include "core/text_encoding.hpp"
#include "project/results/clash_queries.hpp"
#include "serve/site/decision_request.hpp"
#include "serve/site/project_answer.hpp"

namespace strake::serve {
namespace {

constexpr std::string_view kStatePath = "/api/state", kDecidePath = "/api/decide";
constexpr std::string_view kJson = "application/json";

/// Returns the one method of a path; nothing where there is no such path.
std::optional<std::string_view> method_of(std::string_view path) {
  if (path == kPagePath || path == kStatePath) return "GET";
  if (path == kDecidePath) return "POST";
  return std::nullopt;
}

/// Adds what every answer says: that it is nobody else's, and not to be kept.
Answer guarded(Answer answer) {
  for (const auto& [name, value] :
       {std::pair("Cache-Control", "no-store"), std::pair("X-Content-Type-Options", "nosniff"),
        std::pair("X-Frame-Options", "DENY"), std::pair("Referrer-Policy", "no-referrer"),
        std::pair("Cross-Origin-Resource-Policy", "same-origin"),
        std::pair("Cross-Origin-Opener-Policy", "same-origin")})
    answer.headers.emplace_back(name, value);
  // The page has a policy of its own.
  if (answer.type != "text/html; charset=utf-8")
    answer.headers.emplace_back("Content-Security-Policy",
                                "default-src 'none'; frame-ancestors 'none'");
  return answer;
}

bool is_json(std::string_view type) {
  const std::size_t end = type.find(';');
  return lowered(trimmed(type.substr(0, end))) == kJson;
}

/// An error as people read it, where no page can be shown.
Answer plain_error_answer(const Error& error) {
  return text_answer(error_answer(error).status, error.text());
}

Answer json_answer(HttpStatus status, std::string text) {
  return {status, std::string(kJson), std::make_shared<const std::string>(std::move(text))};
}

std::optional<std::int64_t> row_number(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

}  // namespace

Site::Site(Gate gate, SiteContents contents)
    : gate_(std::move(gate)), contents_(std::move(contents)) {}

std::optional<Answer> Site::refuse(const Request& request) {
  if (auto refusal = gate_.refuse(request)) return guarded(std::move(*refusal));
  const auto method = method_of(request.path);
  if (!method) return guarded(text_answer(HttpStatus::not_found, "there is nothing of this name"));
  if (request.method != *method) {
    Answer refusal = text_answer(HttpStatus::method_not_allowed, "this is asked in another way");
    refusal.headers.emplace_back("Allow", *method);
    return guarded(std::move(refusal));
  }
  if (*method == "POST" && !is_json(request.header("Content-Type").value_or(std::string_view())))
    return guarded(text_answer(HttpStatus::wrong_type, "this is asked in JSON"));
  return std::nullopt;
}

Answer Site::answer(const Request& request) {
  // Who has waited longer than anybody does is told so.
  return answer_or_wait(request, std::chrono::milliseconds::max()).value_or(Answer());
}

std::optional<Answer> Site::answer_or_wait(const Request& request,
                                           std::chrono::milliseconds waited) {
  const bool is_page = request.path == kPagePath;
  if (const Status there = contents_.database.check_in_place(); !there)
    return guarded(is_page ? plain_error_answer(there.error()) : error_answer(there.error()));
  if (is_page) return guarded(page());
  if (request.path == kStatePath) return guarded(state(request));
  Result<DecisionRequest> decision_request = read_decision_request(request.body);
  if (!decision_request) return guarded(error_answer(decision_request.error()));
  auto begun = project::Transaction::begin_at_once(contents_.database);
  if (!begun) return guarded(error_answer(begun.error()));
  if (*begun) return guarded(decide(std::move(*decision_request), std::move(**begun)));
  if (waited < contents_.database.wait()) return std::nullopt;
  return guarded(error_answer(contents_.database.busy()));
}

Status Site::prepare() {
  if (page_.html) {
    const Result<project::KnownState> now = project::current_state(contents_.database);
    if (!now) return now.error();
    // The page requests what people decided since.
    const auto largest = static_cast<std::int64_t>(kMaxChanges);
    if (now->run == page_.known.run && now->event - page_.known.event < largest) return {};
  }
  Result<ServedPage> made = contents_.make_page();
  if (!made) return made.error();
  page_ = std::move(*made);
  return {};
}

Answer Site::page() {
  if (const Status status = prepare(); !status) return plain_error_answer(status.error());
  return {HttpStatus::ok,
          "text/html; charset=utf-8",
          page_.html,
          {{"Content-Security-Policy", page_.policy}, {"Set-Cookie", gate_.set_cookie()}}};
}

Answer Site::state(const Request& request) {
  const auto event = row_number(request.argument("event").value_or(std::string_view()));
  if (!event) return error_answer({ErrorCode::usage, "event is no number of a row", {}, {}});
  const Result<project::ReadScope> scope = project::ReadScope::begin(contents_.database);
  if (!scope) return error_answer(scope.error());
  Result<std::string> answer = project_answer(contents_.database, *event, nullptr);
  if (!answer) return error_answer(answer.error());
  return json_answer(HttpStatus::ok, std::move(*answer));
}

Answer Site::decide(DecisionRequest request, project::Transaction transaction) {
  request.decision.by = contents_.by;
  request.decision.at = contents_.utc_now();
  const Result<project::DecideOutcome> done = project::decide_if_unchanged(
      contents_.database, request.keys, request.decision, request.known);
  if (!done) return error_answer(done.error());
  Result<std::string> answer = project_answer(contents_.database, request.known.event, &*done);
  if (!answer) return error_answer(answer.error());
  if (const Status status = transaction.commit(); !status) return error_answer(status.error());
  return json_answer(done->refused.empty() ? HttpStatus::ok : HttpStatus::conflict,
                     std::move(*answer));
}

}  // namespace strake::serve
