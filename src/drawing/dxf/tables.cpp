// SPDX-License-Identifier: Apache-2.0
#include "drawing/dxf/tables.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "drawing/dxf/handles.hpp"

namespace strake::drawing::dxf {

namespace {

void begin_table(Groups& groups, std::string_view name, Handle handle, std::size_t records) {
  groups.text(0, "TABLE")
      .text(2, name)
      .handle(5, handle)
      .handle(330, 0)
      .text(100, "AcDbSymbolTable")
      .whole(70, static_cast<std::int64_t>(records));
}

void end_table(Groups& groups) { groups.text(0, "ENDTAB"); }

Groups& begin_record(Groups& groups, std::string_view type, Handle handle, Handle table,
                     std::string_view subclass, std::string_view name) {
  constexpr int kHandle = 5, kHandleOfDimension = 105;
  return groups.text(0, type)
      .handle(table == kDimensionTable ? kHandleOfDimension : kHandle, handle)
      .handle(330, table)
      .text(100, "AcDbSymbolTableRecord")
      .text(100, subclass)
      .text(2, name);
}

/// Appends what a window that opens on model space shows: all of it.
void append_viewports(Groups& groups, const DxfExtent& model) {
  constexpr double kWindow = 1.6;  // a window is about as much wider than high
  const PaperPoint middle = model.empty() ? PaperPoint{} : model.middle();
  const double height =
      model.empty() ? 297 : std::max({model.height(), model.width() / kWindow, 1.0}) * 1.05;
  begin_table(groups, "VPORT", kViewportTable, 1);
  begin_record(groups, "VPORT", kActiveViewport, kViewportTable, "AcDbViewportTableRecord",
               "*Active")
      .whole(70, 0)
      .point(10, 0, 0)
      .point(11, 1, 1)
      .point(12, middle.x, middle.y)
      .point(13, 0, 0)
      .point(14, 10, 10)
      .point(15, 10, 10)
      .point(16, 0, 0)
      .whole(36, 1)
      .point_in_space(17, 0, 0)
      .number(40, height)
      .number(41, kWindow)
      .whole(42, 50)
      .whole(43, 0)
      .whole(44, 0)
      .whole(50, 0)
      .whole(51, 0)
      .whole(71, 0)
      .whole(72, 1000)
      .whole(73, 1)
      .whole(74, 3)
      .whole(75, 0)
      .whole(76, 0)
      .whole(77, 0)
      .whole(78, 0);
  end_table(groups);
}

/// A pattern of dashes and gaps, an even number of them.
struct LineType {
  std::string name;
  std::vector<double> dash_mm;
};

/// Types of lines, and which of them each layer has.
struct LineTypes {
  std::vector<LineType> all;
  std::vector<std::string> of_layer;
};

std::vector<double> even(const std::vector<double>& dash_mm) {
  std::vector<double> twice = dash_mm;
  if (dash_mm.size() % 2 == 1) twice.insert(twice.end(), dash_mm.begin(), dash_mm.end());
  return twice;
}

LineTypes line_types(const std::vector<LayerStyle>& layers) {
  LineTypes types;
  std::map<std::vector<double>, std::size_t> number_of;
  for (const LayerStyle& layer : layers) {
    if (layer.dash_mm.empty()) {
      types.of_layer.emplace_back("Continuous");
      continue;
    }
    const std::vector<double> dashes = even(layer.dash_mm);
    const auto [found, is_new] = number_of.try_emplace(dashes, types.all.size());
    if (is_new) {
      // The usual names with the layer's: these dashes are not those of a program's own CENTER.
      const std::string_view kind = dashes.size() == 2   ? "DASHED_"
                                    : dashes.size() == 4 ? "CENTER_"
                                                         : "PHANTOM_";
      types.all.push_back({std::string(kind) + layer.name, dashes});
    }
    types.of_layer.push_back(types.all[found->second].name);
  }
  return types;
}

void append_line_types(Groups& groups, const std::vector<LineType>& types, Handle first) {
  begin_table(groups, "LTYPE", kLineTypeTable, types.size() + 3);
  const auto begin = [&](Handle handle, std::string_view name, std::string_view description,
                         std::size_t dashes, double length) {
    begin_record(groups, "LTYPE", handle, kLineTypeTable, "AcDbLinetypeTableRecord", name)
        .whole(70, 0)
        .text(3, description)
        .whole(72, 65)
        .whole(73, static_cast<std::int64_t>(dashes))
        .number(40, length);
  };
  begin(kByBlock, "ByBlock", "", 0, 0);
  begin(kByLayer, "ByLayer", "", 0, 0);
  begin(kContinuous, "Continuous", "Solid line", 0, 0);
  for (const LineType& type : types) {
    double length = 0;
    for (const double dash : type.dash_mm) length += dash;
    begin(first++, type.name, type.dash_mm.size() == 2 ? "__ __ __" : "____ _ ____ _",
          type.dash_mm.size(), length);
    bool ink = true;
    for (const double dash : type.dash_mm) {
      groups.number(49, ink ? dash : -dash).whole(74, 0);
      ink = !ink;
    }
  }
  end_table(groups);
}

std::int64_t true_color(const model::Color& color) {
  return std::int64_t{color.red} * 0x10000 + std::int64_t{color.green} * 0x100 + color.blue;
}

void append_layers(Groups& groups, const std::vector<LayerStyle>& layers, const LineTypes& types) {
  constexpr int kNotPlotted = 0;
  begin_table(groups, "LAYER", kLayerTable, layers.size() + 1);
  begin_record(groups, "LAYER", kLayerZero, kLayerTable, "AcDbLayerTableRecord", "0")
      .whole(70, 0)
      .whole(62, 7)
      .text(6, "Continuous")
      .whole(370, -3)
      .handle(390, kNormalPlotStyle);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const LayerStyle& layer = layers[i];
    begin_record(groups, "LAYER", kFirstLayer + i, kLayerTable, "AcDbLayerTableRecord", layer.name)
        .whole(70, 0)
        .whole(62, color_number(layer.color));
    // True black would not be seen on black: number 7 shows white there.
    if (const std::int64_t color = true_color(layer.color); color != 0) groups.whole(420, color);
    groups.text(6, types.of_layer[i]);
    if (!layer.plotted) groups.whole(290, kNotPlotted);
    groups.whole(370, line_weight(layer.width_mm)).handle(390, kNormalPlotStyle);
    groups.text(1001, kDescriptionApplication).text(1000, "").text(1000, layer.description);
  }
  end_table(groups);
}

void append_styles(Groups& groups) {
  struct Style {
    Handle handle;
    std::string_view name;
  };
  begin_table(groups, "STYLE", kStyleTable, 2);
  for (const Style& style : {Style{kStandardStyle, "Standard"}, Style{kDrawingStyle, kTextStyle}})
    begin_record(groups, "STYLE", style.handle, kStyleTable, "AcDbTextStyleTableRecord", style.name)
        .whole(70, 0)
        .whole(40, 0)
        .whole(41, 1)
        .whole(50, 0)
        .whole(71, 0)
        .number(42, 2.5)
        .text(3, "arial.ttf")
        .text(4, "");
  end_table(groups);
}

void append_applications(Groups& groups) {
  struct Application {
    Handle handle;
    std::string_view name;
  };
  begin_table(groups, "APPID", kAppTable, 3);
  for (const Application& app :
       {Application{kAcadApp, "ACAD"}, Application{kDescriptionApp, kDescriptionApplication},
        Application{kStrakeApp, kApplication}})
    begin_record(groups, "APPID", app.handle, kAppTable, "AcDbRegAppTableRecord", app.name)
        .whole(70, 0);
  end_table(groups);
}

void append_dimension_styles(Groups& groups) {
  begin_table(groups, "DIMSTYLE", kDimensionTable, 1);
  groups.text(100, "AcDbDimStyleTable");
  begin_record(groups, "DIMSTYLE", kStandardDimension, kDimensionTable, "AcDbDimStyleTableRecord",
               "Standard")
      .whole(70, 0)
      .handle(340, kStandardStyle);
  end_table(groups);
}

void append_block_records(Groups& groups, const std::vector<PaperLayout>& papers) {
  begin_table(groups, "BLOCK_RECORD", kBlockTable, papers.size() + 1);
  const auto record = [&](std::string_view name, Handle handle, Handle layout) {
    begin_record(groups, "BLOCK_RECORD", handle, kBlockTable, "AcDbBlockTableRecord", name)
        .handle(340, layout)
        .whole(70, 0)
        .whole(280, 1)
        .whole(281, 0);
  };
  record("*Model_Space", kModelSpace, kModelLayout);
  for (std::size_t p = 0; p < papers.size(); ++p)
    record(name_of_paper_block(p), papers[p].record, papers[p].layout);
  end_table(groups);
}

void append_empty_table(Groups& groups, std::string_view name, Handle handle) {
  begin_table(groups, name, handle, 0);
  end_table(groups);
}

}  // namespace

void append_tables(std::string& out, const DxfDocument& document) {
  Groups groups(out);
  const LineTypes types = line_types(document.layers);
  append_viewports(groups, document.model);
  append_line_types(groups, types.all, first_line_type(document.layers.size()));
  append_layers(groups, document.layers, types);
  append_styles(groups);
  append_empty_table(groups, "VIEW", kViewTable);
  append_empty_table(groups, "UCS", kUcsTable);
  append_applications(groups);
  append_dimension_styles(groups);
  append_block_records(groups, document.papers);
}

}  // namespace strake::drawing::dxf
