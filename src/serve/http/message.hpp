// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Requests and answers of HTTP as values.
namespace strake::serve {

/// Names with values, as they came.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// A request. Nothing in it is decoded: what has an escape in it is another path.
struct Request {
  std::string method, path;
  Fields arguments;  ///< of the query
  Fields headers;
  std::string body;

  /// Returns a header by its name in any letter case; nothing where it is absent or repeated.
  [[nodiscard]] std::optional<std::string_view> header(std::string_view name) const;
  /// Returns how often a header is there.
  [[nodiscard]] std::size_t count(std::string_view name) const;
  /// Returns an argument of the query; nothing where it is absent or repeated.
  [[nodiscard]] std::optional<std::string_view> argument(std::string_view name) const;
};

/// The codes that answers have.
enum class HttpStatus : unsigned {
  ok = 200,
  bad_request = 400,
  forbidden = 403,
  not_found = 404,
  method_not_allowed = 405,
  conflict = 409,
  length_required = 411,
  too_large = 413,
  wrong_type = 415,
  fault = 500,
  unavailable = 503,
};

struct Answer {
  HttpStatus status = HttpStatus::ok;
  std::string type;  ///< Content-Type
  std::shared_ptr<const std::string> body;
  Fields headers = {};  ///< besides it
};

/// Returns an answer of plain text.
[[nodiscard]] Answer text_answer(HttpStatus status, std::string text);

/// Answers requests, one at a time.
class RequestHandler {
 public:
  RequestHandler() = default;
  virtual ~RequestHandler() = default;
  RequestHandler(const RequestHandler&) = delete;
  RequestHandler& operator=(const RequestHandler&) = delete;
  RequestHandler(RequestHandler&&) = delete;
  RequestHandler& operator=(RequestHandler&&) = delete;

  /// Checks a request whose body is still to come. Returns the answer that refuses it, if any.
  [[nodiscard]] virtual std::optional<Answer> refuse(const Request& request) = 0;
  /// Answers a request that was not refused, whole. Whoever asks waits as long as it takes.
  [[nodiscard]] virtual Answer answer(const Request& request) = 0;
  /// Answers as answer() does; where it has to wait for something, nothing: it is asked again soon,
  /// with how long it has waited by then. Others are answered meanwhile.
  [[nodiscard]] virtual std::optional<Answer> answer_or_wait(const Request& request,
                                                             std::chrono::milliseconds /*waited*/) {
    return answer(request);
  }
};

}  // namespace strake::serve
