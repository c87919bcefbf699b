// SPDX-License-Identifier: Apache-2.0
// write_seeds FOLDER: the seed files of each fuzzer into a folder of its name.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "fuzz/bcf/feed_bcf.hpp"
#include "fuzz/project/feed_project.hpp"
#include "fuzz/report/feed_clash_document.hpp"
#include "support/io_seeds.hpp"
#include "support/rules_seeds.hpp"
#include "support/rvm_writer.hpp"
#include "support/sheet_seeds.hpp"
#include "support/view_documents.hpp"

namespace {

/// A file of each chunk version with primitives of most kinds.
std::vector<strake::test::Seed> rvm_seeds() {
  std::vector<strake::test::Seed> seeds;
  for (std::uint32_t version = 1; version <= 4; ++version) {
    strake::test::RvmWriter w;
    w.head(version > 1 ? 2 : 1).modl().cntb("/A", version, 6, 20);
    w.prim(1, {100, 90, 80, 70, 5, -5, 60}).prim(2, {10, 20, 30}).prim(3, {100, 150, 20, 1.5F});
    w.prim(4, {100, 20, 1.5F}).prim(5, {100, 40}).prim(7, {50, 40, 100, 5, 6, 0.1F, 0, 0, 0});
    w.volume("INSU", 50, 8, {25, 300}).volume("OBST", 0, 9, {80}).prim(10, {5, 100});
    w.facets({{{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}, {{2, 2, 0}, {2, 4, 0}, {4, 4, 0}}}});
    w.cnte(version).colr(6, 1, 2, 3).finish();
    const auto& bytes = w.bytes();
    seeds.push_back({"version" + std::to_string(version) + ".rvm",
                     {reinterpret_cast<const char*>(bytes.data()), bytes.size()}});
  }
  return seeds;
}

}  // namespace

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
  write("ply", strake::test::ply_seeds());
  write("gltf", strake::test::gltf_seeds());
  write("rvm", rvm_seeds());
  write("rules", strake::test::rules_seeds());
  write("sheets", strake::test::sheet_seeds());
  write("clash_document", strake::test::clash_document_seeds());
  write("bcf", strake::test::bcf_seeds());
  write("project", {strake::test::project_seed().file});
  write("view_document", strake::test::view_document_seeds());
  return 0;
}
