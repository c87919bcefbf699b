// SPDX-License-Identifier: Apache-2.0
#include "unit/import_step/step_files.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <IGESCAFControl_Writer.hxx>
#include <IGESControl_Controller.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Application.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_GraphNode.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <vector>

namespace strake::import_step {
namespace {

gp_Trsf moved(double x, double y, double z) {
  gp_Trsf place;
  place.SetTranslation(gp_Vec(x, y, z));
  return place;
}

TopoDS_Shape at(const TopoDS_Shape& shape, double x) {
  return shape.Moved(TopLoc_Location(moved(x, 0, 0)));
}

TopoDS_Compound together(const std::vector<TopoDS_Shape>& shapes) {
  TopoDS_Compound compound;
  const BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const TopoDS_Shape& shape : shapes) builder.Add(compound, shape);
  return compound;
}

TopoDS_Shape filleted_box() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(40, 30, 20).Shape();
  BRepFilletAPI_MakeFillet fillet(box);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(box, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) fillet.Add(3, TopoDS::Edge(edges(i)));
  return fillet.Shape();
}

/// A document that is being made.
class Draft {
 public:
  Draft() {
    const Handle(TDocStd_Application) application = new TDocStd_Application;
    application->NewDocument("MDTV-XCAF", document_);
    shapes_ = XCAFDoc_DocumentTool::ShapeTool(document_->Main());
  }
  TDF_Label part(const TopoDS_Shape& shape, const char* name) {
    const TDF_Label label = shapes_->AddShape(shape, Standard_False);
    TDataStd_Name::Set(label, name);
    return label;
  }
  TDF_Label assembly(const char* name) {
    const TDF_Label label = shapes_->NewShape();
    TDataStd_Name::Set(label, name);
    return label;
  }
  TDF_Label place(const TDF_Label& assembly, const TDF_Label& part, const gp_Trsf& place,
                  const char* name) {
    const TDF_Label label = shapes_->AddComponent(assembly, part, TopLoc_Location(place));
    TDataStd_Name::Set(label, name);
    return label;
  }
  /// Colours one occurrence, which instances lead to, the outermost first.
  void color_occurrence(const std::vector<TDF_Label>& instances, double red, double green,
                        double blue) {
    TDF_LabelSequence chain;
    for (const TDF_Label& instance : instances) chain.Append(instance);
    Handle(XCAFDoc_GraphNode) occurrence;
    if (shapes_->SetSHUO(chain, occurrence)) color(occurrence->Label(), red, green, blue);
  }
  void color(const TDF_Label& label, double red, double green, double blue) {
    XCAFDoc_DocumentTool::ColorTool(document_->Main())
        ->SetColor(label, Quantity_Color(red, green, blue, Quantity_TOC_sRGB), XCAFDoc_ColorSurf);
  }
  void layer(const TDF_Label& label, const char* name) {
    XCAFDoc_DocumentTool::LayerTool(document_->Main())->SetLayer(label, name);
  }
  bool write_step(const std::filesystem::path& file, const char* unit) {
    shapes_->UpdateAssemblies();
    // The settings are there once there is a writer, and are taken by the next one.
    {
      const STEPCAFControl_Writer first;
    }
    Interface_Static::SetCVal("write.step.unit", unit);
    Interface_Static::SetCVal("write.step.schema", "AP214IS");
    STEPCAFControl_Writer writer;
    writer.SetSHUOMode(Standard_True);
    return writer.Transfer(document_, STEPControl_AsIs) &&
           writer.Write(file.c_str()) == IFSelect_RetDone;
  }
  bool write_iges(const std::filesystem::path& file, int as_solids) {
    IGESControl_Controller::Init();
    Interface_Static::SetIVal("write.iges.brep.mode", as_solids);
    IGESCAFControl_Writer writer;
    writer.Transfer(document_);
    writer.ComputeModel();
    return writer.Write(file.c_str());
  }

 private:
  Handle(TDocStd_Document) document_;
  Handle(XCAFDoc_ShapeTool) shapes_;
};

bool write_rig(const std::filesystem::path& file, const char* unit) {
  Draft draft;
  const TDF_Label plate = draft.part(BRepPrimAPI_MakeBox(100, 60, 10).Shape(), "Plate");
  const TDF_Label bolt = draft.part(BRepPrimAPI_MakeCylinder(4, 30).Shape(), "Bolt");
  const TDF_Label angle = draft.part(BRepPrimAPI_MakeBox(20, 20, 20).Shape(), "Angle");
  draft.color(plate, 1, 0, 0);
  draft.color(bolt, 0, 0, 1);
  draft.layer(plate, "Structure");
  const TDF_Label bracket = draft.assembly("Bracket");
  draft.place(bracket, angle, moved(0, 0, 0), "NAUO7");
  draft.place(bracket, bolt, moved(5, 5, 20), "left");
  draft.place(bracket, bolt, moved(15, 15, 20), "right");
  const TDF_Label rig = draft.assembly("Rig");
  draft.place(rig, plate, moved(0, 0, 0), "Plate");
  for (const double x : {10.0, 90.0})
    for (const double y : {10.0, 50.0}) draft.place(rig, bolt, moved(x, y, 10), "Bolt");
  draft.place(rig, bracket, moved(30, 20, 10), "first");
  gp_Trsf turned;
  turned.SetRotation(gp_Ax1(gp_Pnt(70, 30, 0), gp_Dir(0, 0, 1)), 0.5);
  draft.place(rig, bracket, turned, "second");
  return draft.write_step(file, unit);
}

/// Two equal brackets of two bolts, all blue but the left bolt of the second bracket.
bool write_overridden(const std::filesystem::path& file) {
  Draft draft;
  const TDF_Label bolt = draft.part(BRepPrimAPI_MakeCylinder(4, 30).Shape(), "Bolt");
  draft.color(bolt, 0, 0, 1);
  const TDF_Label bracket = draft.assembly("Bracket");
  const TDF_Label left = draft.place(bracket, bolt, moved(5, 5, 20), "left");
  draft.place(bracket, bolt, moved(15, 15, 20), "right");
  const TDF_Label rig = draft.assembly("Rig");
  draft.place(rig, bracket, moved(0, 0, 0), "first");
  const TDF_Label second = draft.place(rig, bracket, moved(100, 0, 0), "second");
  draft.color_occurrence({second, left}, 0, 1, 0);
  return draft.write_step(file, "MM");
}

bool write_single(const std::filesystem::path& file, const TopoDS_Shape& shape, const char* name) {
  Draft draft;
  draft.part(shape, name);
  return draft.write_step(file, "MM");
}

TopoDS_Shape box_without_lid() {
  std::vector<TopoDS_Shape> faces;
  for (TopExp_Explorer face(BRepPrimAPI_MakeBox(10, 10, 10).Shape(), TopAbs_FACE); face.More();
       face.Next())
    faces.push_back(face.Current());
  faces.pop_back();
  return together(faces);
}

bool write_all_iges(const std::filesystem::path& folder) {
  Draft faces;
  const TDF_Label box = faces.part(BRepPrimAPI_MakeBox(30, 20, 10).Shape(), "Box");
  faces.color(box, 0, 1, 0);
  faces.part(at(BRepPrimAPI_MakeCylinder(5, 25).Shape(), 100), "Pin");
  Draft solid;
  solid.part(at(filleted_box(), 10), "Block");
  return faces.write_iges(folder / "faces.igs", 0) && solid.write_iges(folder / "solid.igs", 1);
}

}  // namespace

TopoDS_Shape curved_solids() {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(40, 40, 40).Shape();
  const TopoDS_Shape bore =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(20, 20, -5), gp_Dir(0, 0, 1)), 8, 50).Shape();
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(20).Shape();
  return together({ball, at(BRepPrimAPI_MakeTorus(30, 8).Shape(), 100),
                   at(BRepPrimAPI_MakeCone(20, 0, 40).Shape(), 200), at(filleted_box(), 300),
                   at(BRepAlgoAPI_Cut(block, bore).Shape(), 400),
                   at(BRepBuilderAPI_NurbsConvert(ball).Shape(), 500)});
}

bool write_step_files(const std::filesystem::path& folder) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 10, 10).Shape();
  return write_rig(folder / "rig.step", "MM") && write_rig(folder / "rig_inch.step", "INCH") &&
         write_rig(folder / "rig_metre.step", "M") &&
         write_overridden(folder / "overridden.step") &&
         write_single(folder / "curved.step", curved_solids(), "Curved") &&
         write_single(folder / "two_solids.step", together({box, at(box, 5)}), "Pair") &&
         write_single(folder / "open.step", box_without_lid(), "Tray") && write_all_iges(folder);
}

}  // namespace strake::import_step
