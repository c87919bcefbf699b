// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <variant>

#include "strake/io/reader.hpp"

/// Any bytes as an RVM file, binary or text: a model whose indices hold, or an error. Unlike in
/// other formats an object may be left without bodies: its unusable primitives are diagnostics.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strake;
  const auto reader = io::make_rvm_reader();
  const io::FileBytes file{{}, std::as_bytes(std::span(data, size))};
  const int sure = reader->recognise(file);
  if (sure < 0 || sure > 100) std::abort();
  const auto model = reader->read(file, {}, {});
  if (!model) return 0;
  for (const model::Object& object : model->objects)
    if (object.first_body + object.body_count > model->bodies.size() || object.id.empty())
      std::abort();
  for (const model::Body& body : model->bodies)
    if (model::index(body.shape) >= model->shapes.size()) std::abort();
  for (const model::Shape& shape : model->shapes) {
    const auto* mesh = std::get_if<geometry::TriangleMesh>(&shape);
    if (mesh == nullptr) continue;
    if (mesh->faces.size() != mesh->triangles.size()) std::abort();
    for (const geometry::Triangle& triangle : mesh->triangles)
      for (const std::uint32_t vertex : triangle)
        if (vertex >= mesh->vertices.size()) std::abort();
  }
  return 0;
}
