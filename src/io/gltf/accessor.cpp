// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/accessor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <utility>

#include "io/source/input_file.hpp"

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

/// Returns the fault that a list of the document has no entry of this number, as the file writes
/// it.
GltfFault nothing_of(std::string_view list, const JsonValue& number, std::size_t count) {
  constexpr std::size_t kShown = 40;
  if (!number.exists()) return {std::string(list), "it is not said which one is meant"};
  return {fmt::format("{}/{}", list, number.raw().substr(0, kShown)),
          fmt::format("does not exist; there are {}", count)};
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

void Buffers::load_uri(Buffer& buffer, const std::string& pointer, const JsonValue& uri,
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
      buffer.fault = GltfFault{pointer, "its data: URI is not valid base64"};
      return;
    }
    buffer.decoded = std::move(*bytes);
    buffer.bytes = buffer.decoded;
    return;
  }
  const std::string name = decode_uri(uri.text_value());
  const std::optional<std::filesystem::path> path = safe_relative_path(file, name);
  if (!path) {
    buffer.fault =
        GltfFault{pointer, fmt::format("'{}' lies outside the file's folder and is not read; "
                                       "put it beside the file",
                                       name)};
    return;
  }
  Result<FileContent> content = FileContent::read(*path);
  if (!content) {
    buffer.fault = GltfFault{
        pointer, fmt::format("'{}' {}; put it beside the file", name, content.error().message)};
    return;
  }
  buffer.file = std::move(*content);
  buffer.bytes = buffer.file->bytes();
}

void Buffers::load(Buffer& buffer, std::size_t index, const JsonValue& json,
                   const Container& container, const std::filesystem::path& file) {
  const std::string pointer = fmt::format("/buffers/{}", index);
  const std::optional<std::uint64_t> length = json["byteLength"].index();
  if (!length) {
    buffer.fault = GltfFault{pointer, "has no byteLength"};
    return;
  }
  const JsonValue uri = json["uri"];
  if (uri.is_string()) {
    load_uri(buffer, pointer + "/uri", uri, file);
  } else if (index == 0 && container.chunk) {
    buffer.bytes = *container.chunk;
  } else {
    buffer.fault = GltfFault{pointer, "has no data"};
  }
  if (buffer.fault) return;
  if (*length > buffer.bytes.size()) {
    buffer.fault =
        GltfFault{pointer, fmt::format("should have {} bytes but has {}: the file is cut off",
                                       *length, buffer.bytes.size())};
    return;
  }
  buffer.bytes = buffer.bytes.first(*length);
  total_bytes_ += *length;
}

Buffers::Buffers(const JsonValue& root, const Container& container,
                 const std::filesystem::path& file) {
  const std::vector<JsonValue> buffers = root["buffers"].items();
  buffers_.resize(buffers.size());
  for (std::size_t i = 0; i < buffers.size(); ++i)
    load(buffers_[i], i, buffers[i], container, file);
  root["bufferViews"].elements([&](const JsonValue& json) {
    const auto [buffer, offset, length, stride, extensions] =
        json.pick<5>({"buffer", "byteOffset", "byteLength", "byteStride", "extensions"});
    const auto optional = [](const JsonValue& value) {
      return value.exists() ? value.index() : std::optional<std::uint64_t>(0);
    };
    views_.push_back({buffer.index(), optional(offset), length.index(), optional(stride), {}});
    // A view that is packed may name plain bytes as well, for those who cannot unpack it.
    if (const PackedView packed = packed_view_of(extensions); packed.extension != nullptr)
      unpack_view(views_.size() - 1, packed);
  });
}

/// Unpacks a view. All views together may become no more than the file's bytes could be, since many
/// may name the same ones.
void Buffers::unpack_view(std::size_t index, const PackedView& packed) {
  constexpr std::uint64_t kRatio = 64, kFree = std::uint64_t{1} << 20U;
  const std::string pointer = fmt::format("/bufferViews/{}", index);
  views_[index].unpacked = unpacked_.size();
  Checked<std::vector<std::byte>>& result = unpacked_.emplace_back(GltfFault{pointer, ""});
  const Stated stated{packed.buffer, packed.offset, packed.length, 0, {}};
  const Checked<BufferView> view = plain_view(stated, pointer);
  if (const GltfFault* const fault = fault_of(view)) {
    result = *fault;
    return;
  }
  const std::uint64_t largest = kRatio * (total_bytes_ - unpacked_bytes_) + kFree - unpacked_bytes_;
  Unpacked unpacked = unpack(packed, std::get<BufferView>(view).bytes, largest);
  if (!unpacked.fault.empty()) {
    result = GltfFault{pointer, std::move(unpacked.fault)};
    return;
  }
  unpacked_bytes_ += unpacked.bytes.size();
  total_bytes_ += unpacked.bytes.size();
  views_[index].stride = packed.stride;
  result = std::move(unpacked.bytes);
}

Checked<Buffers::BufferView> Buffers::view(const JsonValue& number) const {
  const std::optional<std::uint64_t> index = number.index();
  if (!index || *index >= views_.size()) return nothing_of("/bufferViews", number, views_.size());
  const std::string pointer = fmt::format("/bufferViews/{}", *index);
  const Stated& stated = views_[*index];
  if (!stated.unpacked) return plain_view(stated, pointer);
  const Checked<std::vector<std::byte>>& unpacked = unpacked_[*stated.unpacked];
  if (const GltfFault* const fault = fault_of(unpacked)) return *fault;
  return BufferView{std::get<std::vector<std::byte>>(unpacked),
                    static_cast<std::size_t>(stated.stride.value_or(0))};
}

Checked<Buffers::BufferView> Buffers::plain_view(const Stated& stated,
                                                 const std::string& pointer) const {
  if (!stated.buffer || *stated.buffer >= buffers_.size())
    return GltfFault{pointer + "/buffer", "does not exist"};
  const Buffer& owner = buffers_[*stated.buffer];
  if (owner.fault) return *owner.fault;
  if (!stated.offset || !stated.length || !stated.stride)
    return GltfFault{pointer, "has an offset, length or stride that is no whole number"};
  if (*stated.offset > owner.bytes.size() || *stated.length > owner.bytes.size() - *stated.offset)
    return GltfFault{pointer,
                     fmt::format("bytes {} to {} lie outside its buffer of {}", *stated.offset,
                                 *stated.offset + *stated.length, owner.bytes.size())};
  return BufferView{owner.bytes.subspan(*stated.offset, *stated.length),
                    static_cast<std::size_t>(*stated.stride)};
}

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie");

std::size_t component_bytes(Component component) {
  switch (component) {
    case Component::int8:
    case Component::uint8:
      return 1;
    case Component::int16:
    case Component::uint16:
      return 2;
    case Component::uint32:
    case Component::float32:
      return 4;
  }
  return 0;
}

std::size_t type_width(std::string_view type) {
  constexpr std::array<std::pair<std::string_view, std::size_t>, 4> kTypes{
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}}};
  for (const auto& [name, width] : kTypes)
    if (name == type) return width;
  return 0;
}

template <class T, class As = double>
As load(const std::byte* at) {
  T value{};
  std::memcpy(&value, at, sizeof value);
  return static_cast<As>(value);
}

double largest_of(Component component) {
  switch (component) {
    case Component::int8:
      return 127;
    case Component::uint8:
      return 255;
    case Component::int16:
      return 32767;
    case Component::uint16:
      return 65535;
    case Component::uint32:
    case Component::float32:
      break;
  }
  return 1;
}

double component_value(Component component, const std::byte* at) {
  switch (component) {
    case Component::int8:
      return load<std::int8_t>(at);
    case Component::uint8:
      return load<std::uint8_t>(at);
    case Component::int16:
      return load<std::int16_t>(at);
    case Component::uint16:
      return load<std::uint16_t>(at);
    case Component::uint32:
      return load<std::uint32_t>(at);
    case Component::float32:
      return load<float>(at);
  }
  return 0;
}

/// The widest stride of the specification is 252; a wider one is taken as written.
std::optional<GltfFault> check_extent(const Accessor& accessor, std::size_t offset,
                                      std::size_t view_bytes) {
  const std::size_t size = component_bytes(accessor.component) * accessor.width;
  if (accessor.stride < size)
    return GltfFault{accessor.pointer, fmt::format("has a stride of {} bytes for elements of {}",
                                                   accessor.stride, size)};
  if (accessor.count == 0) return std::nullopt;
  const bool fits = offset <= view_bytes && size <= view_bytes - offset &&
                    (accessor.count - 1) <= (view_bytes - offset - size) / accessor.stride;
  if (fits) return std::nullopt;
  return GltfFault{
      accessor.pointer,
      fmt::format("its {} elements of {} bytes do not fit into the {} bytes of its view",
                  accessor.count, size, view_bytes)};
}

}  // namespace

double Accessor::step() const {
  if (component == Component::float32) return 0;
  return normalized ? 1 / largest_of(component) : 1;
}

void Accessor::element(std::size_t index, double* out) const {
  const std::byte* at = bytes.data() + index * stride;
  if (component == Component::float32) {
    for (std::size_t k = 0; k < width; ++k) out[k] = load<float>(at + 4 * k);
    return;
  }
  const std::size_t size = component_bytes(component);
  for (std::size_t k = 0; k < width; ++k) {
    out[k] = component_value(component, at + size * k);
    if (normalized) out[k] = std::max(out[k] / largest_of(component), -1.0);
  }
}

std::uint32_t Accessor::integer(std::size_t index) const {
  const std::byte* at = bytes.data() + index * stride;
  if (component == Component::uint16) return load<std::uint16_t, std::uint32_t>(at);
  if (component == Component::uint8) return load<std::uint8_t, std::uint32_t>(at);
  return load<std::uint32_t, std::uint32_t>(at);
}

Accessors::Accessors(const JsonValue& root, const Buffers& buffers) : buffers_(&buffers) {
  root["accessors"].elements([&](const JsonValue& json) {
    const auto [count, component, type, normalized, view, offset, sparse] = json.pick<7>(
        {"count", "componentType", "type", "normalized", "bufferView", "byteOffset", "sparse"});
    Stated stated;
    stated.count = count.index();
    stated.component = component.index();
    stated.width = type_width(type.text_value());
    stated.normalized = normalized.boolean().value_or(false);
    stated.view = view;
    stated.offset = offset.exists() ? offset.index() : std::optional<std::uint64_t>(0);
    stated.sparse = sparse;
    accessors_.push_back(stated);
  });
}

std::uint64_t Accessors::stated_count(std::uint64_t index) const {
  return index < accessors_.size() ? accessors_[index].count.value_or(0) : 0;
}

std::uint64_t Accessors::copied_count(std::uint64_t index) const {
  if (index >= accessors_.size()) return 0;
  const Stated& stated = accessors_[index];
  return stated.sparse.is_object() || !stated.view.exists() ? stated.count.value_or(0) : 0;
}

bool Accessors::has_data(std::uint64_t index) const {
  return index < accessors_.size() &&
         (accessors_[index].view.exists() || accessors_[index].sparse.exists());
}

Checked<Accessor> Accessors::open_dense(std::uint64_t index) const {
  const Stated& stated = accessors_[index];
  Accessor accessor;
  accessor.pointer = fmt::format("/accessors/{}", index);
  accessor.width = stated.width;
  const auto component = stated.component.value_or(0);
  const bool known =
      (component >= 5120 && component <= 5123) || component == 5125 || component == 5126;
  if (!stated.count || !known || accessor.width == 0)
    return GltfFault{accessor.pointer, "has no valid count, componentType or type"};
  accessor.count = *stated.count;
  accessor.component = static_cast<Component>(component);
  accessor.normalized = stated.normalized;
  const std::size_t size = component_bytes(accessor.component) * accessor.width;

  if (!stated.view.exists()) {
    // It is all zeros, of which a file may request any number: no more than its data could hold.
    const std::size_t largest = std::max<std::size_t>(buffers_->total_bytes(), 4096);
    if (accessor.count > largest / size)
      return GltfFault{accessor.pointer,
                       fmt::format("asks for {} elements without any data", accessor.count)};
    accessor.stride = size;
    accessor.dense.resize(size * accessor.count);
    accessor.bytes = accessor.dense;
    return {std::move(accessor)};
  }
  const Checked<Buffers::BufferView> view = buffers_->view(stated.view);
  if (const GltfFault* fault = fault_of(view)) return *fault;
  const auto& found = std::get<Buffers::BufferView>(view);
  if (!stated.offset)
    return GltfFault{accessor.pointer, "has a byteOffset that is no whole number"};
  accessor.stride = found.stride == 0 ? size : found.stride;
  if (std::optional<GltfFault> fault = check_extent(accessor, *stated.offset, found.bytes.size()))
    return std::move(*fault);
  accessor.bytes = accessor.count == 0 ? found.bytes.first(0) : found.bytes.subspan(*stated.offset);
  return {std::move(accessor)};
}

bool Accessors::apply_sparse(Accessor& accessor, const JsonValue& sparse, GltfFault& fault) const {
  const auto fail = [&](std::string message) {
    fault = {accessor.pointer + "/sparse", std::move(message)};
    return false;
  };
  const std::size_t size = component_bytes(accessor.component) * accessor.width;
  Accessor indices, values;
  indices.pointer = values.pointer = accessor.pointer + "/sparse";
  const std::optional<std::uint64_t> count = sparse["count"].index();
  const std::uint64_t component = sparse["indices"]["componentType"].index().value_or(0);
  if (!count || *count > accessor.count) return fail("has no valid count");
  if (component != 5121 && component != 5123 && component != 5125)
    return fail("has indices of no valid componentType");
  indices.component = static_cast<Component>(component);
  indices.width = 1;
  values.component = accessor.component;
  values.width = accessor.width;
  for (Accessor* part : {&indices, &values}) {
    const JsonValue json = sparse[part == &indices ? "indices" : "values"];
    const Checked<Buffers::BufferView> view = buffers_->view(json["bufferView"]);
    if (const GltfFault* broken = fault_of(view)) {
      fault = *broken;
      return false;
    }
    const auto& found = std::get<Buffers::BufferView>(view);
    const std::uint64_t offset = json["byteOffset"].index().value_or(0);
    part->count = *count;
    part->stride = component_bytes(part->component) * part->width;
    if (std::optional<GltfFault> broken = check_extent(*part, offset, found.bytes.size())) {
      fault = std::move(*broken);
      return false;
    }
    if (*count != 0) part->bytes = found.bytes.subspan(offset);
  }
  // It becomes a copy with the replaced elements; the accessor's own data may be interleaved with
  // others'.
  std::vector<std::byte> dense(size * accessor.count);
  for (std::size_t i = 0; i < accessor.count; ++i)
    std::memcpy(dense.data() + size * i, accessor.bytes.data() + accessor.stride * i, size);
  for (std::size_t i = 0; i < *count; ++i) {
    const std::uint32_t target = indices.integer(i);
    if (target >= accessor.count)
      return fail(fmt::format("replaces element {} of {}", target, accessor.count));
    std::memcpy(dense.data() + size * target, values.bytes.data() + size * i, size);
  }
  accessor.dense = std::move(dense);
  accessor.bytes = accessor.dense;
  accessor.stride = size;
  return true;
}

Checked<Accessor> Accessors::open(const JsonValue& number) const {
  const std::optional<std::uint64_t> index = number.index();
  if (!index || *index >= accessors_.size())
    return nothing_of("/accessors", number, accessors_.size());
  Checked<Accessor> opened = open_dense(*index);
  const JsonValue& sparse = accessors_[*index].sparse;
  if (fault_of(opened) != nullptr || !sparse.is_object()) return opened;
  GltfFault fault;
  if (!apply_sparse(std::get<Accessor>(opened), sparse, fault)) return fault;
  return opened;
}

}  // namespace strake::io::gltf
