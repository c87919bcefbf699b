// SPDX-License-Identifier: Apache-2.0
#include "serve/site/decision_request.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "core/text_encoding.hpp"
#include "report/json/json_reader.hpp"
#include "strake/report/decisions.hpp"

namespace strake::serve {
namespace {

using report::DecisionStatus;

constexpr int kMaxDepth = 3;
/// Of a comment or a name. It is stored with each clash, of which a request names thousands.
constexpr std::size_t kMaxTextBytes = std::size_t{64} << 10U;
/// Numbers of a row that a double holds exactly.
constexpr double kGreatestNumber = 9007199254740992.0;

Error no_request(std::string what) { return {ErrorCode::usage, std::move(what), {}, {}}; }

std::optional<DecisionStatus> status_named(std::string_view word) {
  const auto at = std::ranges::find_if(report::kDecisionStatuses,
                                       [&](DecisionStatus s) { return report::name(s) == word; });
  return at == report::kDecisionStatuses.end() ? std::nullopt : std::optional(*at);
}

/// Takes the members of a request; the first fault is kept.
class RequestReader {
 public:
  explicit RequestReader(report::JsonReader& json) : json_(json) {}

  void take(std::string_view name) {
    if (!members_.insert(std::string(name)).second) return reject("the request has a member twice");
    if (name == "run") return number(request_.known.run, "run");
    if (name == "event") return number(request_.known.event, "event");
    if (name == "keys") return keys();
    if (name == "status") return status();
    if (name == "assignee") return take_text(request_.decision.assignee, "assignee");
    if (name == "comment") return take_text(request_.decision.comment, "comment");
    reject("the request has a member that has no meaning");
  }

  Result<DecisionRequest> finish() {
    for (const char* const needed : {"run", "event", "keys"})
      if (!members_.contains(needed)) fail(std::string("the request has no ") + needed);
    if (request_.keys.empty()) fail("no clash is named");
    const project::ClashDecision& decision = request_.decision;
    if (!decision.status && !decision.assignee && !decision.comment)
      fail("there is nothing to set");
    if (fault_) return no_request(*fault_);
    return std::move(request_);
  }

 private:
  using Kind = report::JsonReader::Kind;

  void fail(std::string what) {
    if (!fault_) fault_ = std::move(what);
  }
  void reject(std::string what) {
    fail(std::move(what));
    json_.skip();
  }

  void number(std::int64_t& value, const char* name) {
    if (json_.kind() != Kind::number) return reject(std::string(name) + " is no number");
    const double given = json_.number();
    if (!(given >= 0 && given <= kGreatestNumber) || given != std::floor(given))
      return fail(std::string(name) + " is no number of a row");
    value = static_cast<std::int64_t>(given);
  }

  void text(std::optional<std::string>& value, const char* name) {
    if (json_.kind() != Kind::string) return reject(std::string(name) + " is no text");
    value = json_.text();
  }

  void take_text(std::optional<std::string>& value, const char* name) {
    text(value, name);
    if (value && value->size() > kMaxTextBytes)
      fail("the " + std::string(name) + " is longer than 64 KiB");
  }

  void status() {
    std::optional<std::string> word;
    text(word, "status");
    if (!word) return;
    request_.decision.status = status_named(*word);
    if (!request_.decision.status) fail("no status is called " + in_quotes(*word));
  }

  void keys() {
    if (json_.kind() != Kind::array) return reject("keys is no list");
    json_.items([&] {
      std::optional<std::string> key;
      text(key, "a key");
      if (key) request_.keys.push_back(std::move(*key));
    });
  }

  report::JsonReader& json_;
  DecisionRequest request_;
  std::set<std::string> members_;
  std::optional<std::string> fault_;
};

}  // namespace

Result<DecisionRequest> read_decision_request(std::string_view text) {
  std::istringstream in{std::string(text)};
  report::JsonReader json(in, kMaxDepth);
  RequestReader reader(json);
  try {
    if (json.kind() != report::JsonReader::Kind::object)
      return no_request("the request is no object");
    json.members([&](std::string_view name) { reader.take(name); });
    json.end();
  } catch (const report::JsonReader::Fault&) {
    return no_request("the request is no JSON");
  }
  return reader.finish();
}

}  // namespace strake::serve
