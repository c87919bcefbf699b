// SPDX-License-Identifier: Apache-2.0
#include "strake/io/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "io/gltf/accessor.hpp"
#include "io/gltf/container.hpp"
#include "io/gltf/document.hpp"
#include "io/gltf/import.hpp"
#include "io/source/input_file.hpp"
#include "io/source/reader_support.hpp"

namespace strake::io {
namespace {

/// Extensions that change where geometry is, and that are read.
constexpr std::array<std::string_view, 4> kRead{"KHR_mesh_quantization", "EXT_mesh_gpu_instancing",
                                                "EXT_meshopt_compression",
                                                "KHR_meshopt_compression"};
/// Beginnings of those that change only how it looks.
constexpr std::array<std::string_view, 10> kHarmless{"KHR_materials_",    "KHR_texture_",
                                                     "EXT_texture_",      "MSFT_texture_",
                                                     "KHR_lights_",       "KHR_xmp",
                                                     "KHR_animation_",    "EXT_structural_metadata",
                                                     "EXT_mesh_features", "EXT_instance_features"};

bool is_understood(std::string_view extension) {
  if (std::find(kRead.begin(), kRead.end(), extension) != kRead.end()) return true;
  return std::any_of(kHarmless.begin(), kHarmless.end(), [&](std::string_view start) {
    return extension.substr(0, start.size()) == start;
  });
}

Status check_extensions(const FileBytes& file, const gltf::JsonValue& root) {
  for (const gltf::JsonValue& item : root["extensionsRequired"].items()) {
    const std::string name = item.text_value();
    if (is_understood(name)) continue;
    const bool packed = name.find("compression") != std::string::npos;
    return Error{ErrorCode::input,
                 fmt::format("requires the extension {}, which is not read", name),
                 fmt::format("{}, /extensionsRequired", file.path.string()),
                 packed ? "export the model without mesh compression"
                        : "export the model without this extension"};
  }
  return {};
}

Status check_version(const FileBytes& file, const gltf::JsonValue& root) {
  const std::string place = fmt::format("{}, /asset/version", file.path.string());
  if (!root.is_object() || !root["asset"].is_object())
    return Error{ErrorCode::input, "is JSON but no glTF: it has no asset", file.path.string(),
                 "give a glTF 2.0 file"};
  const std::string version = root["asset"]["version"].text_value();
  if (version.substr(0, 2) == "2.") return {};
  return Error{ErrorCode::input, fmt::format("is glTF version '{}'; only 2.0 is read", version),
               place, "export it as glTF 2.0"};
}

class GltfReader final : public Reader {
 public:
  [[nodiscard]] std::string_view format() const override { return "glTF"; }

  [[nodiscard]] int recognise(const FileBytes& file) const override {
    if (gltf::has_glb_magic(file.bytes)) return 100;
    const std::string_view text = without_byte_order_mark(as_text(file.bytes)).substr(0, 1U << 16U);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    const bool object = first != std::string_view::npos && text[first] == '{';
    const std::string extension = lower_extension(file.path);
    if (extension == ".gltf") return object ? 95 : 20;
    if (extension == ".glb") return 20;
    // The asset is required and usually comes first, but may come anywhere.
    return !object ? 0 : text.find("\"asset\"") != std::string_view::npos ? 70 : 5;
  }

  [[nodiscard]] std::vector<std::filesystem::path> companions(
      const FileBytes& file, const parallel::Context& context) const override {
    std::vector<std::filesystem::path> found;
    const Result<gltf::Container> container = gltf::open_container(file);
    if (!container || !gltf::may_name_files(*container)) return found;
    const Result<gltf::Document> document = gltf::Document::open(container->json, context);
    if (!document) return found;
    for (const gltf::JsonValue& buffer : document->root()["buffers"].items()) {
      const gltf::JsonValue uri = buffer["uri"];
      if (!uri.is_string() || uri.raw().starts_with("data:")) continue;
      const auto path = safe_relative_path(file.path, gltf::decode_uri(uri.text_value()));
      if (path) found.push_back(*path);
    }
    return found;
  }

  [[nodiscard]] Result<model::Model> read(const FileBytes& file, const ReadOptions& options,
                                          const parallel::Context& context) const override {
    const Result<gltf::Container> container = gltf::open_container(file);
    if (!container) return container.error();
    const Result<gltf::Document> document = gltf::Document::open(container->json, context);
    if (!document) return gltf::error_in_json(file, document.error());
    const gltf::JsonValue root = document->root();
    if (const Status version = check_version(file, root); !version) return version.error();
    if (const Status known = check_extensions(file, root); !known) return known.error();
    return gltf::import_document({file, options, context}, *container, *document);
  }
};

}  // namespace

std::unique_ptr<Reader> make_gltf_reader() { return std::make_unique<GltfReader>(); }

}  // namespace strake::io
