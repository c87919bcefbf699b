// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/gltf/buffers.hpp"
#include "io/gltf/fault.hpp"
#include "io/gltf/json.hpp"

namespace strake::io::gltf {

/// The component types of the specification, by its numbers.
enum class Component : std::uint32_t {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126
};

/// An accessor whose elements are known to lie within its buffer view.
struct Accessor {
  Accessor() = default;
  Accessor(Accessor&&) = default;  // `bytes` may look at `dense`, so there are no copies
  Accessor& operator=(Accessor&&) = default;
  Accessor(const Accessor&) = delete;
  Accessor& operator=(const Accessor&) = delete;
  ~Accessor() = default;

  std::string pointer;
  std::vector<std::byte> dense;  ///< its elements where they are not simply those of a view
  std::span<const std::byte> bytes;
  std::size_t stride = 0;
  std::size_t count = 0;
  std::size_t width = 0;  ///< components of an element
  Component component = Component::float32;
  bool normalized = false;

  /// The distance between neighbouring values of a component; 0 for float32.
  [[nodiscard]] double step() const;
  /// Components of an element as numbers, normalised where the accessor says so.
  void element(std::size_t index, double* out) const;
  /// An element of an accessor of unsigned integers with one component.
  [[nodiscard]] std::uint32_t integer(std::size_t index) const;
};

/// Reads accessors of a document; safe to share between threads.
class Accessors {
 public:
  Accessors(const Json& root, const Buffers& buffers);

  /// Any accessor that is well-formed; without data it is zeros. Sparse ones are made dense.
  [[nodiscard]] Checked<Accessor> open(std::uint64_t index) const;

  /// The count that an accessor states, 0 if it does not exist; nothing else is looked at.
  [[nodiscard]] std::uint64_t stated_count(std::uint64_t index) const;
  [[nodiscard]] bool has_data(std::uint64_t index) const;
  /// The count of an accessor whose elements are put into memory whenever it is opened, else 0.
  [[nodiscard]] std::uint64_t copied_count(std::uint64_t index) const;

 private:
  /// What the document states. Read once: many primitives may share an accessor, and an object
  /// may hold any number of members that are none of ours.
  struct Stated {
    std::optional<std::uint64_t> count, component, offset;
    std::optional<std::uint64_t> view;  ///< UINT64_MAX where it is no index
    std::size_t width = 0;
    bool normalized = false;
    Json sparse;
  };

  [[nodiscard]] Checked<Accessor> open_dense(std::uint64_t index) const;
  [[nodiscard]] bool apply_sparse(Accessor& accessor, const Json& sparse, Fault& fault) const;

  std::vector<Stated> accessors_;
  const Buffers* buffers_;
};

}  // namespace strake::io::gltf
