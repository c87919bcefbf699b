// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace strake {

/// What kind of foreseeable failure happened; the CLI maps each to an exit code.
enum class ErrorCode {
  usage,      ///< an option or argument makes no sense
  input,      ///< a file cannot be read, is damaged, or holds nothing usable
  output,     ///< a result cannot be written
  cancelled,  ///< the stop token was triggered
  memory,     ///< the run needs more memory than there is
  internal,   ///< a broken promise of the library itself
};

/// A foreseeable failure: the place, what is wrong there, and how to mend it.
struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string message;  ///< what is wrong, in words of the user's trade
  std::string where;    ///< file, line, byte offset or object; empty when nowhere in particular
  std::string mend;     ///< what the user can do about it; may be empty

  /// Returns one line for a person: "where: message (mend)".
  [[nodiscard]] std::string text() const;
};

/// Returns the error of ErrorCode::memory: the same wherever memory ran out, which says little
/// about what took the most of it. It never throws; with no memory left at all it names no mend.
[[nodiscard]] Error out_of_memory() noexcept;

/// A value or the Error that prevented it.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value)
      : state_(std::move(value)) {
  }  // NOLINT(google-explicit-constructor): reads as `return value;`
  Result(Error error)
      : state_(std::move(error)) {
  }  // NOLINT(google-explicit-constructor): reads as `return Error{...};`

  [[nodiscard]] bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  /// Returns the value; it is a programmer error (std::bad_variant_access) when there is none.
  [[nodiscard]] T& value() & { return std::get<0>(state_); }
  [[nodiscard]] const T& value() const& { return std::get<0>(state_); }
  [[nodiscard]] T&& value() && { return std::get<0>(std::move(state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  [[nodiscard]] const Error& error() const& { return std::get<1>(state_); }
  [[nodiscard]] Error error() && { return std::get<1>(std::move(state_)); }

 private:
  std::variant<T, Error> state_;
};

/// Success, or the Error that prevented it.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error)
      : error_(std::move(error)) {
  }  // NOLINT(google-explicit-constructor): reads as `return Error{...};`

  [[nodiscard]] bool has_value() const { return !error_.has_value(); }
  explicit operator bool() const { return has_value(); }
  [[nodiscard]] const Error& error() const& { return *error_; }
  [[nodiscard]] Error error() && { return *std::move(error_); }

 private:
  std::optional<Error> error_;
};

using Status = Result<void>;

}  // namespace strake
