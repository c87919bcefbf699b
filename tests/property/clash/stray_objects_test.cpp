// SPDX-License-Identifier: Apache-2.0
// A pair's answer is that of the pair: an object far away changes no bit of it, whatever the format
// and however its numbers are written.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "strake/clash/clash.hpp"
#include "support/gltf_files.hpp"
#include "support/io_files.hpp"
#include "support/io_models.hpp"
#include "support/rvm_writer.hpp"

namespace strake::clash {
namespace {

using geometry::Vec3d;

/// A cube by its lowest corner, mm.
struct Cube {
  Vec3d at;
  double size = 100;
};
using Cubes = std::vector<Cube>;

/// Two cubes that meet, touch, nest or stand apart.
const std::vector<Cubes>& pairs() {
  static const std::vector<Cubes> all{
      {{}, {{99.9, 0, 0}}}, {{}, {{95, 0, 0}}},  {{}, {{100.05, 0, 0}}},   {{}, {{100, 0, 0}}},
      {{}, {{105, 0, 0}}},  {{}, {{150, 0, 0}}}, {{}, {{10, 10, 10}, 80}}, {{}, {{0, 10, 10}, 80}}};
  return all;
}

constexpr std::array kFar{1e6, 1e8, 1e9, 1e11};

struct Format {
  const char* name;
  std::unique_ptr<io::Reader> (*reader)();
  std::string (*write)(const Cubes&);
};

geometry::TriangleMesh mesh_of(const Cube& cube) {
  geometry::TriangleMesh mesh = test::box_mesh(cube.size, cube.size, cube.size);
  for (Vec3d& v : mesh.vertices) v = v + cube.at;
  return mesh;
}

/// `number` writes a coordinate.
template <class Number>
std::string obj_of(const Cubes& cubes, Number&& number) {
  std::string text;
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    const geometry::TriangleMesh mesh = mesh_of(cubes[i]);
    text += fmt::format("o {}\n", i);
    for (const Vec3d& v : mesh.vertices)
      text += fmt::format("v {} {} {}\n", number(v.x), number(v.y), number(v.z));
    for (const auto& t : mesh.triangles)
      text += fmt::format("f {} {} {}\n", 8 * i + t[0] + 1, 8 * i + t[1] + 1, 8 * i + t[2] + 1);
  }
  return text;
}

std::string stl_of(const Cubes& cubes) {
  std::string text;
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    const geometry::TriangleMesh mesh = mesh_of(cubes[i]);
    text += fmt::format("solid {}\n", i);
    for (const auto& t : mesh.triangles) {
      text += "facet normal 0 0 1\nouter loop\n";
      for (const std::uint32_t c : t) {
        const Vec3d& v = mesh.vertices[c];
        text += fmt::format("vertex {:.2f} {:.2f} {:.2f}\n", v.x, v.y, v.z);
      }
      text += "endloop\nendfacet\n";
    }
    text += fmt::format("endsolid {}\n", i);
  }
  return text;
}

/// Every cube a mesh of its own, with its place in the vertices.
std::string glb_of(const Cubes& cubes) {
  std::string buffer, nodes, meshes, accessors, views;
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    const geometry::TriangleMesh mesh = mesh_of(cubes[i]);
    std::vector<float> points;
    std::vector<std::uint32_t> corners;
    for (const Vec3d& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) points.push_back(static_cast<float>(v[k]));
    for (const auto& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
    const char* const comma = i == 0 ? "" : ",";
    views +=
        fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":96}})", comma, buffer.size());
    views += fmt::format(R"(,{{"buffer":0,"byteOffset":{},"byteLength":144}})", buffer.size() + 96);
    buffer += test::bytes_of(points) + test::bytes_of(corners);
    accessors +=
        fmt::format(R"({}{{"bufferView":{},"componentType":5126,"count":8,"type":"VEC3"}})"
                    R"(,{{"bufferView":{},"componentType":5125,"count":36,"type":"SCALAR"}})",
                    comma, 2 * i, 2 * i + 1);
    meshes += fmt::format(R"({}{{"primitives":[{{"attributes":{{"POSITION":{}}},"indices":{}}}]}})",
                          comma, 2 * i, 2 * i + 1);
    nodes += fmt::format(R"({}{{"name":"{}","mesh":{}}})", comma, i, i);
  }
  return test::glb(
      fmt::format(R"({{"asset":{{"version":"2.0","extras":{{"unit_mm":1,"up_axis":"z"}}}},)"
                  R"("buffers":[{{"byteLength":{}}}],"bufferViews":[{}],"accessors":[{}],)"
                  R"("meshes":[{}],"nodes":[{}]}})",
                  buffer.size(), views, accessors, meshes, nodes),
      buffer);
}

/// One mesh at the origin, placed by nodes and scales.
std::string placed_glb_of(const Cubes& cubes) {
  const geometry::TriangleMesh mesh = mesh_of({{}, 1});
  std::vector<float> points;
  std::vector<std::uint32_t> corners;
  for (const Vec3d& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) points.push_back(static_cast<float>(v[k]));
  for (const auto& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  std::string nodes;
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    const auto& [at, size] = cubes[i];
    nodes +=
        fmt::format(R"({}{{"name":"{}","mesh":0,"translation":[{},{},{}],"scale":[{},{},{}]}})",
                    i == 0 ? "" : ",", i, at.x, at.y, at.z, size, size, size);
  }
  return test::glb(
      R"({"asset":{"version":"2.0","extras":{"unit_mm":1,"up_axis":"z"}},)"
      R"("buffers":[{"byteLength":240}],"bufferViews":[{"buffer":0,"byteLength":96},)"
      R"({"buffer":0,"byteOffset":96,"byteLength":144}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5125,"count":36,"type":"SCALAR"}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"nodes":[)" +
          nodes + "]}",
      test::bytes_of(points) + test::bytes_of(corners));
}

std::string text_of(const test::RvmWriter& writer) {
  const auto& bytes = writer.bytes();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Every cube a primitive, or facets, about the origin of its matrix.
std::string rvm_of(const Cubes& cubes, bool facets) {
  test::RvmWriter w;
  w.head().modl();
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    const auto half = static_cast<float>(cubes[i].size / 2);
    const Vec3d center = cubes[i].at + Vec3d{1, 1, 1} * (cubes[i].size / 2);
    const auto metres = [](double mm) { return static_cast<float>(mm / 1000); };
    const auto matrix = test::RvmWriter::at(metres(center.x), metres(center.y), metres(center.z));
    w.cntb(fmt::format("/{}", i));
    if (facets) {
      const geometry::TriangleMesh mesh = mesh_of({Vec3d{-1, -1, -1} * half, 2.0 * half});
      std::vector<test::RvmWriter::FacetPolygon> polygons;
      for (const auto& t : mesh.triangles) {
        test::RvmWriter::Contour contour;
        for (const std::uint32_t c : t) {
          const Vec3d& v = mesh.vertices[c];
          contour.push_back(
              {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
        }
        polygons.push_back({contour});
      }
      w.facets(polygons, matrix);
    } else {
      w.prim(2, {2 * half, 2 * half, 2 * half}, matrix);
    }
    w.cnte();
  }
  return text_of(w.finish());
}

const Format kFormats[] = {
    {"GLB, vertices", io::make_gltf_reader, glb_of},
    {"GLB, nodes", io::make_gltf_reader, placed_glb_of},
    {"RVM, boxes", io::make_rvm_reader, [](const Cubes& cubes) { return rvm_of(cubes, false); }},
    {"RVM, facets", io::make_rvm_reader, [](const Cubes& cubes) { return rvm_of(cubes, true); }},
    {"STL", io::make_stl_reader, stl_of},
    {"OBJ, fixed", io::make_obj_reader,
     [](const Cubes& cubes) {
       return obj_of(cubes, [](double x) { return fmt::format("{:.2f}", x); });
     }},
    {"OBJ, six digits", io::make_obj_reader,
     [](const Cubes& cubes) {
       return obj_of(cubes, [](double x) { return fmt::format("{:g}", x); });
     }},
    {"OBJ, shortest", io::make_obj_reader,
     [](const Cubes& cubes) {
       return obj_of(cubes, [](double x) { return fmt::format("{}", x); });
     }},
};

Report detected(const Format& format, const Cubes& cubes) {
  const std::string bytes = format.write(cubes);
  auto model = test::read_bytes(*format.reader(), bytes, "model");
  EXPECT_TRUE(model) << format.name << (model ? "" : model.error().text());
  if (!model) return {};
  EXPECT_EQ(model->objects.size(), cubes.size());
  model::finish(*model);
  const Options options{.tolerances = {.clearance_mm = 70}};
  const model::Scene scene = make_scene(*model, scene_options(options), {}).value();
  return detect(scene, one_set(scene), options, {}).value();
}

TEST(StrayObjects, ChangeNoBitOfOtherPairs) {
  for (const Format& format : kFormats)
    for (std::size_t p = 0; p < pairs().size(); ++p) {
      const Report alone = detected(format, pairs()[p]);
      ASSERT_EQ(alone.pairs.size(), 1U) << format.name << ", pair " << p;
      for (const double far : kFar) {
        Cubes cubes = pairs()[p];
        cubes.push_back({{far, -far, 0}});
        const Report with = detected(format, cubes);
        EXPECT_EQ(with.hash, alone.hash)
            << format.name << ", pair " << p << ", a stray at " << far << " mm";
      }
    }
}

TEST(StrayObjects, LeaveRelationsAsTheyAre) {
  const std::array<Relation, 8> expected{
      Relation::interfere, Relation::interfere, Relation::separate, Relation::abut_outside,
      Relation::separate,  Relation::separate,  Relation::b_in_a,   Relation::abut_inside};
  for (const Format& format : kFormats)
    for (std::size_t p = 0; p < pairs().size(); ++p) {
      Cubes cubes = pairs()[p];
      cubes.push_back({{1e9, 0, 0}});
      const Report report = detected(format, cubes);
      ASSERT_EQ(report.pairs.size(), 1U) << format.name << ", pair " << p;
      EXPECT_EQ(report.pairs[0].relation, expected[p]) << format.name << ", pair " << p;
    }
}

TEST(StrayObjects, MayBeTheFirstOrTheLast) {
  for (const Format& format : kFormats) {
    const Report last = detected(format, {{}, {{99.9, 0, 0}}, {{1e9, 0, 0}}});
    const Report first = detected(format, {{{1e9, 0, 0}}, {}, {{99.9, 0, 0}}});
    ASSERT_EQ(first.pairs.size(), 1U) << format.name;
    ASSERT_EQ(last.pairs.size(), 1U) << format.name;
    EXPECT_EQ(first.pairs[0].relation, last.pairs[0].relation) << format.name;
    EXPECT_EQ(first.pairs[0].d_mm, last.pairs[0].d_mm) << format.name;
    EXPECT_EQ(first.pairs[0].d_lower_mm, last.pairs[0].d_lower_mm) << format.name;
    EXPECT_EQ(first.pairs[0].d_upper_mm, last.pairs[0].d_upper_mm) << format.name;
  }
}

// What the numbers of the two cannot carry themselves still counts as touching.
TEST(StrayObjects, AreNotThePairItself) {
  const Report far = detected(kFormats[0], {{{1e9, 0, 0}}, {{1e9 + 192, 0, 0}}, {}});
  ASSERT_EQ(far.pairs.size(), 1U);
  EXPECT_EQ(far.pairs[0].relation, Relation::abut_outside);
  EXPECT_EQ(far.contact_distance_mm, 128) << "two steps of float32 at 1e9";
}

}  // namespace
}  // namespace strake::clash
