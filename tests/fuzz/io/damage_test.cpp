// SPDX-License-Identifier: Apache-2.0
// Small files cut off at every byte, with every byte changed, and with numbers replaced by hostile
// ones: every answer must be a sound model or an error, under the sanitizers too.
#include "fuzz/damage.hpp"

#include <gtest/gtest.h>

#include <string>

#include "fuzz_reader.hpp"
#include "support/io_seeds.hpp"

namespace strake::io {
namespace {

void feed(const Reader& reader, const std::string& name, const std::string& bytes) {
  test::feed(reader, name.c_str(), reinterpret_cast<const std::uint8_t*>(bytes.data()),
             bytes.size());
}

void damage(const Reader& reader, const std::vector<test::Seed>& seeds) {
  for (const test::Seed& seed : seeds) {
    const auto feed_it = [&](const std::string& bytes) { feed(reader, seed.name, bytes); };
    test::truncate_everywhere(seed, feed_it);
    test::flip_everywhere(seed, feed_it);
    test::replace_numbers(seed, feed_it);
  }
  test::splice(seeds, 3000,
               [&](const std::string& bytes) { feed(reader, seeds.front().name, bytes); });
}

TEST(Damage, ObjReaderSurvives) { damage(*make_obj_reader(), test::obj_seeds()); }
TEST(Damage, StlReaderSurvives) { damage(*make_stl_reader(), test::stl_seeds()); }
TEST(Damage, PlyReaderSurvives) { damage(*make_ply_reader(), test::ply_seeds()); }
TEST(Damage, GltfReaderSurvives) { damage(*make_gltf_reader(), test::gltf_seeds()); }

TEST(Damage, ReadersSurviveEachOthersFiles) {
  for (const auto& reader : all_readers())
    for (const auto& seeds :
         {test::obj_seeds(), test::stl_seeds(), test::ply_seeds(), test::gltf_seeds()})
      for (const test::Seed& seed : seeds) feed(*reader, seed.name, seed.bytes);
}

TEST(Damage, SeedsAreSound) {
  const auto check = [](const Reader& reader, const std::vector<test::Seed>& seeds) {
    for (const test::Seed& seed : seeds) {
      const auto model = reader.read({seed.name, std::as_bytes(std::span(seed.bytes))}, {}, {});
      EXPECT_TRUE(model) << seed.name << ": " << (model ? "" : model.error().text());
      if (!model) continue;
      EXPECT_EQ(model->diagnostics.skipped(), 0U) << seed.name;
    }
  };
  check(*make_obj_reader(), test::obj_seeds());
  check(*make_stl_reader(), test::stl_seeds());
  check(*make_ply_reader(), test::ply_seeds());
  check(*make_gltf_reader(), test::gltf_seeds());
}

}  // namespace
}  // namespace strake::io
