// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/buffers.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "io/nearby_file.hpp"

namespace strake::io::gltf {
namespace {

constexpr int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

constexpr int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  unsigned bits = 0, held = 0;
  for (const char c : text) {
    const int value = base64_value(c);
    if (value < 0) return std::nullopt;
    bits = bits << 6U | static_cast<unsigned>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> held & 0xFFU));
  }
  return bytes;
}

std::string decode_uri(std::string_view uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_value(uri[i + 1]) : -1;
    const int low = high >= 0 ? hex_value(uri[i + 2]) : -1;
    if (low < 0) {
      out.push_back(uri[i]);
      continue;
    }
    out.push_back(static_cast<char>(high * 16 + low));
    i += 2;
  }
  return out;
}

void Buffers::load_uri(Buffer& buffer, const std::string& pointer, const Json& uri,
                       const std::filesystem::path& file) {
  // Some writers escape the slashes of base64; decoding a long string for nothing takes time.
  const bool escaped = uri.raw().find('\\') != std::string_view::npos;
  const std::string plain = escaped ? uri.text_value() : std::string();
  const std::string_view text = escaped ? std::string_view(plain) : uri.raw();
  if (text.substr(0, 5) == "data:") {
    const std::size_t comma = text.find(',');
    const bool base64 = comma != std::string_view::npos &&
                        text.substr(0, comma).find(";base64") != std::string_view::npos;
    std::optional<std::vector<std::byte>> bytes;
    if (base64) bytes = decode_base64(text.substr(comma + 1));
    if (!bytes) {
      buffer.fault = Fault{pointer, "its data: URI is not valid base64"};
      return;
    }
    buffer.decoded = std::move(*bytes);
    buffer.bytes = buffer.decoded;
    return;
  }
  const std::string name = decode_uri(uri.text_value());
  const std::optional<std::filesystem::path> path = nearby_path(file, name);
  if (!path) {
    buffer.fault =
        Fault{pointer, fmt::format("'{}' lies outside the file's folder and is not read; "
                                   "put it beside the file",
                                   name)};
    return;
  }
  Result<FileContent> content = FileContent::read(*path);
  if (!content) {
    buffer.fault = Fault{
        pointer, fmt::format("'{}' {}; put it beside the file", name, content.error().message)};
    return;
  }
  buffer.file = std::move(*content);
  buffer.bytes = buffer.file->bytes();
}

void Buffers::load(Buffer& buffer, std::size_t index, const Json& json, const Container& container,
                   const std::filesystem::path& file) {
  const std::string pointer = fmt::format("/buffers/{}", index);
  const std::optional<std::uint64_t> length = json["byteLength"].index();
  if (!length) {
    buffer.fault = Fault{pointer, "has no byteLength"};
    return;
  }
  const Json uri = json["uri"];
  if (uri.is_string()) {
    load_uri(buffer, pointer + "/uri", uri, file);
  } else if (index == 0 && container.chunk) {
    buffer.bytes = *container.chunk;
  } else {
    buffer.fault = Fault{pointer, "has no data"};
  }
  if (buffer.fault) return;
  if (*length > buffer.bytes.size()) {
    buffer.fault =
        Fault{pointer, fmt::format("should have {} bytes but has {}: the file is cut off", *length,
                                   buffer.bytes.size())};
    return;
  }
  buffer.bytes = buffer.bytes.first(*length);
  total_bytes_ += *length;
}

Buffers::Buffers(const Json& root, const Container& container, const std::filesystem::path& file) {
  const std::vector<Json> buffers = root["buffers"].items();
  buffers_.resize(buffers.size());
  for (std::size_t i = 0; i < buffers.size(); ++i)
    load(buffers_[i], i, buffers[i], container, file);
  root["bufferViews"].elements([&](const Json& json) {
    const auto [buffer, offset, length, stride, extensions] =
        json.pick<5>({"buffer", "byteOffset", "byteLength", "byteStride", "extensions"});
    const auto optional = [](const Json& value) {
      return value.exists() ? value.index() : std::optional<std::uint64_t>(0);
    };
    Stated stated{buffer.index(), optional(offset), length.index(), optional(stride), nullptr};
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
      if (!buffer.exists() && stated.packed == nullptr && extensions[name].is_object())
        stated.packed = name;
    views_.push_back(stated);
  });
}

Checked<Buffers::View> Buffers::view(std::size_t index) const {
  const std::string pointer = fmt::format("/bufferViews/{}", index);
  if (index >= views_.size())
    return Fault{pointer, fmt::format("does not exist; there are {}", views_.size())};
  const Stated& stated = views_[index];
  if (stated.packed != nullptr)
    return Fault{pointer, fmt::format("is packed by {}, which is not read", stated.packed)};
  if (!stated.buffer || *stated.buffer >= buffers_.size())
    return Fault{pointer + "/buffer", "does not exist"};
  const Buffer& owner = buffers_[*stated.buffer];
  if (owner.fault) return *owner.fault;
  if (!stated.offset || !stated.length || !stated.stride)
    return Fault{pointer, "has an offset, length or stride that is no whole number"};
  if (*stated.offset > owner.bytes.size() || *stated.length > owner.bytes.size() - *stated.offset)
    return Fault{pointer, fmt::format("bytes {} to {} lie outside its buffer of {}", *stated.offset,
                                      *stated.offset + *stated.length, owner.bytes.size())};
  return View{owner.bytes.subspan(*stated.offset, *stated.length),
              static_cast<std::size_t>(*stated.stride)};
}

}  // namespace strake::io::gltf
