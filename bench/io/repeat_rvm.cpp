// SPDX-License-Identifier: Apache-2.0
#include "repeat_rvm.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

namespace strake::bench {
namespace {

constexpr std::size_t kFrameBytes = 24;        // id, next, an unused word
constexpr std::size_t kParametersAt = 8 + 72;  // in a body: version, kind, matrix, box
constexpr std::uint32_t kFacetKind = 11;

std::uint32_t load(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

void store(std::string& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 4; i-- > 0; value >>= 8) bytes[at + i] = static_cast<char>(value & 0xFFU);
}

void append(std::string& bytes, std::uint32_t value) {
  bytes.resize(bytes.size() + 4);
  store(bytes, bytes.size() - 4, value);
}

/// A chunk of the samples: id and body.
struct Chunk {
  std::string id;
  std::string_view body;
};

/// The chunks of a healthy file up to END.
Result<std::vector<Chunk>> chunks_of(std::string_view file, const std::string& name) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 0; at + kFrameBytes <= file.size();) {
    std::string id;
    for (std::size_t k = 0; k < 4; ++k) id.push_back(file[at + 4 * k + 3]);
    const std::size_t next = load(file, at + 16);
    if (id == "END:") return chunks;
    if (next < at + kFrameBytes || next > file.size()) break;
    chunks.push_back({id, file.substr(at + kFrameBytes, next - at - kFrameBytes)});
    at = next;
  }
  return Error{ErrorCode::input, "is no healthy RVM file", name, "give another sample"};
}

void append_chunk(std::string& out, std::string_view id, std::string_view body) {
  for (const char c : id) append(out, static_cast<unsigned char>(c));
  append(out, static_cast<std::uint32_t>(out.size() + 8 + body.size()));
  append(out, 1);
  out.append(body);
}

/// Moves a coordinate that is not zero by `steps` float spacings; equal ones stay equal.
void move_float(std::string& body, std::size_t at, std::uint32_t steps) {
  const std::uint32_t bits = load(body, at);
  if ((bits << 1) != 0) store(body, at, bits + steps);
}

void vary(std::string& body, std::uint32_t steps) {
  if (load(body, 4) != kFacetKind) {
    for (std::size_t at = kParametersAt; at + 4 <= body.size(); at += 4)
      move_float(body, at, steps);
    return;
  }
  std::size_t at = kParametersAt + 4;
  for (std::uint32_t polygon = load(body, kParametersAt); polygon-- > 0;) {
    std::uint32_t contours = load(body, at);
    for (at += 4; contours-- > 0;) {
      std::uint32_t vertices = load(body, at);
      for (at += 4; vertices-- > 0; at += 24) move_float(body, at, steps);
    }
  }
}

void append_copy(std::string& out, const std::vector<Chunk>& chunks, std::uint32_t copy,
                 Copies copies) {
  std::string name = fmt::format("/COPY-{}", copy), group;
  append(group, 1);
  name.resize((name.size() + 3) / 4 * 4);
  append(group, static_cast<std::uint32_t>(name.size() / 4));
  group += name;
  for (int zero = 0; zero < 4; ++zero) append(group, 0);  // reference point, material
  append_chunk(out, "CNTB", group);
  for (const Chunk& chunk : chunks) {
    std::string body(chunk.body);
    if (chunk.id == "PRIM" && copies == Copies::different) vary(body, copy);
    append_chunk(out, chunk.id, body);
  }
  append_chunk(out, "CNTE", std::string("\0\0\0\1", 4));
}

}  // namespace

Result<std::string> repeat_rvm(std::span<const std::filesystem::path> samples, std::size_t bytes,
                               Copies copies) {
  std::vector<std::string> files;
  std::vector<Chunk> inner;
  std::string out;
  files.reserve(samples.size());
  for (const std::filesystem::path& path : samples) {
    std::ifstream in(path, std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    const Result<std::vector<Chunk>> chunks = chunks_of(files.back(), path.string());
    if (!chunks) return chunks.error();
    for (const Chunk& chunk : *chunks) {
      const bool outer = chunk.id == "HEAD" || chunk.id == "MODL";
      if (outer && files.size() == 1) append_chunk(out, chunk.id, chunk.body);
      if (!outer) inner.push_back(chunk);
    }
  }
  for (std::uint32_t copy = 1; out.size() < bytes; ++copy) append_copy(out, inner, copy, copies);
  append_chunk(out, "END:", std::string("\0\0\0\1", 4));
  return out;
}

}  // namespace strake::bench
