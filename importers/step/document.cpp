// SPDX-License-Identifier: Apache-2.0
#include "document.hpp"

#include <IFSelect_ReturnStatus.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Check.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_ExternFile.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TDocStd_Application.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/text_encoding.hpp"
#include "message_log.hpp"

namespace strake::import_step {
namespace {

/// The parts of progress: what Open CASCADE reads without telling of it, what it makes shapes of.
constexpr double kParsed = 0.15, kTransferred = 0.5;

/// Returns the name that strake has for a unit of so many millimetres.
std::string unit_of_length(double millimetres) {
  struct Unit {
    std::string_view name;
    double mm;
  };
  constexpr std::array<Unit, 7> kUnits{
      {{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}, {"ft", 304.8}, {"km", 1e6}, {"um", 1e-3}}};
  const auto* const known = std::ranges::find_if(
      kUnits, [&](const Unit& u) { return std::abs(millimetres / u.mm - 1) < 1e-6; });
  return known == kUnits.end() ? std::string() : std::string(known->name);
}

/// Returns the unit that a STEP file names, as "metre" or "INCH".
std::string unit_of_name(std::string_view name) {
  struct Unit {
    std::string_view word, name;
  };
  constexpr std::array<Unit, 10> kUnits{{{"milli", "mm"},
                                         {"centi", "cm"},
                                         {"kilo", "km"},
                                         {"micro", "um"},
                                         {"metre", "m"},
                                         {"meter", "m"},
                                         {"inch", "in"},
                                         {"foot", "ft"},
                                         {"feet", "ft"},
                                         {"yard", "yd"}}};
  const std::string low = lowered(name);
  const auto* const known = std::ranges::find_if(
      kUnits, [&](const Unit& u) { return low.find(u.word) != std::string::npos; });
  return known == kUnits.end() || known->name == "yd" ? std::string() : std::string(known->name);
}

/// Settings of Open CASCADE, which may otherwise come from its resource files and environment.
void set_reading() {
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
  Interface_Static::SetIVal("read.step.ideas", 1);
  Interface_Static::SetIVal("read.step.assembly.level", 1);
  Interface_Static::SetIVal("read.iges.bspline.continuity", 1);
}

Handle(TDocStd_Document) new_document() {
  const Handle(TDocStd_Application) application = new TDocStd_Application;
  Handle(TDocStd_Document) document;
  application->NewDocument("MDTV-XCAF", document);
  return document;
}

Error unreadable(const std::filesystem::path& file, const std::string& why) {
  return {ErrorCode::input, "Open CASCADE cannot read the file" + (why.empty() ? "" : ": " + why),
          file.string(), "it may be damaged: export it again, or as STEP AP214"};
}

Error without_product(const std::filesystem::path& file,
                      const Handle(XSControl_WorkSession) & session) {
  const Handle(Interface_InterfaceModel) model = session->Model();
  return {ErrorCode::input,
          "nothing in it becomes an object: none of its " +
              std::to_string(model.IsNull() ? 0 : model->NbEntities()) +
              " entities is a product with a shape",
          file.string(), "export a whole part or assembly, as STEP AP214 or AP242"};
}

/// Adds the numbers and kinds of the entities that failed, of which there may be many.
void note_failures(const Handle(XSControl_WorkSession) & session, Document& document) {
  const Handle(Interface_InterfaceModel) model = session->Model();
  const Handle(XSControl_TransferReader) transfer = session->TransferReader();
  if (model.IsNull() || transfer.IsNull() || transfer->TransientProcess().IsNull()) return;
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (model->IsUnknownEntity(i)) ++document.unknown;
  const Interface_CheckIterator checks = transfer->LastCheckList();
  for (checks.Start(); checks.More(); checks.Next()) {
    const Handle(Interface_Check)& check = checks.Value();
    if (!check->HasFailed()) continue;
    std::string name = "the file";
    if (const int number = checks.Number(); number > 0 && number <= model->NbEntities()) {
      const Handle(Standard_Transient) entity = model->Value(number);
      const Handle(TCollection_HAsciiString) label = model->StringLabel(entity);
      name = (label.IsNull() ? "" : label->ToCString()) + std::string(" ") +
             session->Model()->TypeName(entity, Standard_False);
    }
    document.not_read.push_back(printable(name) + ": " + printable(check->CFail(1)));
  }
}

Result<Document> read_step(const std::filesystem::path& file,
                           const Handle(ReportProgress) & progress) {
  const MessageLog log;
  STEPCAFControl_Reader reader;
  set_reading();
  reader.SetColorMode(Standard_True);
  reader.SetNameMode(Standard_True);
  reader.SetLayerMode(Standard_True);
  reader.SetSHUOMode(Standard_True);
  reader.SetMatMode(Standard_True);
  reader.SetGDTMode(Standard_False);
  reader.SetPropsMode(Standard_False);
  reader.SetViewMode(Standard_False);
  const IFSelect_ReturnStatus status = reader.ReadFile(file.c_str());
  const Handle(XSControl_WorkSession) session = reader.Reader().WS();
  if (status == IFSelect_RetVoid) return without_product(file, session);
  if (status != IFSelect_RetDone) return unreadable(file, log.text());
  Document document;
  document.content = new_document();
  progress->next(kParsed, kTransferred);
  if (!reader.Transfer(document.content, progress->Start())) return without_product(file, session);
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.ChangeReader().FileUnits(lengths, angles, solid_angles);
  if (!lengths.IsEmpty()) document.unit = unit_of_name(lengths.First().ToCString());
  note_failures(session, document);
  for (NCollection_DataMap<TCollection_AsciiString, Handle(STEPCAFControl_ExternFile)>::Iterator at(
           reader.ExternFiles());
       at.More(); at.Next()) {
    document.outer_files.emplace_back(at.Key().ToCString());
    if (at.Value()->GetLoadStatus() != IFSelect_RetDone)
      document.missing_files.emplace_back(at.Key().ToCString());
  }
  std::ranges::sort(document.outer_files);
  std::ranges::sort(document.missing_files);
  return document;
}

Result<Document> read_iges(const std::filesystem::path& file,
                           const Handle(ReportProgress) & progress) {
  const MessageLog log;
  IGESCAFControl_Reader reader;
  set_reading();
  reader.SetColorMode(Standard_True);
  reader.SetNameMode(Standard_True);
  reader.SetLayerMode(Standard_True);
  const IFSelect_ReturnStatus status = reader.ReadFile(file.c_str());
  if (status == IFSelect_RetVoid) return without_product(file, reader.WS());
  if (status != IFSelect_RetDone) return unreadable(file, log.text());
  Document document;
  document.content = new_document();
  progress->next(kParsed, kTransferred);
  if (!reader.Transfer(document.content, progress->Start()))
    return without_product(file, reader.WS());
  const Handle(IGESData_IGESModel) model = Handle(IGESData_IGESModel)::DownCast(reader.Model());
  if (!model.IsNull()) document.unit = unit_of_length(model->GlobalSection().UnitValue());
  note_failures(reader.WS(), document);
  return document;
}

}  // namespace

Result<Document> read_document(const std::filesystem::path& file, SourceKind kind,
                               const Handle(ReportProgress) & progress) {
  try {
    OCC_CATCH_SIGNALS
    return kind == SourceKind::step ? read_step(file, progress) : read_iges(file, progress);
  } catch (const Standard_Failure& failure) {
    return unreadable(file, failure_text(failure));
  }
}

}  // namespace strake::import_step
