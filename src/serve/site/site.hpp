// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "project/database/database.hpp"
#include "project/review/decide_if_unchanged.hpp"
#include "serve/gate/gate.hpp"
#include "serve/http/message.hpp"
#include "serve/site/decision_request.hpp"
#include "strake/core/result.hpp"

namespace strake::serve {

/// The page of a project as it is served, and what of the project it shows.
struct ServedPage {
  std::shared_ptr<const std::string> html;
  std::string policy;  ///< Content-Security-Policy
  project::KnownState known;
};

/// What a site is made of.
struct SiteContents {
  project::Database& database;  ///< open for writing
  std::function<Result<ServedPage>()> make_page;
  std::string by;                        ///< who decides
  std::function<std::string()> utc_now;  ///< "2026-01-31T23:59:59Z"
};

/// The page of a project, and what it asks:
///
/// GET / is the page, made anew once the project has another run; GET /api/state?event=N tells what
/// changed after an event; POST /api/decide decides, as 'strake clash set' does. Nothing else is
/// there.
class Site final : public RequestHandler {
 public:
  Site(Gate gate, SiteContents contents);

  /// Makes the page, unless there is one that holds. Errors: those of `make_page`.
  [[nodiscard]] Status prepare();
  [[nodiscard]] std::optional<Answer> refuse(const Request& request) override;
  [[nodiscard]] Answer answer(const Request& request) override;
  /// A decision waits while another program writes to the project, as long as the connection does.
  [[nodiscard]] std::optional<Answer> answer_or_wait(const Request& request,
                                                     std::chrono::milliseconds waited) override;

 private:
  [[nodiscard]] Answer page();
  [[nodiscard]] Answer state(const Request& request);
  [[nodiscard]] Answer decide(DecisionRequest request, project::Transaction transaction);

  Gate gate_;
  SiteContents contents_;
  ServedPage page_;
};

}  // namespace strake::serve
