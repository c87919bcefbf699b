// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <stop_token>

#include "support/io_files.hpp"

namespace strake::io {
namespace {

using geometry::Polylines;
using geometry::TriangleMesh;
using geometry::Vec3d;

Result<model::Model> read_obj(std::string_view text, const ReadOptions& options = {},
                              const std::filesystem::path& path = "some/model.obj") {
  return test::read_bytes(*make_obj_reader(), text, path, options);
}

model::Model read_obj_ok(std::string_view text, const ReadOptions& options = {}) {
  Result<model::Model> result = read_obj(text, options);
  EXPECT_TRUE(result) << (result ? "" : result.error().text());
  return result ? std::move(*result) : model::Model{};
}

const TriangleMesh& mesh_of(const model::Model& model, std::size_t object, std::size_t body = 0) {
  const model::Body& placed = model.bodies.at(model.objects.at(object).first_body + body);
  return std::get<TriangleMesh>(model.shapes.at(model::index(placed.shape)));
}

constexpr std::string_view kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ObjReader, ReadsOneTriangleAsAnObjectNamedAfterTheFile) {
  const model::Model model = read_obj_ok(std::string(kTriangle) + "f 1 2 3\n");
  ASSERT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(model.objects[0].name, "model");
  EXPECT_EQ(model.objects[0].id, "model");
  EXPECT_EQ(model.files[0].label, "model.obj");
  EXPECT_EQ(model.files[0].format, "OBJ");
  EXPECT_EQ(model.files[0].unit, "mm (assumed)");
  EXPECT_EQ(model.files[0].up_axis, "z");
  const TriangleMesh& mesh = mesh_of(model, 0);
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<geometry::Triangle>{{0, 1, 2}}));
  EXPECT_TRUE(mesh.faces.empty());
}

TEST(ObjReader, ReadsCornersWithTextureAndNormal) {
  const model::Model model = read_obj_ok(
      "v 0 0 0 1 0.5 0.5\r\nv 1 0 0\r\nv 0 1 0\r\nvt 0 0\nvn 0 0 1\n"
      "f 1 2 3\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\nf -3 -2 -1\r\n"
      "\tf  -3/-1/-1\t-2/-1/-1 -1/-1/-1 # a comment\n");
  ASSERT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(mesh_of(model, 0).triangles.size(), 6U);
  for (const auto& t : mesh_of(model, 0).triangles) EXPECT_EQ(t, (geometry::Triangle{0, 1, 2}));
}

/// The mark is no part of the first line: without it all vertices would count one less.
TEST(ObjReader, ReadsWhatIsBehindAByteOrderMark) {
  const model::Model model =
      read_obj_ok("\xEF\xBB\xBF" + std::string(kTriangle) + "v 5 5 5\nf 1 2 3\n");
  ASSERT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(mesh_of(model, 0).vertices, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));

  const test::TemporaryFolder folder;
  (void)folder.write("c.mtl", "\xEF\xBB\xBFnewmtl red\nKd 1 0 0\n");
  const Result<model::Model> named =
      read_obj("\xEF\xBB\xBFmtllib c.mtl\n" + std::string(kTriangle) + "usemtl red\nf 1 2 3\n", {},
               folder.path() / "x.obj");
  ASSERT_TRUE(named);
  EXPECT_EQ(named->bodies[0].color, (model::Color{255, 0, 0, 255}));
}

/// What is not read is missing from its object, not from nowhere.
TEST(ObjReader, ObjectsWithFreeFormGeometryAreIncomplete) {
  const model::Model model = read_obj_ok(std::string(kTriangle) +
                                         "o a\nf 1 2 3\no b\ncstype bspline\nsurf 0 1 0 1 1 2 3\n"
                                         "curv2 1 2\nend\no c\nf 1 2 3\ncurv 0 1 1 2\n");
  ASSERT_EQ(model.objects.size(), 3U);
  EXPECT_FALSE(model.objects[0].incomplete);
  EXPECT_TRUE(model.objects[1].incomplete);
  EXPECT_EQ(model.objects[1].name, "b");
  EXPECT_EQ(model.objects[1].body_count, 0U);
  EXPECT_TRUE(model.objects[2].incomplete);
  EXPECT_EQ(model.objects[2].body_count, 1U);
  EXPECT_EQ(model.diagnostics.count("obj-free-form"), 2U);
  EXPECT_EQ(model.diagnostics.skipped(), 2U);
}

TEST(ObjReader, NamesGroupsUnderObjects) {
  const model::Model model =
      read_obj_ok(std::string(kTriangle) +
                  "f 1 2 3\no Deck 1\nf 1 2 3\ng plate\nf 1 2 3\ng stiffener\n"
                  "f 1 2 3\ng plate\nf 3 2 1\no Deck 2\ng plate\nf 1 2 3\n"
                  "o empty\no tail\ng none\n");
  ASSERT_EQ(model.objects.size(), 5U);
  const auto text = [&](std::size_t i) {
    const model::Object& o = model.objects[i];
    const std::string group =
        o.parent == model::GroupId::none ? "-" : model.groups.at(model::index(o.parent)).name;
    return o.id + "|" + o.name + "|" + group;
  };
  EXPECT_EQ(text(0), "model|model|-");
  EXPECT_EQ(text(1), "Deck 1|Deck 1|-");
  EXPECT_EQ(text(2), "Deck 1/plate|plate|Deck 1");
  EXPECT_EQ(text(3), "Deck 1/stiffener|stiffener|Deck 1");
  EXPECT_EQ(text(4), "Deck 2/plate|plate|Deck 2");
  EXPECT_EQ(mesh_of(model, 2).triangles.size(), 2U) << "a group named again goes on";
}

TEST(ObjReader, TriangulatesPolygonsAndKeepsTheirFaces) {
  const model::Model model =
      read_obj_ok("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 1 0\nv 0 2 0\nf 1 2 3 4 5\nf 1 2 3\n");
  const TriangleMesh& mesh = mesh_of(model, 0);
  ASSERT_EQ(mesh.triangles.size(), 4U);
  EXPECT_EQ(mesh.faces, (std::vector<std::uint32_t>{0, 0, 0, 1}));
  double area = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& t = mesh.triangles[i];
    const Vec3d n =
        cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    EXPECT_GT(n.z, 0) << "no triangle may turn over";
    area += n.z / 2;
  }
  EXPECT_EQ(area, 3.0);
}

TEST(ObjReader, KeepsTheEdgesOfPolygonsThatCrossThemselves) {
  const model::Model model = read_obj_ok("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(mesh_of(model, 0).triangles, (std::vector<geometry::Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(model.diagnostics.count("obj-crossing-face"), 1U);
}

TEST(ObjReader, ReadsPolylines) {
  const model::Model model = read_obj_ok("v 0 0 0\nv 1 0 0\nv 1 1 0\no axis\nl 1 2 3\nl -1 -3\n");
  ASSERT_EQ(model.objects.size(), 1U);
  const auto& lines = std::get<Polylines>(model.shapes.at(0));
  EXPECT_EQ(lines.points,
            (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}, {0, 0, 0}}));
  EXPECT_EQ(lines.first, (std::vector<std::uint32_t>{0, 3, 5}));
}

TEST(ObjReader, JoinsContinuationLines) {
  const model::Model model = read_obj_ok(
      "v 0 0 0\nv 1 \\\n0 0\nv 0 1 \\\r\n 0\nf 1 \\\n 2 \\\n 3\ng late\nf 1 2 9\nf 1 2 3\\");
  ASSERT_EQ(model.objects.size(), 2U);
  EXPECT_EQ(mesh_of(model, 0).vertices.size(), 3U);
  EXPECT_TRUE(model.objects[1].incomplete);
  ASSERT_EQ(model.diagnostics.kept().size(), 1U);
  EXPECT_EQ(model.diagnostics.kept()[0].where, "some/model.obj:10")
      << "lines are counted as in an editor";
}

TEST(ObjReader, AppliesUnitAndUpAxis) {
  ReadOptions options;
  options.unit_mm = 1000;
  options.up_axis = UpAxis::y;
  const model::Model model = read_obj_ok("v 1 2 3\nv 0 0 0\nv 1 0 0\nf 1 2 3\n", options);
  EXPECT_EQ(mesh_of(model, 0).vertices[0], (Vec3d{1000, -3000, 2000}));
  EXPECT_EQ(model.files[0].unit, "m (given)");
  EXPECT_EQ(model.files[0].up_axis, "y");
  options.up_axis = UpAxis::x;
  EXPECT_EQ(mesh_of(read_obj_ok("v 1 2 3\nv 0 0 0\nv 1 0 0\nf 1 2 3\n", options), 0).vertices[0],
            (Vec3d{2000, 3000, 1000}));
}

TEST(ObjReader, NamesTheUnitThatTheUserGives) {
  const auto reported = [](double unit_mm) {
    ReadOptions options;
    options.unit_mm = unit_mm;
    return read_obj_ok("v 1 2 3\nv 0 0 0\nv 1 0 0\nf 1 2 3\n", options).files[0].unit;
  };
  EXPECT_EQ(reported(100), "dm (given)");
  EXPECT_EQ(reported(1e6), "km (given)");
  EXPECT_EQ(reported(914.4), "914.4 mm (given)");
}

TEST(ObjReader, TakesColoursFromTheLibraryBesideIt) {
  const test::TemporaryFolder folder;
  (void)folder.write("my colours.mtl", "newmtl steel\nKd 1 0.5 0\nnewmtl glass\nKd 0 0 1\nd 0.5\n");
  const std::string text = "mtllib my colours.mtl\n" + std::string(kTriangle) +
                           "o a\nusemtl steel\nf 1 2 3\nf 3 2 1\nusemtl glass\nf 1 2 3\n"
                           "o b\nusemtl unknown\nf 1 2 3\n";
  const Result<model::Model> model = read_obj(text, {}, folder.path() / "x.obj");
  ASSERT_TRUE(model);
  ASSERT_EQ(model->objects.size(), 2U);
  EXPECT_EQ(model->objects[0].body_count, 2U) << "opaque and transparent faces apart";
  EXPECT_EQ(model->bodies[0].color, (model::Color{255, 128, 0, 255}));
  EXPECT_EQ(mesh_of(*model, 0, 0).triangles.size(), 2U);
  EXPECT_EQ(model->bodies[1].color, (model::Color{0, 0, 255, 128}));
  EXPECT_EQ(model->bodies[2].color, model::Color{});
}

/// A tetrahedron with a face of glass, and beside it what is closed or open by itself.
TEST(ObjReader, KeepsASolidWithATransparentFaceInOnePiece) {
  const test::TemporaryFolder folder;
  (void)folder.write("c.mtl", "newmtl steel\nnewmtl glass\nd 0.5\n");
  const std::string corners = "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const std::string walls = "usemtl steel\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const auto read_it = [&](const std::string& text) {
    Result<model::Model> model = read_obj(corners + text, {}, folder.path() / "x.obj");
    EXPECT_TRUE(model);
    return model ? std::move(*model) : model::Model{};
  };
  const model::Model tank = read_it(walls + "usemtl glass\nf 1 3 2\n");
  ASSERT_EQ(tank.bodies.size(), 1U);
  EXPECT_EQ(mesh_of(tank, 0).triangles.size(), 4U);
  EXPECT_EQ(mesh_of(tank, 0).vertices.size(), 7U);
  EXPECT_EQ(tank.bodies[0].color.alpha, 255);
  EXPECT_EQ(tank.diagnostics.count("mesh-part-transparent"), 1U);

  // The corners of the glass stand in the file once more.
  const model::Model soup = read_it(walls + "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl glass\nf 5 7 6\n");
  EXPECT_EQ(soup.bodies.size(), 1U);

  const model::Model pane =
      read_it(walls + "f 1 3 2\nusemtl glass\nf 1 2 3\nf 1 3 2\nf 1 2 3\nf 1 3 2\n");
  EXPECT_EQ(pane.bodies.size(), 2U) << "each closes by itself";
  EXPECT_EQ(read_it(walls + "usemtl glass\nf 1 2 3\n").bodies.size(), 2U) << "wound otherwise";

  // A second pane, far from the tank, stays transparent with its own corners.
  const model::Model two =
      read_it(walls + "v 5 0 0\nv 6 0 0\nv 5 1 0\nusemtl glass\nf 1 3 2\nf 5 6 7\n");
  ASSERT_EQ(two.bodies.size(), 2U);
  EXPECT_EQ(mesh_of(two, 0).triangles.size(), 4U);
  EXPECT_EQ(mesh_of(two, 0, 1).triangles.size(), 1U);
  EXPECT_EQ(mesh_of(two, 0, 1).vertices.size(), 3U);
  EXPECT_EQ(two.bodies[1].color.alpha, 128);
}

/// Edges between pieces of one face stay hidden whichever mesh the face comes to.
TEST(ObjReader, KeepsTheFacesOfASolidWithATransparentFace) {
  const test::TemporaryFolder folder;
  (void)folder.write("c.mtl", "newmtl steel\nnewmtl glass\nd 0.5\n");
  const Result<model::Model> model = read_obj(
      "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\n"
      "v 1 1 1\nusemtl steel\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"
      "usemtl glass\nf 1 3 4 2\n",
      {}, folder.path() / "x.obj");
  ASSERT_TRUE(model);
  ASSERT_EQ(model->bodies.size(), 1U);
  EXPECT_EQ(mesh_of(*model, 0).faces,
            (std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}));
}

TEST(ObjReader, KeepsASolidOfTwoOpaqueColoursInOnePiece) {
  const test::TemporaryFolder folder;
  (void)folder.write("c.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const std::string text =
      "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red\nf 1 3 2\n"
      "usemtl blue\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const Result<model::Model> model = read_obj(text, {}, folder.path() / "x.obj");
  ASSERT_TRUE(model);
  ASSERT_EQ(model->bodies.size(), 1U);
  EXPECT_EQ(mesh_of(*model, 0).triangles.size(), 4U);
  EXPECT_EQ(model->bodies[0].color, (model::Color{0, 0, 255, 255})) << "of most faces";
}

TEST(ObjReader, ReadsNoLibraryFromElsewhere) {
  const Result<model::Model> model =
      read_obj("mtllib ../../etc/passwd\n" + std::string(kTriangle) + "f 1 2 3\n");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->diagnostics.count("obj-material-library-refused"), 1U);
}

TEST(ObjReader, SkipsDamagedObjectsAndStatesWhere) {
  const model::Model model = read_obj_ok(
      std::string(kTriangle) +
      "v nan 0 0\nv 1 2\no good\nf 1 2 3\no range\nl 1 6\nf 1 2 6\n"
      "o back\nf -6 -2 -3\no word\nf 1 2 x\no zero\nf 0 1 2\no nan\nf 1 2 4\no short\nf 1 2 5\n"
      "o huge\nf 1 2 99999999999999999999999\no fine\nf 3 2 1\nf 1 2\nl 1\n");
  // What is skipped is listed all the same, without bodies.
  std::vector<std::string> whole, skipped;
  for (const model::Object& object : model.objects) {
    EXPECT_EQ(object.incomplete, object.body_count == 0) << object.name;
    (object.incomplete ? skipped : whole).push_back(object.id);
  }
  EXPECT_EQ(whole, (std::vector<std::string>{"good", "fine"}));
  EXPECT_EQ(skipped,
            (std::vector<std::string>{"range", "back", "word", "zero", "nan", "short", "huge"}));
  EXPECT_EQ(model.diagnostics.count("obj-damaged-object"), 7U);
  EXPECT_EQ(model.diagnostics.skipped(), 7U);
  EXPECT_EQ(model.diagnostics.count("obj-bad-vertex"), 2U);
  EXPECT_EQ(model.diagnostics.count("obj-short-face"), 1U);
  EXPECT_EQ(model.diagnostics.count("obj-short-line"), 1U);
  std::vector<std::string> places;
  for (const Diagnostic& d : model.diagnostics.kept())
    if (d.code == "obj-damaged-object") places.push_back(d.where);
  EXPECT_EQ(places,
            (std::vector<std::string>{"some/model.obj:10", "some/model.obj:12", "some/model.obj:14",
                                      "some/model.obj:16", "some/model.obj:18", "some/model.obj:20",
                                      "some/model.obj:22"}));
}

TEST(ObjReader, KeepsAnObjectWithoutTheFacesThatCannotBeRead) {
  const model::Model model = read_obj_ok(
      std::string(kTriangle) +
      "v nan 0 0\nv 9 9 9\no part\nf 1 2 3\nf 3 4 5\nf 1 2 x\nf 2 1 77\nf 3 2 1\nl 1 2\nl 2 4 3\n"
      "o whole\nf 1 2 3\no one\nf 1 2 3\nf 1 2 4\n");
  ASSERT_EQ(model.objects.size(), 3U);
  EXPECT_TRUE(model.objects[0].incomplete);
  EXPECT_FALSE(model.objects[1].incomplete);
  EXPECT_TRUE(model.objects[2].incomplete);
  EXPECT_EQ(model.objects[0].body_count, 2U);
  // What only bad faces use is not in it.
  EXPECT_EQ(mesh_of(model, 0).vertices, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh_of(model, 0).triangles, (std::vector<geometry::Triangle>{{0, 1, 2}, {2, 1, 0}}));
  EXPECT_EQ(std::get<Polylines>(model.shapes.at(1)).first, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(mesh_of(model, 2).triangles.size(), 1U);
  EXPECT_EQ(model.diagnostics.count("mesh-face-left-out"), 2U);
  EXPECT_EQ(model.diagnostics.skipped(), 2U);
  std::vector<Diagnostic> reported;
  for (const Diagnostic& d : model.diagnostics.kept())
    if (d.code == "mesh-face-left-out") reported.push_back(d);
  ASSERT_EQ(reported.size(), 2U);
  EXPECT_EQ(reported[0].message,
            "object 'part' is kept without 3 faces and 1 line: one uses vertex 4, which has no "
            "readable place");
  EXPECT_EQ(reported[0].where, "some/model.obj:8");
  EXPECT_EQ(reported[1].message,
            "object 'one' is kept without 1 face: one uses vertex 4, which has no readable place");
}

TEST(ObjReader, RefusesFilesWithNothingInThem) {
  const Result<model::Model> no_faces = read_obj(kTriangle);
  ASSERT_FALSE(no_faces);
  EXPECT_EQ(no_faces.error().code, ErrorCode::input);
  EXPECT_EQ(no_faces.error().where, "some/model.obj");
  const Result<model::Model> all_bad = read_obj(std::string(kTriangle) + "f 1 2 7\n");
  ASSERT_FALSE(all_bad);
  EXPECT_EQ(all_bad.error().where, "some/model.obj:4");
}

TEST(ObjReader, CountsBackAcrossChunks) {
  // Several chunks of 1 MiB: every face refers back to the vertices just before it, and a group
  // goes on over a chunk's end.
  std::string text = "o first\n";
  const int count = 60000;
  for (int i = 0; i < count; ++i) {
    if (i == count / 2) text += "o second\n";
    text += fmt::format("v {} 0 0\nv {} 1 0.123456\nv {} 0 1\nf -3 -2 -1\n", i, i, i);
  }
  ASSERT_GT(text.size(), 2U << 20U);
  const model::Model model = read_obj_ok(text);
  ASSERT_EQ(model.objects.size(), 2U);
  constexpr std::size_t kHalf = count / 2;
  for (std::size_t object = 0; object < 2; ++object) {
    const TriangleMesh& mesh = mesh_of(model, object);
    ASSERT_EQ(mesh.triangles.size(), kHalf);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const double x = static_cast<double>(i + object * kHalf);
      const auto& t = mesh.triangles[i];
      ASSERT_EQ(mesh.vertices[t[0]], (Vec3d{x, 0, 0}));
      ASSERT_EQ(mesh.vertices[t[1]], (Vec3d{x, 1, 0.123456}));
      ASSERT_EQ(mesh.vertices[t[2]], (Vec3d{x, 0, 1}));
    }
  }
}

TEST(ObjReader, FindsVerticesOfObjectsThatShareThemWidely) {
  // Object "sparse" uses the first and the last of many vertices: a table over its range would be
  // thousands of times its size.
  std::string text;
  for (int i = 0; i < 5000; ++i) text += fmt::format("v {} {} 0\n", i, i % 7);
  text += "o sparse\nf 1 2500 5000\nf 5000 2500 1\no dense\nf 1 2 3\n";
  const model::Model model = read_obj_ok(text);
  ASSERT_EQ(model.objects.size(), 2U);
  EXPECT_EQ(mesh_of(model, 0).vertices,
            (std::vector<Vec3d>{{0, 0, 0}, {2499, 0, 0}, {4999, 1, 0}}));
  EXPECT_EQ(mesh_of(model, 0).triangles[1], (geometry::Triangle{2, 1, 0}));
}

TEST(ObjReader, StatesThePrecisionOfItsText) {
  EXPECT_DOUBLE_EQ(
      read_obj_ok("v 12345.678 0 0\nv 1.000 0 0\nv 0 1.000 0\nf 1 2 3\n").files[0].precision_mm,
      0.0005);
}

TEST(ObjReader, StopsWhenRequested) {
  const std::stop_source stop;
  stop.request_stop();
  parallel::Context context;
  context.stop = stop.get_token();
  const Result<model::Model> result = test::read_bytes(
      *make_obj_reader(), std::string(kTriangle) + "f 1 2 3\n", "x.obj", {}, context);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::cancelled);
}

TEST(ObjReader, RecognisesItsContent) {
  const auto sureness = [](std::string_view text, const char* path) {
    return make_obj_reader()->recognise({path, std::as_bytes(std::span(text))});
  };
  EXPECT_GT(sureness("# made by x\nv 0 0 0\nf 1 1 1\n", "a.txt"), 80);
  EXPECT_GT(sureness("v 0 0 0\n", "a.obj"), sureness("v 0 0 0\n", "a.txt"));
  EXPECT_EQ(sureness("solid x\nfacet normal 0 0 1\n", "a.stl"), 0);
  EXPECT_EQ(sureness(std::string_view("v 0\0 0 0\n", 9), "a.obj"), 0);
  EXPECT_LT(sureness("hello world, v is a letter\n", "a.txt"), 10);
}

}  // namespace
}  // namespace strake::io
