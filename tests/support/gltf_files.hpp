// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace strake::test {

/// Numbers as the bytes that a buffer holds.
template <class T>
[[nodiscard]] std::string bytes_of(const std::vector<T>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)};
}

/// A GLB of a JSON text and, if there is any, a binary chunk.
[[nodiscard]] inline std::string glb(std::string json, std::string binary = {}) {
  const auto pad = [](std::string& text, char with) {
    while (text.size() % 4 != 0) text.push_back(with);
  };
  pad(json, ' ');
  pad(binary, '\0');
  const auto word = [](std::size_t value) {
    return bytes_of(std::vector{static_cast<std::uint32_t>(value)});
  };
  std::string body = word(json.size()) + word(0x4E4F534A) + json;
  if (!binary.empty()) body += word(binary.size()) + word(0x004E4942) + binary;
  return "glTF" + word(2) + word(12 + body.size()) + body;
}

/// A document of one triangle mesh with 16-bit indices behind its positions; `nodes` and `extra`
/// are JSON ("nodes":[...] and what else belongs to the top level, with a leading comma).
[[nodiscard]] inline std::string triangle_glb(const std::string& nodes,
                                              const std::string& extra = {}) {
  const std::string binary = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0}) +
                             bytes_of(std::vector<std::uint16_t>{0, 1, 2});
  return glb(
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":42}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36},)"
      R"({"buffer":0,"byteOffset":36,"byteLength":6}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],)"
      R"("meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)" +
          nodes + extra + "}",
      binary);
}

}  // namespace strake::test
