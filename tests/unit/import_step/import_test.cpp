// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <TDF_LabelSequence.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "document.hpp"
#include "scene_model.hpp"
#include "source_file.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"
#include "unit/import_step/step_files.hpp"

namespace strake::import_step {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3d;

/// A folder with the models, which is removed at the end.
class StepImport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Message::DefaultMessenger()->ChangePrinters().Clear();
    fs::create_directories(folder());
    ASSERT_TRUE(write_step_files(folder()));
  }
  static void TearDownTestSuite() { fs::remove_all(folder()); }
  static fs::path folder() { return fs::temp_directory_path() / "strake-step-import-test"; }
  static std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static std::string report() { return text_of(folder() / "report.jsonl"); }

  /// Returns why a file of this text is refused.
  static std::string refusal(const std::string& name, const std::string& text) {
    std::ofstream(folder() / name, std::ios::binary) << text;
    const Import done = import(folder() / name);
    return done.model ? "read" : done.model.error().message;
  }

  struct Import {
    Result<model::Model> model;
    std::string unit;
    double volume = 0, area = 0;  ///< by Open CASCADE, of all instances
  };
  static Import import(const fs::path& file, std::optional<double> sag_mm = {}) {
    Report report(folder() / "report.jsonl");
    const Result<SourceFile> source = inspect_source(file);
    if (!source) return {source.error(), "", 0, 0};
    const Handle(ReportProgress) progress = new ReportProgress(report);
    const Result<Document> document = read_document(file, source->kind, progress);
    if (!document) return {document.error(), "", 0, 0};
    Import result{Error{}, document->unit, 0, 0};
    TDF_LabelSequence roots;
    XCAFDoc_DocumentTool::ShapeTool(document->content->Main())->GetFreeShapes(roots);
    for (const TDF_Label& root : roots) {
      GProp_GProps volume, area;
      BRepGProp::VolumeProperties(XCAFDoc_ShapeTool::GetShape(root), volume, Standard_True);
      BRepGProp::SurfaceProperties(XCAFDoc_ShapeTool::GetShape(root), area);
      result.volume += volume.Mass();
      result.area += area.Mass();
    }
    SceneOptions options;
    options.mesh.sag_mm = sag_mm;
    options.kind = source->kind;
    options.file_name = file.stem().string();
    result.model = make_scene_model(*document, options, report, progress);
    return result;
  }
};

/// The volume within the triangles of all bodies, in mm³.
double volume_of(const model::Model& model) {
  double sum = 0;
  for (const model::Body& body : model.bodies) {
    const auto& mesh = std::get<geometry::TriangleMesh>(model.shapes[index(body.shape)]);
    for (const geometry::Triangle& t : mesh.triangles) {
      const Vec3d a = body.placement * mesh.vertices[t[0]];
      const Vec3d b = body.placement * mesh.vertices[t[1]];
      const Vec3d c = body.placement * mesh.vertices[t[2]];
      sum += dot(a, cross(b, c)) / 6;
    }
  }
  return sum;
}

std::vector<std::string> ids_of(const model::Model& model) {
  std::vector<std::string> ids;
  for (const model::Object& object : model.objects) ids.push_back(object.id);
  std::ranges::sort(ids);
  return ids;
}

const model::Object* find(const model::Model& model, const std::string& id) {
  const auto at = std::ranges::find(model.objects, id, &model::Object::id);
  return at == model.objects.end() ? nullptr : &*at;
}

std::string stated(const model::Model& model, const model::Object& object, const char* name) {
  const model::Model::Stated where = model.stated(object, name);
  if (where.attributes == nullptr) return "";
  const auto at = std::ranges::find(*where.attributes, name, [](const auto& a) { return a.first; });
  return at->second;
}

TEST_F(StepImport, AnAssemblyIsGroupsAndItsPartsShareShapes) {
  const Import done = import(folder() / "rig.step");
  ASSERT_TRUE(done.model) << done.model.error().text();
  const model::Model& model = *done.model;
  EXPECT_EQ(done.unit, "mm");
  EXPECT_EQ(ids_of(model), (std::vector<std::string>{
                               "Rig/Bolt", "Rig/Bolt~2", "Rig/Bolt~3", "Rig/Bolt~4", "Rig/Plate",
                               "Rig/first/Angle", "Rig/first/left", "Rig/first/right",
                               "Rig/second/Angle", "Rig/second/left", "Rig/second/right"}));
  EXPECT_EQ(model.shapes.size(), 3U);
  const model::Object* const left = find(model, "Rig/second/left");
  ASSERT_NE(left, nullptr);
  EXPECT_EQ(model.path(*left), "Rig/second");
  EXPECT_EQ(stated(model, *left, "Product"), "Bolt");
  EXPECT_EQ(stated(model, *left, "Instance"), "left");
  EXPECT_EQ(stated(model, *left, "Assembly"), "second");
  const model::Object* const plate = find(model, "Rig/Plate");
  ASSERT_NE(plate, nullptr);
  EXPECT_EQ(stated(model, *plate, "Layer"), "Structure");
  EXPECT_EQ(model.bodies[plate->first_body].color, (model::Color{255, 0, 0, 255}));
  EXPECT_EQ(model.bodies[left->first_body].color, (model::Color{0, 0, 255, 255}));
  // The middle of the bolt: in its bracket at (5, 5, 20), which is turned about (70, 30).
  const double x = 5 - 70, y = 5 - 30;
  const Vec3d at = model.bodies[left->first_body].placement.translation;
  EXPECT_NEAR(at.x, 70 + x * std::cos(0.5) - y * std::sin(0.5), 1e-9);
  EXPECT_NEAR(at.y, 30 + x * std::sin(0.5) + y * std::cos(0.5), 1e-9);
  EXPECT_NEAR(at.z, 35, 1e-9);
}

TEST_F(StepImport, UnitsChangeNothingButTheirName) {
  const Import mm = import(folder() / "rig.step");
  ASSERT_TRUE(mm.model);
  for (const auto& [file, unit] : {std::pair("rig_inch.step", "in"), {"rig_metre.step", "m"}}) {
    const Import other = import(folder() / file);
    ASSERT_TRUE(other.model) << other.model.error().text();
    EXPECT_EQ(other.unit, unit);
    EXPECT_EQ(ids_of(*other.model), ids_of(*mm.model));
    EXPECT_NEAR(volume_of(*other.model), volume_of(*mm.model), 1e-4 * volume_of(*mm.model));
    for (std::size_t i = 0; i < other.model->bodies.size(); ++i) {
      const Vec3d shift =
          other.model->bodies[i].placement.translation - mm.model->bodies[i].placement.translation;
      EXPECT_LT(std::sqrt(dot(shift, shift)), 1e-6);
    }
  }
}

TEST_F(StepImport, CurvedSolidsAreClosedAndTheirVolumesRight) {
  for (const double sag_mm : {0.5, 0.1, 0.02}) {
    const Import done = import(folder() / "curved.step", sag_mm);
    ASSERT_TRUE(done.model) << done.model.error().text();
    EXPECT_EQ(done.model->objects.size(), 6U);
    EXPECT_EQ(report().find("step-open-solid"), std::string::npos) << report();
    EXPECT_NEAR(volume_of(*done.model), done.volume, sag_mm * done.area);
    // A sag that is not requested would be within the other bound.
    EXPECT_GT(std::abs(volume_of(*done.model) - done.volume), 1e-4 * sag_mm * done.area);
    const Result<model::Scene> scene = model::make_scene(*done.model, {}, {});
    ASSERT_TRUE(scene);
    for (const model::GridShape& shape : scene->shapes)
      for (const geometry::Part& part : shape.parts)
        EXPECT_EQ(part.kind, geometry::PartKind::solid);
  }
}

/// Returns how far the middles of triangles lie within a ball about the origin, at most; nothing
/// where a vertex is not on the ball.
std::optional<double> sag_in_ball(const model::Model& model, const model::Object& object,
                                  double radius) {
  const model::Body& body = model.bodies[object.first_body];
  const auto& mesh = std::get<geometry::TriangleMesh>(model.shapes[index(body.shape)]);
  double largest = 0;
  for (const geometry::Triangle& t : mesh.triangles) {
    Vec3d sum;
    for (const std::uint32_t corner : t) {
      const Vec3d at = body.placement * mesh.vertices[corner];
      if (std::abs(std::sqrt(dot(at, at)) - radius) > 1e-6) return std::nullopt;
      sum = sum + at;
    }
    largest = std::max(largest, radius - std::sqrt(dot(sum, sum)) / 3);
  }
  return largest;
}

TEST_F(StepImport, TrianglesAreAsNearToTheirSurfacesAsTheyState) {
  for (const double sag_mm : {0.5, 0.1, 0.02}) {
    const Import done = import(folder() / "curved.step", sag_mm);
    ASSERT_TRUE(done.model) << done.model.error().text();
    for (const model::Shape& shape : done.model->shapes)
      EXPECT_EQ(std::get<geometry::TriangleMesh>(shape).sag_mm, sag_mm);
    std::size_t balls = 0;
    for (const model::Object& object : done.model->objects)
      if (const auto sag = sag_in_ball(*done.model, object, 20)) {
        EXPECT_LE(*sag, sag_mm);
        ++balls;
      }
    EXPECT_EQ(balls, 1U);
  }
  const Import usual = import(folder() / "curved.step");
  ASSERT_TRUE(usual.model);
  for (const model::Object& object : usual.model->objects)
    if (const auto sag = sag_in_ball(*usual.model, object, 20)) {
      EXPECT_LE(*sag, std::sqrt(3.0) * 40 / 2000 * 1.001);
    }
}

TEST_F(StepImport, TrianglesOfFlatFacesAreTheSurface) {
  const Import rig = import(folder() / "rig.step");
  ASSERT_TRUE(rig.model) << rig.model.error().text();
  const auto sag_of = [&](const char* id) {
    const model::Object* const object = find(*rig.model, id);
    if (object == nullptr) return -1.0;
    const model::ShapeId shape = rig.model->bodies[object->first_body].shape;
    return std::get<geometry::TriangleMesh>(rig.model->shapes[index(shape)]).sag_mm;
  };
  EXPECT_EQ(sag_of("Rig/Plate"), 0);
  EXPECT_EQ(sag_of("Rig/first/Angle"), 0);
  EXPECT_GT(sag_of("Rig/Bolt"), 0);
  EXPECT_LT(sag_of("Rig/Bolt"), 0.1);
}

TEST_F(StepImport, OfAPartThatIsAllEachSolidIsAnObject) {
  const Import done = import(folder() / "two_solids.step");
  ASSERT_TRUE(done.model) << done.model.error().text();
  EXPECT_EQ(ids_of(*done.model), (std::vector<std::string>{"Pair/1", "Pair/2"}));
  EXPECT_EQ(stated(*done.model, done.model->objects[0], "Product"), "Pair");
}

/// A colour that one occurrence has, by its path through the assemblies, goes before all others.
TEST_F(StepImport, ColoursOfOccurrences) {
  const Import rig = import(folder() / "overridden.step");
  ASSERT_TRUE(rig.model) << rig.model.error().text();
  ASSERT_EQ(rig.model->objects.size(), 4U);
  for (const model::Object& object : rig.model->objects) {
    const model::Color& color = rig.model->bodies[object.first_body].color;
    const bool is_overridden = object.id == "Rig/second/left";
    EXPECT_EQ(color.green, is_overridden ? 255 : 0) << object.id;
    EXPECT_EQ(color.blue, is_overridden ? 0 : 255) << object.id;
  }
}

/// What is cut off or lacks lines is refused, with the line.
TEST_F(StepImport, IgesThatIsNotWholeIsRefused) {
  std::vector<std::string> lines;
  std::string whole = text_of(folder() / "faces.igs");
  std::erase(whole, '\r');
  for (std::size_t at = 0; at < whole.size();) {
    const std::size_t end = std::min(whole.find('\n', at), whole.size());
    lines.push_back(whole.substr(at, end - at));
    at = end + 1;
  }
  ASSERT_GT(lines.size(), 100U);
  const auto refused = [&](const std::vector<std::string>& some) {
    std::string text;
    for (const std::string& line : some) text += line + "\n";
    return refusal("x.igs", text);
  };
  const std::vector<std::string> cut(lines.begin(), lines.begin() + 60);
  EXPECT_NE(refused(cut).find("behind line 60, in section "), std::string::npos) << refused(cut);
  std::vector<std::string> within = cut;
  within.back().resize(40);
  EXPECT_NE(refused(within).find("ends too soon, within line 60"), std::string::npos)
      << refused(within);
  std::vector<std::string> lacking = lines;
  lacking.erase(lacking.begin() + 50);
  EXPECT_NE(refused(lacking).find("line 51 is not line"), std::string::npos) << refused(lacking);
  std::vector<std::string> short_of_last = lines;
  short_of_last.erase(short_of_last.end() - 2);
  EXPECT_NE(refused(short_of_last).find("says that section P has"), std::string::npos)
      << refused(short_of_last);
  std::vector<std::string> turned = lines;
  std::swap(turned[1], turned[lines.size() - 5]);
  EXPECT_NE(refused(turned).find("line 2 "), std::string::npos) << refused(turned);
  std::vector<std::string> more = lines;
  more.push_back("more");
  EXPECT_NE(refused(more).find("behind the T line"), std::string::npos) << refused(more);
}

TEST_F(StepImport, FacesOfIgesAreSewn) {
  const Import faces = import(folder() / "faces.igs");
  ASSERT_TRUE(faces.model) << faces.model.error().text();
  EXPECT_EQ(faces.model->objects.size(), 2U);
  const double volume = 30 * 20 * 10 + 25 * std::acos(-1.0) * 25;
  EXPECT_NEAR(std::abs(volume_of(*faces.model)), volume, 0.1 * 900);
  const Import solid = import(folder() / "solid.igs");
  ASSERT_TRUE(solid.model) << solid.model.error().text();
  EXPECT_EQ(solid.model->objects.size(), 1U);
  EXPECT_NEAR(volume_of(*solid.model), solid.volume, 0.1 * solid.area);
}

TEST_F(StepImport, AnOpenShellStaysOpen) {
  const Import done = import(folder() / "open.step");
  ASSERT_TRUE(done.model) << done.model.error().text();
  ASSERT_EQ(done.model->objects.size(), 1U);
  ASSERT_EQ(done.model->shapes.size(), 1U);
  EXPECT_EQ(std::get<geometry::TriangleMesh>(done.model->shapes[0]).vertices.size(), 8U);
}

TEST_F(StepImport, NamesAreThoseOfTheFile) {
  std::string text = text_of(folder() / "rig.step");
  const std::string hostile = R"('Ger\X2\00E4\X0\t ''a/b'' <&> \X2\4E2D6587\X0\')";
  for (std::size_t at = text.find("'Plate'"); at != std::string::npos; at = text.find("'Plate'"))
    text.replace(at, 7, hostile);
  std::ofstream(folder() / "names.step", std::ios::binary) << text;
  const Import done = import(folder() / "names.step");
  ASSERT_TRUE(done.model) << done.model.error().text();
  const model::Object* const plate = find(*done.model, "Rig/Ger\u00e4t 'a/b' <&> \u4e2d\u6587");
  ASSERT_NE(plate, nullptr) << testing::PrintToString(ids_of(*done.model));
}

TEST_F(StepImport, WhatIsNoModelIsRefusedWithAReason) {
  const std::string rig = text_of(folder() / "rig.step"), faces = text_of(folder() / "faces.igs");
  EXPECT_EQ(refusal("a.step", ""), "is empty");
  EXPECT_NE(refusal("a.step", "Dear reader\n").find("neither STEP nor IGES"), std::string::npos);
  EXPECT_NE(refusal("a.step", rig.substr(0, rig.size() / 2)).find("ends too soon"),
            std::string::npos);
  EXPECT_NE(refusal("a.igs", faces.substr(0, faces.size() / 2)).find("ends too soon"),
            std::string::npos);
  EXPECT_NE(refusal("a.step", "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;")
                .find("is an IFC model"),
            std::string::npos);
  EXPECT_NE(refusal("a.step",
                    "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n"
                    "#1=CARTESIAN_POINT('',(0.,0.,0.));\nENDSEC;\n"
                    "END-ISO-10303-21;\n")
                .find("nothing in it becomes an object"),
            std::string::npos);
  EXPECT_NE(refusal("a.step", "PK\x03\x04").find("zip archive"), std::string::npos);
}

TEST_F(StepImport, DamageIsReportedWithItsLine) {
  const std::string begin = "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n";
  const std::string end = "ENDSEC;\nEND-ISO-10303-21;\n";
  const auto fault = [&](const std::string& data) {
    const auto checked = check_step_syntax(begin + data + end, "a.step");
    return checked ? "none" : checked.error().message;
  };
  EXPECT_EQ(fault("#1=A('it''s; (',#2);\n#2 = (B()C(.T.,$,*)); /* ; */\n"), "none");
  EXPECT_EQ(fault("#1=A(1.,\n2.;\n"),
            "the file is damaged: line 6: a '(' of this statement is not closed");
  EXPECT_EQ(fault("#1=A());\n"), "the file is damaged: line 5: a ')' closes nothing");
  EXPECT_EQ(fault("#1=A('x);\n"), "the file is damaged: the text that begins in line 5 has no end");
  EXPECT_EQ(fault("#1=A()\n"), "the file is damaged: line 6: the statement does not end with ')'");
  EXPECT_EQ(fault("#1 A();\n"), "the file is damaged: line 5: there is no '=' behind #1");
  EXPECT_EQ(fault("A();\n"), "the file is damaged: line 5: this is no entity");
  EXPECT_EQ(fault("#1=A(#);\n"), "the file is damaged: line 5: '#' has no number behind it");
  EXPECT_EQ(fault("#99999999999999999999999=A();\n"),
            "the file is damaged: line 5: the number of the entity is too large");
  EXPECT_EQ(fault("#1=A" + std::string(200, '(') + std::string(200, ')') + ";\n"),
            "the file is damaged: line 5: more than 100 parentheses within each other");
  const auto lacking = check_step_syntax(begin + "#1=A(#2,\n#7);\n#2=B(#7);\n" + end, "a.step");
  ASSERT_TRUE(lacking);
  EXPECT_EQ(lacking->missing, 2U);
  EXPECT_EQ(lacking->listed[0], "#1 in line 6 refers to #7, which is not there");
}

/// All files of STRAKE_DATA: read, or refused with a reason; volumes as Open CASCADE has them.
TEST_F(StepImport, RealFiles) {
  const char* const data = std::getenv("STRAKE_DATA");
  if (data == nullptr) GTEST_SKIP() << "STRAKE_DATA names no folder";
  std::size_t read = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(data)) {
    std::string suffix = entry.path().extension().string();
    std::ranges::transform(suffix, suffix.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (!std::set<std::string>{".step", ".stp", ".iges", ".igs"}.contains(suffix)) continue;
    SCOPED_TRACE(entry.path().string());
    const Import done = import(entry.path());
    if (!done.model) {
      EXPECT_FALSE(done.model.error().mend.empty());
      continue;
    }
    ++read;
    EXPECT_EQ(report().find("step-open-solid"), std::string::npos) << report();
    const double volume = volume_of(*done.model);
    EXPECT_NEAR(volume, done.volume, MeshOptions::kSag * done.area);
    RecordProperty(entry.path().filename().string(), std::to_string(volume / done.volume));
  }
  EXPECT_GT(read, 0U);
}

}  // namespace
}  // namespace strake::import_step
