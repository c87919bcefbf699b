// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/gltf/container.hpp"
#include "io/gltf/json/json.hpp"
#include "io/gltf/packed_view.hpp"
#include "io/source/input_file.hpp"

/// Buffers, buffer views and accessors of a glTF document.
namespace strake::io::gltf {

/// Why a part of a document cannot be used: the JSON pointer of the culprit and what is wrong.
struct GltfFault {
  std::string pointer;
  std::string message;
};

/// A value or the fault that prevented it; unlike an Error it costs one object, not the file.
template <class T>
using Checked = std::variant<T, GltfFault>;

template <class T>
[[nodiscard]] const GltfFault* fault_of(const Checked<T>& checked) {
  return std::get_if<GltfFault>(&checked);
}

/// Returns the bytes of a data: URI's base64, nothing when it is not valid.
[[nodiscard]] std::optional<std::vector<std::byte>> decode_base64(std::string_view text);

/// Returns a relative URI with its percent escapes decoded.
[[nodiscard]] std::string decode_uri(std::string_view uri);

/// The buffers and buffer views of a document. All is checked here: a view that was given out lies
/// within its buffer.
class Buffers {
 public:
  struct BufferView {
    std::span<const std::byte> bytes;
    std::size_t stride = 0;  ///< 0: tightly packed
  };

  /// Loads what the document names: the GLB's own chunk, data: URIs, and files in the model's
  /// folder or below it. What cannot be loaded is a fault of its views.
  Buffers(const JsonValue& root, const Container& container, const std::filesystem::path& file);

  /// Returns the view that a document names by its number.
  [[nodiscard]] Checked<BufferView> view(const JsonValue& number) const;
  [[nodiscard]] std::size_t total_bytes() const { return total_bytes_; }

 private:
  struct Buffer {
    std::span<const std::byte> bytes;
    std::optional<FileContent> file;
    std::vector<std::byte> decoded;
    std::optional<GltfFault> fault;
  };

  /// What the document states of a view, read once for all accessors that share it.
  struct Stated {
    std::optional<std::uint64_t> buffer, offset, length, stride;
    std::optional<std::size_t> unpacked;  ///< which of the unpacked ones it is
  };

  void load(Buffer& buffer, std::size_t index, const JsonValue& json, const Container& container,
            const std::filesystem::path& file);
  void load_uri(Buffer& buffer, const std::string& pointer, const JsonValue& uri,
                const std::filesystem::path& file);

  std::vector<Buffer> buffers_;
  [[nodiscard]] Checked<BufferView> plain_view(const Stated& stated,
                                               const std::string& pointer) const;
  void unpack_view(std::size_t index, const PackedView& packed);

  std::vector<Stated> views_;
  std::vector<Checked<std::vector<std::byte>>> unpacked_;
  std::size_t total_bytes_ = 0;  ///< of the buffers, and what is unpacked of them
  std::size_t unpacked_bytes_ = 0;
};

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
  std::vector<std::byte> dense;  ///< its elements, where they are not simply those of a view
  std::span<const std::byte> bytes;
  std::size_t stride = 0;
  std::size_t count = 0;
  std::size_t width = 0;  ///< the number of components of an element
  Component component = Component::float32;
  bool normalized = false;

  /// Returns the distance between neighbouring values of a component; 0 for float32.
  [[nodiscard]] double step() const;
  /// Gives the components of an element as numbers, normalised where the accessor says so.
  void element(std::size_t index, double* out) const;
  /// Returns an element of an accessor of unsigned integers with one component.
  [[nodiscard]] std::uint32_t integer(std::size_t index) const;
};

/// Reads accessors of a document; safe to share between threads.
class Accessors {
 public:
  Accessors(const JsonValue& root, const Buffers& buffers);

  /// Opens the accessor that a document names by its number, if it is well-formed; without data it
  /// is zeros. Sparse ones are made dense.
  [[nodiscard]] Checked<Accessor> open(const JsonValue& number) const;

  /// Returns the count that an accessor states, 0 if it does not exist; nothing else is checked.
  [[nodiscard]] std::uint64_t stated_count(std::uint64_t index) const;
  [[nodiscard]] bool has_data(std::uint64_t index) const;
  /// Returns the count of an accessor whose elements are copied into memory whenever it is opened,
  /// else 0.
  [[nodiscard]] std::uint64_t copied_count(std::uint64_t index) const;

 private:
  /// What the document states of an accessor. It is read once: many primitives may share an
  /// accessor, and an object may hold any number of members that are none of ours.
  struct Stated {
    std::optional<std::uint64_t> count, component, offset;
    JsonValue view;
    std::size_t width = 0;
    bool normalized = false;
    JsonValue sparse;
  };

  [[nodiscard]] Checked<Accessor> open_dense(std::uint64_t index) const;
  [[nodiscard]] bool apply_sparse(Accessor& accessor, const JsonValue& sparse,
                                  GltfFault& fault) const;

  std::vector<Stated> accessors_;
  const Buffers* buffers_;
};

}  // namespace strake::io::gltf
