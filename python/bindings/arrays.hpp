// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "strake/geometry/vec.hpp"

/// Arrays of NumPy that lie where the library has them, and fields of records.
namespace strake::python {

/// Returns an object that keeps a value alive for as long as arrays of it are.
template <class Owner>
[[nodiscard]] nanobind::object keep_alive(std::shared_ptr<Owner> owner) {
  return nanobind::capsule(
      new std::shared_ptr<Owner>(std::move(owner)),
      [](void* pointer) noexcept { delete static_cast<std::shared_ptr<Owner>*>(pointer); });
}

template <class T>
using Array = nanobind::ndarray<nanobind::numpy, T>;

/// Makes an array over a vector that it takes; `shape` has as many elements as the vector.
template <class T>
[[nodiscard]] Array<T> array_of(std::vector<T> values, std::initializer_list<std::size_t> shape) {
  const auto owner = std::make_shared<std::vector<T>>(std::move(values));
  return Array<T>(owner->data(), shape, keep_alive(owner));
}

/// The same of truth values.
[[nodiscard]] Array<bool> array_of_bits(const std::vector<bool>& bits);

/// Shows bytes that another object keeps as an array that cannot be written.
[[nodiscard]] nanobind::object bytes_of(const void* data, std::size_t size,
                                        const nanobind::object& owner);

/// A field of a record: name, format as NumPy writes it, place in the record.
struct Field {
  const char* name;
  const char* format;
  std::size_t offset;
};

/// Shows records that lie behind each other as a structured array that cannot be written.
[[nodiscard]] nanobind::object records_of(const void* data, std::size_t count, std::size_t size,
                                          const std::vector<Field>& fields,
                                          const nanobind::object& owner);

}  // namespace strake::python
