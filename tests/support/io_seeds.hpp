// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "support/gltf_files.hpp"

namespace strake::test {

/// Small files that use what the readers know: where fuzzing and damage tests start from.
struct Seed {
  std::string name;  ///< with the extension of its format
  std::string bytes;
};

[[nodiscard]] inline std::vector<Seed> obj_seeds() {
  return {{"triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
          {"all.obj",
           "# comment\nmtllib none.mtl\nv 0 0 0 1 .5 .5\nv 1e0 0 0\nv 1 1. 0\nv -.0 1 +0\nvt 0 0\n"
           "vn 0 0 1\no deck\nusemtl red\nf 1/1/1 2//1 3/1 4\ng plate one\nf -4 -3 -2 \\\n-1\r\n"
           "s off\nl 1 2 3\nusemtl blue\nf 1 3 4 # end\no\ng deck\nf 4 3 2 1\n"},
          {"polygon.obj",
           "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nv 2 2 1\nf 1 2 3 4 5\nf 1 3 2 4 6 5\n"}};
}

[[nodiscard]] inline std::vector<Seed> stl_seeds() {
  const std::vector<float> facet{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5F};
  const std::string record = bytes_of(facet) + std::string(2, '\0');
  std::string header = "solid or not";
  header.resize(80, ' ');
  return {
      {"binary.stl", header + bytes_of(std::vector<std::uint32_t>{2}) + record + record},
      {"text.stl",
       "solid one\n facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1.5e0 0 0\n"
       " vertex 0 1 -2\n endloop\n endfacet\nendsolid one\nSOLID\nFACET NORMAL 0 0 1\nOUTER LOOP\n"
       "VERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\nENDSOLID\n"}};
}

[[nodiscard]] inline std::vector<Seed> ply_seeds() {
  const std::string head =
      " 1.0\ncomment x\nelement vertex 4\nproperty float x\nproperty double y\nproperty float z\n"
      "property uchar red\nelement face 2\nproperty list uchar int vertex_indices\n"
      "property float quality\nelement edge 1\nproperty int vertex1\nproperty int vertex2\n"
      "end_header\n";
  std::string little, big;
  const auto put = [&](const auto& numbers) {
    const std::string bytes = bytes_of(numbers);
    little += bytes;
    const std::size_t each = sizeof(numbers[0]);
    for (std::size_t i = 0; i < bytes.size(); i += each)
      big += std::string(bytes.rend() - static_cast<std::ptrdiff_t>(i + each),
                         bytes.rend() - static_cast<std::ptrdiff_t>(i));
  };
  for (int i = 0; i < 4; ++i) {
    put(std::vector<float>{i == 1 || i == 2 ? 1.F : 0.F});
    put(std::vector<double>{i > 1 ? 1.0 : 0.0});
    put(std::vector<float>{0.5F});
    put(std::vector<std::uint8_t>{7});
  }
  for (const std::vector<std::int32_t>& face :
       {std::vector<std::int32_t>{0, 1, 2, 3}, std::vector<std::int32_t>{3, 1, 0}}) {
    put(std::vector<std::uint8_t>{static_cast<std::uint8_t>(face.size())});
    put(face);
    put(std::vector<float>{0.25F});
  }
  put(std::vector<std::int32_t>{0, 2});
  return {
      {"text.ply", "ply\nformat ascii" + head +
                       "0 0 .5 7\n1 0 .5 7\n1 1 .5 7\n0 1 .5 7\n4 0 1 2 3 .25\n3 3 1 0 .25\n0 2"},
      {"little.ply", "ply\nformat binary_little_endian" + head + little},
      {"big.ply", "ply\nformat binary_big_endian" + head + big}};
}

/// A document that names everything the reader looks at: instances, sparse and quantised
/// accessors, strides, materials, extras, lines, a data: URI.
[[nodiscard]] inline std::string rich_gltf() {
  return R"({"asset":{"version":"2.0","extras":{"unit_mm":1,"up_axis":"z"}},"scene":0,)"
         R"("extensionsUsed":["EXT_mesh_gpu_instancing"],"scenes":[{"nodes":[0,3]}],)"
         R"("buffers":[{"byteLength":36,"uri":"data:;base64,)"
         R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteLength":36,"byteStride":12},)"
         R"({"buffer":0,"byteLength":6}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5122,"normalized":true,"count":3,"type":"VEC3"},)"
         R"({"bufferView":2,"componentType":5121,"count":6,"type":"SCALAR"},)"
         R"({"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,"indices":)"
         R"({"bufferView":2,"componentType":5121},"values":{"bufferView":0}}}],)"
         R"("materials":[{"alphaMode":"BLEND","pbrMetallicRoughness":)"
         R"({"baseColorFactor":[1,0.5,0,0.5]}}],)"
         R"("meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0},"material":0},)"
         R"({"attributes":{"POSITION":3},"mode":5},{"attributes":{"POSITION":1},"mode":1,"indices":2}]},)"
         R"({"primitives":[{"attributes":{"POSITION":0},"indices":2,"mode":6}]}],)"
         R"("nodes":[{"name":"a\u00e4","children":[1,2],"translation":[1,2,3]},)"
         R"({"mesh":0,"rotation":[0,0,0,1],"scale":[1,2,3],"extras":{"id":"x","k":{"v":[1]}}},)"
         R"({"mesh":1,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1],"extras":[1,[2],{}]},)"
         R"({"mesh":1,"extras":{"instances":["p",{"id":"q"},"r"]},"extensions":)"
         R"({"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0,"SCALE":0}}}}]})";
}

/// A neutral scene with a mesh of doubles and faces, a chain, a primitive, a group, an object of
/// two bodies and one of none.
[[nodiscard]] inline std::string neutral_glb() {
  const std::string binary = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0}) +
                             bytes_of(std::vector<std::uint16_t>{0, 1, 2, 0}) +
                             bytes_of(std::vector<std::uint32_t>{7, 0, 3}) +
                             bytes_of(std::vector<double>{0.1, 0, 0, 1, 0, 0, 0, 2, 0});
  return glb(
      R"({"asset":{"version":"2.0","extras":{"strake":{"scene":1,"ends_early":true,"diagnostics":)"
      R"([["note","a-b","text","where"]],"more":[["a-b",2]]}}},"buffers":[{"byteLength":128}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6},)"
      R"({"buffer":0,"byteOffset":56,"byteLength":72},{"buffer":0,"byteOffset":44,"byteLength":4},)"
      R"({"buffer":0,"byteOffset":48,"byteLength":8}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],"materials":[{}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}],)"
      R"("extras":{"strake":{"shape":0,"positions":2,"faces":3,"sag_mm":0.5}}},)"
      R"({"primitives":[{"attributes":{"POSITION":0}}],"extras":{"strake":{"shape":1,"chains":4}}},)"
      R"({"extras":{"strake":{"shape":2,"primitive":{"kind":"cylinder","lengths":[5,20]}}}}],)"
      R"("nodes":[{"children":[1],"matrix":[0.001,0,0,0,0,0,-0.001,0,0,0.001,0,0,0,0,0,1],)"
      R"("extras":{"strake":{"is":"frame"}}},{"name":"g","children":[2,3,6],"extras":{"attributes":)"
      R"({"k":"v"},"strake":{"is":"group","attributes":[["k","v"],["k","w"]]}}},)"
      R"({"name":"a","mesh":0,"translation":[1,2,3],"extras":{"id":"a","attributes":{"n":"1"},)"
      R"("strake":{"is":"object","precision_um":0.5,"positional_id":true}}},)"
      R"({"name":"b","children":[4,5],"extras":{"id":"b","strake":{"is":"object"}}},)"
      R"({"mesh":1,"extras":{"strake":{"is":"body"}}},)"
      R"({"mesh":2,"extras":{"strake":{"is":"body","category":"insulation"}}},)"
      R"({"name":"c","extras":{"id":"c","strake":{"is":"object","incomplete":true}}}]})",
      binary);
}

[[nodiscard]] inline std::vector<Seed> gltf_seeds() {
  return {{"rich.gltf", rich_gltf()},
          {"rich.glb", glb(rich_gltf())},
          {"neutral.glb", neutral_glb()},
          {"triangle.glb", triangle_glb(R"("nodes":[{"mesh":0,"name":"t"}])")}};
}

}  // namespace strake::test
