// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "strake/core/result.hpp"

/// Failures of the library as exceptions of Python.
namespace strake::python {

/// Raises the strake.Error that belongs to the code. The GIL is held.
[[noreturn]] void raise(const Error& error);

/// Returns the value, or raises.
template <class T>
[[nodiscard]] T value_or_raise(Result<T>&& result) {
  if (!result) raise(result.error());
  return std::move(*result);
}

inline void check(const Status& status) {
  if (!status) raise(status.error());
}

}  // namespace strake::python
