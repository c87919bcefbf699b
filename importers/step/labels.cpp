// SPDX-License-Identifier: Apache-2.0
#include "labels.hpp"

#include <Quantity_ColorRGBA.hxx>
#include <TColStd_HSequenceOfExtendedString.hxx>
#include <TCollection_AsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDataStd_TreeNode.hxx>
#include <XCAFDoc.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_GraphNode.hxx>
#include <XCAFDoc_Material.hxx>
#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "core/text_encoding.hpp"
#include "product_pieces.hpp"

namespace strake::import_step {
namespace {

std::string utf8_of(const TCollection_ExtendedString& text) {
  std::string bytes(static_cast<std::size_t>(text.LengthOfCString()) + 1, '\0');
  Standard_PCharacter begin = bytes.data();
  bytes.resize(static_cast<std::size_t>(text.ToUTF8CString(begin)));
  return std::string(trimmed(valid_utf8(bytes), " \t\r\n"));
}

/// Whether a text is what Open CASCADE calls shapes that have no name.
bool is_kind_of_shape(std::string_view text) {
  constexpr std::array<std::string_view, 9> kKinds{
      "COMPOUND", "COMPSOLID", "SOLID", "SHELL", "FACE", "WIRE", "EDGE", "VERTEX", "SHAPE"};
  return std::ranges::find(kKinds, text) != kKinds.end();
}

bool is_number_after(std::string_view text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  return std::ranges::all_of(text.substr(word.size()), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

Labels::Labels(const Handle(TDocStd_Document) & document)
    : shapes(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
      colors(XCAFDoc_DocumentTool::ColorTool(document->Main())),
      layers(XCAFDoc_DocumentTool::LayerTool(document->Main())) {}

std::string Labels::name_of(const TDF_Label& label) {
  Handle(TDataStd_Name) name;
  if (label.IsNull() || !label.FindAttribute(TDataStd_Name::GetID(), name)) return {};
  const std::string text = utf8_of(name->Get());
  // Where the file says nothing there is the reference itself, "=>[0:1:1:2]", or what the shape is.
  const bool is_made_up = text.starts_with("=>[0:") || is_kind_of_shape(text);
  return is_made_up ? std::string() : text;
}

bool Labels::is_product_in_pieces(const TDF_Label& assembly) {
  TDF_LabelSequence components;
  XCAFDoc_ShapeTool::GetComponents(assembly, components);
  for (const TDF_Label& component : components) {
    TDF_Label piece;
    if (!XCAFDoc_ShapeTool::GetReferredShape(component, piece) ||
        XCAFDoc_ShapeTool::IsAssembly(piece) || !name_of(piece).empty() ||
        !name_of(component).empty())
      return false;
  }
  return true;
}

std::string Labels::instance_name(const TDF_Label& instance, const std::string& product) {
  std::string name = name_of(instance);
  if (name == product || is_number_after(name, "") || is_number_after(name, "NAUO")) return {};
  return name;
}

std::optional<model::Color> Labels::color_of_label(const TDF_Label& label) const {
  if (label.IsNull()) return std::nullopt;
  Quantity_ColorRGBA color;
  for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen})
    if (colors->GetColor(label, type, color)) return color_of(color);
  return std::nullopt;
}

std::optional<model::Color> Labels::color_of_occurrence(const std::vector<TDF_Label>& chain) const {
  // What an outer assembly says goes before what one within it does.
  for (std::size_t first = 0; first + 1 < chain.size(); ++first) {
    TDF_LabelSequence usage;
    for (std::size_t i = first; i < chain.size(); ++i) usage.Append(chain[i]);
    Handle(XCAFDoc_GraphNode) occurrence;
    if (!XCAFDoc_ShapeTool::FindSHUO(usage, occurrence) || occurrence.IsNull()) continue;
    if (const std::optional<model::Color> color = color_of_label(occurrence->Label())) return color;
  }
  return std::nullopt;
}

std::string Labels::layers_of(const TDF_Label& label) const {
  Handle(TColStd_HSequenceOfExtendedString) names;
  if (label.IsNull() || !layers->GetLayers(label, names) || names.IsNull()) return {};
  std::vector<std::string> sorted;
  for (int i = 1; i <= names->Length(); ++i) sorted.push_back(utf8_of(names->Value(i)));
  std::ranges::sort(sorted);
  std::string text;
  for (const std::string& name : sorted) text += (text.empty() ? "" : "; ") + name;
  return text;
}

std::string Labels::material_of(const TDF_Label& label) {
  Handle(TDataStd_TreeNode) node;
  if (label.IsNull() || !label.FindAttribute(XCAFDoc::MaterialRefGUID(), node) ||
      !node->HasFather())
    return {};
  Handle(XCAFDoc_Material) material;
  if (!node->Father()->Label().FindAttribute(XCAFDoc_Material::GetID(), material) ||
      material->GetName().IsNull())
    return {};
  return valid_utf8(material->GetName()->ToCString());
}

}  // namespace strake::import_step
