// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace strake::io::gltf {

/// Why a part of a document cannot be used: the JSON pointer of the culprit and what is wrong.
struct Fault {
  std::string pointer;
  std::string message;
};

/// A value or the fault that prevented it; unlike an Error it costs one object, not the file.
template <class T>
using Checked = std::variant<T, Fault>;

template <class T>
[[nodiscard]] const Fault* fault_of(const Checked<T>& checked) {
  return std::get_if<Fault>(&checked);
}

}  // namespace strake::io::gltf
