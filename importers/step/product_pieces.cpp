// SPDX-License-Identifier: Apache-2.0
#include "product_pieces.hpp"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Quantity_ColorRGBA.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_MapOfShape.hxx>
#include <XCAFPrs_Style.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace strake::import_step {
namespace {

/// Faces whose edges lie no farther apart than this are one surface, mm: what files say of one
/// edge twice differs by about this where it was rounded.
constexpr double kSewing = 0.01;

std::optional<model::Color> stated_color(const TopoDS_Shape& shape,
                                         const XCAFPrs_IndexedDataMapOfShapeStyle& styles) {
  const XCAFPrs_Style* const style = styles.Seek(shape);
  if (style == nullptr || !style->IsSetColorSurf()) return std::nullopt;
  return color_of(style->GetColorSurfRGBA());
}

double area_of(const TopoDS_Shape& face) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  return std::abs(properties.Mass());
}

/// The area that each colour has.
class ColorAreas {
 public:
  void add(const std::optional<model::Color>& color, double area) {
    if (color) areas_[{color->red, color->green, color->blue, color->alpha}] += area;
  }
  [[nodiscard]] std::optional<model::Color> largest() const {
    std::optional<model::Color> color;
    double maximum = -1;
    for (const auto& [key, area] : areas_)
      if (area > maximum) {
        maximum = area;
        color = model::Color{key[0], key[1], key[2], key[3]};
      }
    return color;
  }

 private:
  std::map<std::array<std::uint8_t, 4>, double> areas_;
};

class PieceFinder {
 public:
  PieceFinder(const TopoDS_Shape& product, const XCAFPrs_IndexedDataMapOfShapeStyle& styles)
      : product_(product), styles_(styles), of_product_(stated_color(product, styles)) {}
  Pieces find();

 private:
  [[nodiscard]] std::optional<model::Color> color_of_solid(const TopoDS_Shape& solid) const;
  [[nodiscard]] std::optional<model::Color> color_of_shell(const TopoDS_Shape& shell) const;
  void add_solids();
  void add_surfaces();

  const TopoDS_Shape& product_;
  const XCAFPrs_IndexedDataMapOfShapeStyle& styles_;
  std::optional<model::Color> of_product_;
  Pieces result_;
};

std::optional<model::Color> PieceFinder::color_of_solid(const TopoDS_Shape& solid) const {
  std::optional<model::Color> whole = stated_color(solid, styles_);
  if (!whole) whole = color_of_shell(solid);
  bool has_colored_face = false;
  for (TopExp_Explorer at(solid, TopAbs_FACE); at.More() && !has_colored_face; at.Next())
    has_colored_face = stated_color(at.Current(), styles_).has_value();
  if (!has_colored_face) return whole;
  ColorAreas areas;
  for (TopExp_Explorer at(solid, TopAbs_FACE); at.More(); at.Next()) {
    const std::optional<model::Color> own = stated_color(at.Current(), styles_);
    areas.add(own ? own : whole, area_of(at.Current()));
  }
  return areas.largest();
}

/// Returns the colour of the shell of a shape, if it has one, else that of the product.
std::optional<model::Color> PieceFinder::color_of_shell(const TopoDS_Shape& shape) const {
  for (TopExp_Explorer at(shape, TopAbs_SHELL); at.More(); at.Next())
    if (const std::optional<model::Color> own = stated_color(at.Current(), styles_)) return own;
  return of_product_;
}

void PieceFinder::add_solids() {
  TopTools_MapOfShape visited;
  for (TopExp_Explorer at(product_, TopAbs_SOLID); at.More(); at.Next())
    if (visited.Add(at.Current()))
      result_.pieces.push_back({at.Current(), true, color_of_solid(at.Current())});
}

void PieceFinder::add_surfaces() {
  BRepBuilderAPI_Sewing sewing(kSewing);
  std::vector<std::pair<TopoDS_Shape, std::optional<model::Color>>> faces;
  for (TopExp_Explorer shell(product_, TopAbs_SHELL, TopAbs_SOLID); shell.More(); shell.Next()) {
    const std::optional<model::Color> of_shell = stated_color(shell.Current(), styles_);
    for (TopExp_Explorer at(shell.Current(), TopAbs_FACE); at.More(); at.Next())
      faces.emplace_back(at.Current(), of_shell ? of_shell : of_product_);
  }
  for (TopExp_Explorer at(product_, TopAbs_FACE, TopAbs_SHELL); at.More(); at.Next())
    faces.emplace_back(at.Current(), of_product_);
  if (faces.empty()) return;
  for (auto& [face, color] : faces) {
    if (const std::optional<model::Color> own = stated_color(face, styles_)) color = own;
    sewing.Add(face);
  }
  sewing.Perform();
  const TopoDS_Shape& sewn = sewing.SewedShape();
  if (sewn.IsNull()) return;
  TopTools_DataMapOfShapeInteger part_of;
  std::vector<TopoDS_Shape> parts;
  const auto take = [&](const TopoDS_Shape& part) {
    for (TopExp_Explorer at(part, TopAbs_FACE); at.More(); at.Next())
      part_of.Bind(at.Current(), static_cast<int>(parts.size()));
    parts.push_back(part);
  };
  for (TopExp_Explorer at(sewn, TopAbs_SHELL); at.More(); at.Next()) take(at.Current());
  for (TopExp_Explorer at(sewn, TopAbs_FACE, TopAbs_SHELL); at.More(); at.Next())
    take(at.Current());
  std::vector<ColorAreas> areas(parts.size());
  for (const auto& [face, color] : faces)
    if (const int* const part = part_of.Seek(sewing.ModifiedSubShape(face)); color && part)
      areas[static_cast<std::size_t>(*part)].add(color, area_of(face));
  for (std::size_t i = 0; i < parts.size(); ++i)
    result_.pieces.push_back({parts[i], false, areas[i].largest()});
}

Pieces PieceFinder::find() {
  add_solids();
  add_surfaces();
  for (TopExp_Explorer at(product_, TopAbs_EDGE, TopAbs_FACE); at.More(); at.Next())
    ++result_.curves;
  return std::move(result_);
}

}  // namespace

Pieces pieces_of(const TopoDS_Shape& product, const XCAFPrs_IndexedDataMapOfShapeStyle& styles) {
  return PieceFinder(product, styles).find();
}

model::Color color_of(const Quantity_ColorRGBA& color) {
  const auto byte = [](double share) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255));
  };
  double red = 0, green = 0, blue = 0;
  color.GetRGB().Values(red, green, blue, Quantity_TOC_sRGB);
  return {byte(red), byte(green), byte(blue), byte(static_cast<double>(color.Alpha()))};
}

}  // namespace strake::import_step
