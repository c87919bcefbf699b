// SPDX-License-Identifier: Apache-2.0
// What is in blobs, past the hash that keeps accidents out: any bytes as blocks of every kind.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "project/codec/blob.hpp"
#include "project/model/blocks.hpp"
#include "project/model/shape_block.hpp"
#include "project/model/stored_diagnostics.hpp"
#include "project/views/drawing_codec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strake;
  if (size < 2) return 0;
  const std::size_t items = data[0];
  const std::span<const std::uint8_t> values(data + 1, size - 1);
  project::BlobWriter writer;
  // Words without a count of their own.
  for (std::size_t at = 0; at + 8 <= values.size(); at += 8) {
    std::uint64_t word = 0;
    for (std::size_t k = 0; k < 8; ++k) word |= std::uint64_t{values[at + k]} << 8 * k;
    writer.number(word);
  }
  const auto blob = writer.finish();
  if (!blob) return 0;
  project::FilePlace place;
  place.groups = place.attributes = place.shapes = place.bodies = place.objects = 100;
  std::vector<model::Object> objects(items);
  static_cast<void>(project::unpack_objects(*blob, "fuzz", place, objects));
  std::vector<model::Body> bodies(items);
  static_cast<void>(project::unpack_bodies(*blob, "fuzz", place, bodies));
  std::vector<model::Group> groups(items);
  static_cast<void>(project::unpack_groups(*blob, "fuzz", place, groups));
  std::vector<model::Attributes> attributes(items);
  static_cast<void>(project::unpack_attributes(*blob, "fuzz", attributes));
  std::vector<model::Shape> shapes(items);
  static_cast<void>(project::unpack_shapes(*blob, "fuzz", shapes));
  static_cast<void>(project::unpack_meshes(*blob, {}, "fuzz"));
  static_cast<void>(project::unpack_diagnostics(*blob, "fuzz"));
  // A drawing, whole and as the head of parts, which are other bytes.
  auto drawing = project::BlobReader::open(*blob, "fuzz");
  if (drawing) static_cast<void>(project::read_drawing(*drawing, {}));
  auto head = project::BlobReader::open(*blob, "fuzz");
  const std::vector<std::span<const std::byte>> parts{*blob};
  if (head) static_cast<void>(project::read_parts_of_drawing(*head, parts, "fuzz", {}));
  return 0;
}
