// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strake::test {

/// Writes RVM bytes for tests: every chunk, kind and version, and on request the defects that real
/// and hostile files have.
class RvmWriter {
 public:
  struct Vertex {
    float x = 0, y = 0, z = 0;
  };
  using Contour = std::vector<Vertex>;
  using FacetPolygon = std::vector<Contour>;

  static constexpr std::array<float, 12> kUnitMatrix = {0.001F, 0, 0,      0, 0.001F, 0,
                                                        0,      0, 0.001F, 0, 0,      0};

  /// A matrix of millimetres to metres, unturned, with its origin in metres.
  static std::array<float, 12> at(float x, float y, float z) {
    std::array<float, 12> m = kUnitMatrix;
    m[9] = x;
    m[10] = y;
    m[11] = z;
    return m;
  }

  RvmWriter& head(std::uint32_t version = 2, std::string_view encoding = "Unicode UTF-8") {
    begin("HEAD");
    u32(version);
    for (const char* field : {"spec", "", "now", "me"}) string(field);
    if (version >= 2) string(encoding);
    return end();
  }
  RvmWriter& modl(std::string_view name = "/M") {
    begin("MODL");
    u32(1);
    string("P");
    string(name);
    return end();
  }
  RvmWriter& cntb(std::string_view name, std::uint32_t version = 2, std::uint32_t material = 0,
                  std::uint8_t transparency = 0) {
    begin("CNTB");
    u32(version);
    string(name);
    floats({0, 0, 0});
    u32(material);
    if (version >= 3) bytes({transparency, 2, 0, 0});
    if (version >= 4) bytes_.resize(bytes_.size() + 24);
    return end();
  }
  RvmWriter& cnte(std::uint32_t version = 2) {
    begin("CNTE");
    u32(version);
    return end();
  }
  RvmWriter& colr(std::uint32_t index, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    begin("COLR");
    u32(0);
    u32(index);
    bytes({r, g, b, 0});
    return end();
  }
  RvmWriter& prim(std::uint32_t kind, std::initializer_list<float> parameters,
                  std::array<float, 12> matrix = kUnitMatrix,
                  std::array<float, 6> box = {-1, -1, -1, 1, 1, 1}) {
    return prim(kind, std::span<const float>(parameters), matrix, box);
  }
  RvmWriter& prim(std::uint32_t kind, std::span<const float> parameters,
                  std::array<float, 12> matrix = kUnitMatrix,
                  std::array<float, 6> box = {-1, -1, -1, 1, 1, 1}) {
    begin_primitive("PRIM", kind, matrix, box);
    floats(parameters);
    return end();
  }
  /// OBST or INSU, with the transparency after the box or, as some writers may, before the matrix.
  RvmWriter& volume(std::string_view id, std::uint8_t transparency, std::uint32_t kind,
                    std::initializer_list<float> parameters,
                    std::array<float, 12> matrix = kUnitMatrix, bool before_matrix = false) {
    begin(id);
    u32(1);
    u32(kind);
    if (before_matrix) bytes({transparency, 0, 0, 0});
    floats(matrix);
    floats({-1, -1, -1, 1, 1, 1});
    if (!before_matrix) bytes({transparency, 0, 0, 0});
    floats(parameters);
    return end();
  }
  RvmWriter& facets(const std::vector<FacetPolygon>& polygons,
                    std::array<float, 12> matrix = kUnitMatrix) {
    begin_primitive("PRIM", 11, matrix, {0, 0, 0, 0, 0, 0});
    u32(static_cast<std::uint32_t>(polygons.size()));
    for (const FacetPolygon& polygon : polygons) {
      u32(static_cast<std::uint32_t>(polygon.size()));
      for (const Contour& contour : polygon) {
        u32(static_cast<std::uint32_t>(contour.size()));
        for (const Vertex& v : contour) floats({v.x, v.y, v.z, 0, 0, 1});
      }
    }
    return end();
  }
  RvmWriter& finish() {
    begin("END:");
    u32(1);
    end();
    bytes_.resize(bytes_.size() + 100);
    return *this;
  }

  // Defects.
  RvmWriter& raw(std::string_view text) {
    for (const char c : text) bytes_.push_back(static_cast<std::byte>(c));
    return *this;
  }
  /// Adds bytes to the last chunk, counted or not in its stated address.
  RvmWriter& pad_last(std::size_t count, bool restate) {
    bytes_.resize(bytes_.size() + count, std::byte{0x5A});
    if (restate) end();
    return *this;
  }
  RvmWriter& set_next(std::uint32_t next) {
    put(chunk_ + 16, next);
    return *this;
  }
  /// Overwrites a word of the last chunk, counted from the start of its body.
  RvmWriter& set_word(std::size_t body_offset, std::uint32_t value) {
    put(chunk_ + 24 + body_offset, value);
    return *this;
  }
  RvmWriter& chunk(std::string_view id, std::size_t body_bytes) {
    begin(id);
    bytes_.resize(bytes_.size() + body_bytes);
    return end();
  }

  [[nodiscard]] std::size_t last_chunk() const { return chunk_; }
  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  void begin_primitive(std::string_view id, std::uint32_t kind, std::span<const float> matrix,
                       std::array<float, 6> box) {
    begin(id);
    u32(1);
    u32(kind);
    floats(matrix);
    floats(box);
  }
  void begin(std::string_view id) {
    chunk_ = bytes_.size();
    for (const char c : id) u32(static_cast<unsigned char>(c));
    u32(0);
    u32(1);
  }
  RvmWriter& end() {
    put(chunk_ + 16, static_cast<std::uint32_t>(bytes_.size()));
    return *this;
  }
  void put(std::size_t at, std::uint32_t value) {
    for (std::size_t k = 0; k < 4; ++k)
      bytes_[at + k] = static_cast<std::byte>(value >> (24 - 8 * k) & 0xFFU);
  }
  void u32(std::uint32_t value) {
    bytes_.resize(bytes_.size() + 4);
    put(bytes_.size() - 4, value);
  }
  void bytes(std::initializer_list<std::uint8_t> values) {
    for (const std::uint8_t v : values) bytes_.push_back(static_cast<std::byte>(v));
  }
  void floats(std::initializer_list<float> values) {
    for (const float v : values) u32(std::bit_cast<std::uint32_t>(v));
  }
  void floats(std::span<const float> values) {
    for (const float v : values) u32(std::bit_cast<std::uint32_t>(v));
  }
  void string(std::string_view text) {
    const std::size_t words = (text.size() + 3) / 4;
    u32(static_cast<std::uint32_t>(words));
    for (const char c : text) bytes_.push_back(static_cast<std::byte>(c));
    bytes_.resize(bytes_.size() + words * 4 - text.size());
  }

  std::vector<std::byte> bytes_;
  std::size_t chunk_ = 0;
};

}  // namespace strake::test
