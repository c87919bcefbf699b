// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <string_view>
#include <variant>
#include <vector>

#include "strake/io/reader.hpp"
#include "support/rvm_writer.hpp"

namespace strake::io {
namespace {

using geometry::Vec3d;
using test::RvmWriter;

Result<model::Model> read(const std::vector<std::byte>& bytes, const ReadOptions& options = {}) {
  return make_rvm_reader()->read({"test.rvm", bytes}, options, {});
}

Result<model::Model> read(const RvmWriter& writer, const ReadOptions& options = {}) {
  return read(writer.bytes(), options);
}

std::vector<std::byte> from_hex(std::string_view hex) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<std::byte>(digit(hex[i]) * 16 + digit(hex[i + 1])));
  return bytes;
}

/// A cylinder of radius 50 and height 400 along +X round (1, 2, 3) m, in group "/A", material 6.
constexpr std::string_view kCylinderFile =
    "000000480000004500000041000000440000004c000000010000000200000001"
    "7370656300000000000000016e6f7700000000016d65000000000004556e6963"
    "6f6465205554462d380000000000004d0000004f000000440000004c00000078"
    "00000001000000010000000150000000000000012f4d0000000000430000004e"
    "0000005400000042000000ac0000000100000002000000012f410000447a0000"
    "44fa0000453b8000000000060000005000000052000000490000004d0000011c"
    "0000000100000001000000080000000000000000ba83126f000000003a83126f"
    "000000003a83126f00000000000000003f8000004000000040400000c2480000"
    "c2480000c34800004248000042480000434800004248000043c8000000000043"
    "0000004e0000005400000045000001380000000100000002000000450000004e"
    "000000440000003a000001540000000100000001";

TEST(RvmReader, ReadsTheTestVector) {
  const auto bytes = from_hex(kCylinderFile);
  ASSERT_EQ(bytes.size(), 340U);
  EXPECT_EQ(make_rvm_reader()->recognise({"anything", bytes}), 100);
  const auto model = read(bytes);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->files.at(0).format, "RVM 2");
  EXPECT_EQ(model->groups.size(), 1U);
  ASSERT_EQ(model->objects.size(), 1U);
  EXPECT_EQ(model->objects[0].name, "/A");
  EXPECT_EQ(model->objects[0].id, "/A");
  ASSERT_EQ(model->bodies.size(), 1U);
  const auto* cylinder =
      std::get_if<geometry::CylinderPrimitive>(&std::get<geometry::Primitive>(model->shapes.at(0)));
  ASSERT_NE(cylinder, nullptr);
  EXPECT_EQ(cylinder->radius, 50);
  EXPECT_EQ(cylinder->height, 400);
  const geometry::Placement& placement = model->bodies[0].placement;
  EXPECT_EQ(placement * Vec3d(0, 0, 200), Vec3d(1200, 2000, 3000));
  EXPECT_EQ(placement * Vec3d(50, 0, -200), Vec3d(800, 2000, 2950));
  EXPECT_EQ(placement * Vec3d(0, 50, 0), Vec3d(1000, 2050, 3000));
  EXPECT_EQ(model->bodies[0].color, (model::Color{0, 237, 237, 255}));
  EXPECT_TRUE(model->diagnostics.kept().empty());
}

/// All kinds once, each in a group of its own.
RvmWriter all_kinds(std::uint32_t version) {
  RvmWriter w;
  w.head(version >= 2 ? 2 : 1).modl();
  w.cntb("/ALL", version);
  const auto one = [&](std::string_view name, std::uint32_t kind,
                       std::initializer_list<float> parameters) {
    w.cntb(name, version).prim(kind, parameters).cnte(version);
  };
  one("/PYRAMID", 1, {100, 90, 80, 70, 5, -5, 60});
  one("/BOX", 2, {10, 20, 30});
  one("/RTORUS", 3, {100, 150, 20, 1.5F});
  one("/CTORUS", 4, {100, 20, 1.5F});
  one("/EDISH", 5, {100, 40});
  one("/SDISH", 6, {100, 40});
  one("/SNOUT", 7, {50, 40, 100, 5, 6, 0.1F, 0.2F, -0.1F, 0});
  one("/CYLINDER", 8, {25, 300});
  one("/SPHERE", 9, {80});
  one("/LINE", 10, {5, 100});
  w.cntb("/FACETS", version)
      .facets({{{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}}, {{{0, 0, 0}, {0, 10, 0}, {0, 0, 10}}}})
      .cnte(version);
  w.cnte(version).finish();
  return w;
}

TEST(RvmReader, ReadsEveryKindInEveryVersion) {
  for (std::uint32_t version = 1; version <= 4; ++version) {
    const auto model = read(all_kinds(version));
    ASSERT_TRUE(model) << model.error().text();
    EXPECT_EQ(model->groups.size(), 12U) << version;
    EXPECT_EQ(model->objects.size(), 11U) << version;
    EXPECT_EQ(model->shapes.size(), 11U) << version;
    ASSERT_EQ(model->bodies.size(), 11U) << version;
    // The stored box of the dish test is not its own, which is noticed; nothing else is.
    EXPECT_EQ(model->diagnostics.kept().size(), 1U) << version;
    EXPECT_EQ(model->diagnostics.count("rvm-dish-radius"), 1U);
  }
}

}  // namespace
}  // namespace strake::io
