// SPDX-License-Identifier: Apache-2.0
#include "io/importer/scene_content.hpp"

#include <string_view>

#include "io/gltf/container.hpp"
#include "io/gltf/document.hpp"
#include "io/gltf/import.hpp"

namespace strake::io {

double unit_of_scene(const FileBytes& scene, const parallel::Context& context) {
  const FrameDefault frame{1000.0, UpAxis::y, true};
  const Result<gltf::Container> container = gltf::open_container(scene);
  if (!container) return frame.unit_mm;
  const Result<gltf::Document> document = gltf::Document::open(container->json, context);
  return document ? gltf::stated_frame(document->root()).unit_mm : frame.unit_mm;
}

std::optional<std::string> named_by_scene(const FileBytes& scene,
                                          const parallel::Context& context) {
  const Result<gltf::Container> container = gltf::open_container(scene);
  if (!container || !gltf::may_name_files(*container)) return std::nullopt;
  const Result<gltf::Document> document = gltf::Document::open(container->json, context);
  if (!document) return std::nullopt;
  for (const std::string_view list : {"buffers", "images"})
    for (const gltf::JsonValue& item : document->root()[list].items()) {
      const gltf::JsonValue uri = item["uri"];
      if (!uri.is_string()) continue;
      std::string text = uri.text_value();
      if (!text.starts_with("data:")) return text;
    }
  return std::nullopt;
}

}  // namespace strake::io
