// SPDX-License-Identifier: Apache-2.0
// write_seeds FOLDER: the seed files of each format into FOLDER/obj, FOLDER/stl, FOLDER/gltf.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "support/io_seeds.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: write_seeds FOLDER\n"), 2;
  const auto write = [&](const char* format, const std::vector<strake::test::Seed>& seeds) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / format;
    std::filesystem::create_directories(folder);
    for (const strake::test::Seed& seed : seeds)
      std::ofstream(folder / seed.name, std::ios::binary) << seed.bytes;
  };
  write("obj", strake::test::obj_seeds());
  write("stl", strake::test::stl_seeds());
  write("gltf", strake::test::gltf_seeds());
  return 0;
}
