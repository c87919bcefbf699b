// SPDX-License-Identifier: Apache-2.0
// A section has the geometry of its objects, to the last bit, however its meshes are packed; what
// is damaged is reported.
#include "tiles/kept/section.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "strake/generate/ship.hpp"
#include "strake/parallel/team.hpp"
#include "support/equal_models.hpp"
#include "support/io_files.hpp"
#include "tiles/kept/blob_file.hpp"

namespace strake::tiles {
namespace {

/// A ship in which primitives, shared meshes and meshes like no other stand beside each other.
model::Model ship() {
  return generate::generate_ship({.objects = 600, .seed = 5, .kind = generate::ShipKind::unlike},
                                 {})
      .value()
      .model;
}

/// Every third object.
std::vector<std::uint32_t> some_of(const model::Model& model) {
  std::vector<std::uint32_t> objects;
  for (std::uint32_t o = 1; o < model.objects.size(); o += 3) objects.push_back(o);
  return objects;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Compares objects of a model with those from `first` on of another.
void expect_same(const model::Model& model, const std::vector<std::uint32_t>& objects,
                 const model::Model& read, std::size_t first) {
  ASSERT_EQ(read.objects.size(), first + objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const model::Object& x = model.objects[objects[i]];
    const model::Object& y = read.objects[first + i];
    ASSERT_EQ(x.id, y.id);
    ASSERT_EQ(x.body_count, y.body_count);
    for (std::uint32_t b = 0; b < x.body_count; ++b) {
      const model::Body& body = model.bodies[x.first_body + b];
      model::Body other = read.bodies[y.first_body + b];
      EXPECT_TRUE(
          test::same_shape(model.shapes[index(body.shape)], read.shapes[index(other.shape)]))
          << x.id;
      other.shape = body.shape;
      EXPECT_TRUE(test::same_body(body, other)) << x.id;
    }
  }
}

TEST(Section, has_the_geometry_of_its_objects) {
  const model::Model model = ship();
  const std::vector<std::uint32_t> objects = some_of(model);
  const test::TemporaryFolder folder;
  std::size_t smaller = 0;
  for (const std::uint64_t bytes_of_pack : {kBytesOfPack, std::uint64_t{4000}, std::uint64_t{1}}) {
    const auto file = folder.path() / "a.section";
    const Section section = write_section(file, model, objects, {}, bytes_of_pack).value();
    const std::string bytes = bytes_of(file);
    EXPECT_GT(bytes.size(), smaller);  // more packs take more
    smaller = bytes.size();
    for (const unsigned workers : {2U, 3U, 8U}) {
      parallel::Team team(workers);
      const auto other = folder.path() / "b.section";
      const auto by_team =
          write_section(other, model, objects, {.team = &team}, bytes_of_pack).value();
      EXPECT_EQ(by_team.hash, section.hash);
      EXPECT_EQ(bytes_of(other), bytes);
    }
    model::Model read;
    ASSERT_TRUE(append_section(file, section, read, {}));
    expect_same(model, objects, read, 0);
    // A second one goes behind the first.
    ASSERT_TRUE(append_section(file, section, read, {}));
    expect_same(model, objects, read, objects.size());
  }
}

TEST(Section, reports_what_is_damaged) {
  const model::Model model = ship();
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "a.section";
  const Section section = write_section(file, model, some_of(model), {}, 4000).value();
  const std::string bytes = bytes_of(file);
  const auto reported = [&](const std::string& content) {
    std::ofstream(file, std::ios::binary) << content;
    model::Model read;
    const Status status = append_section(file, section, read, {});
    return status ? std::string() : status.error().message;
  };
  EXPECT_EQ(reported(bytes), "");
  for (std::size_t at = 0; at < bytes.size(); at += bytes.size() / 97) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x40);
    EXPECT_EQ(reported(damaged), kLost) << at;
    EXPECT_EQ(reported(bytes.substr(0, at)), kLost) << at;
  }
}

}  // namespace
}  // namespace strake::tiles
