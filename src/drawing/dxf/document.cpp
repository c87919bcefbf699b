// SPDX-License-Identifier: Apache-2.0
#include "drawing/dxf/document.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "drawing/dxf/handles.hpp"
#include "drawing/dxf/tables.hpp"

namespace strake::drawing::dxf {

namespace {

void begin_section(Groups& groups, std::string_view name) {
  groups.text(0, "SECTION").text(2, name);
}

void append_header(Groups& groups, const DxfDocument& document) {
  constexpr int kMillimetres = 4;
  const auto variable = [&](std::string_view name) { groups.text(9, name); };
  begin_section(groups, "HEADER");
  variable("$ACADVER");
  groups.text(1, "AC1021");
  // The text is UTF-8, as this version has it: the code page is for names of fonts.
  variable("$DWGCODEPAGE");
  groups.text(3, "ANSI_1252");
  variable("$INSBASE");
  groups.point_in_space(10, 0, 0);
  const DxfExtent& model = document.model;
  variable("$EXTMIN");
  groups.point_in_space(10, model.left, model.bottom);
  variable("$EXTMAX");
  groups.point_in_space(10, model.right, model.top);
  variable("$LTSCALE");
  groups.whole(40, 1);
  variable("$TEXTSTYLE");
  groups.text(7, kTextStyle);
  variable("$CLAYER");
  groups.text(8, "0");
  variable("$MEASUREMENT");
  groups.whole(70, 1);
  variable("$INSUNITS");
  groups.whole(70, kMillimetres);
  variable("$LUNITS");
  groups.whole(70, 2);
  variable("$LUPREC");
  groups.whole(70, 3);
  variable("$LWDISPLAY");
  groups.whole(290, 1);
  variable("$PEXTMIN");
  groups.point_in_space(10, 0, 0);
  variable("$PEXTMAX");
  const PaperLayout& paper = document.papers.front();
  groups.point_in_space(10, paper.width_mm, paper.height_mm);
  variable("$PLIMMIN");
  groups.point(10, 0, 0);
  variable("$PLIMMAX");
  groups.point(10, paper.width_mm, paper.height_mm);
  // Dashes are as long on paper as the layers say, whatever the scale of a viewport is.
  variable("$PSLTSCALE");
  groups.whole(70, 1);
  variable("$TILEMODE");
  groups.whole(70, document.opens_on_paper ? 0 : 1);
  variable("$HANDSEED");
  groups.handle(5, document.next);
  groups.text(0, "ENDSEC");
}

void append_classes(Groups& groups) {
  struct Class {
    std::string_view name, type, application = "ObjectDBX Classes";
    bool is_entity = false;
  };
  begin_section(groups, "CLASSES");
  for (const Class& c : {Class{"ACDBDICTIONARYWDFLT", "AcDbDictionaryWithDefault"},
                         Class{"ACDBPLACEHOLDER", "AcDbPlaceHolder"}, Class{"LAYOUT", "AcDbLayout"},
                         Class{"WIPEOUTVARIABLES", "AcDbWipeoutVariables", "WipeOut"},
                         Class{"WIPEOUT", "AcDbWipeout", "WipeOut", true}})
    groups.text(0, "CLASS")
        .text(1, c.name)
        .text(2, c.type)
        .text(3, c.application)
        .whole(90, c.is_entity ? 127 : 0)
        .whole(91, 0)
        .whole(280, 0)
        .whole(281, c.is_entity ? 1 : 0);
  groups.text(0, "ENDSEC");
}

/// Appends the block of a space, with the entities that stand in it.
void append_block(std::string& out, std::string_view name, const PaperLayout& block,
                  bool on_paper) {
  Groups groups(out);
  const auto entity = [&](std::string_view type, Handle handle) {
    groups.text(0, type).handle(5, handle).handle(330, block.record).text(100, "AcDbEntity");
    if (on_paper) groups.whole(67, 1);
    groups.text(8, "0");
  };
  entity("BLOCK", block.begin);
  groups.text(100, "AcDbBlockBegin")
      .text(2, name)
      .whole(70, 0)
      .point_in_space(10, 0, 0)
      .text(3, name)
      .text(1, "");
  out += block.entities;
  entity("ENDBLK", block.end);
  groups.text(100, "AcDbBlockEnd");
}

/// Model space as if it were a layout of paper.
PaperLayout model_block() {
  return {.name = "Model",
          .record = kModelSpace,
          .begin = kModelBlock,
          .end = kModelBlockEnd,
          .layout = kModelLayout};
}

Groups& begin_dictionary(Groups& groups, Handle handle, Handle owner) {
  return groups.text(0, "DICTIONARY")
      .handle(5, handle)
      .handle(330, owner)
      .text(100, "AcDbDictionary")
      .whole(281, 1);
}

/// Model space or a layout of paper.
struct Layout {
  const PaperLayout& paper;
  std::int64_t number;
  DxfExtent extent;
};

void append_layout(Groups& groups, const Layout& layout) {
  constexpr int kModelKind = 1024, kLineWeights = 128, kPlotStyles = 32, kPaperLast = 512;
  const bool is_model = layout.number == 0;
  const PaperLayout& paper = layout.paper;
  groups.text(0, "LAYOUT")
      .handle(5, paper.layout)
      .handle(330, kLayouts)
      .text(100, "AcDbPlotSettings")
      .text(1, "")
      .text(2, "none_device")
      .text(4, "")
      .text(6, "");
  for (const int margin : {40, 41, 42, 43}) groups.whole(margin, 0);
  groups.number(44, paper.width_mm).number(45, paper.height_mm);
  for (const int offset : {46, 47, 48, 49, 140, 141}) groups.whole(offset, 0);
  groups.whole(142, 1)
      .whole(143, 1)
      .whole(70, kLineWeights + kPlotStyles + (is_model ? kModelKind : kPaperLast))
      .whole(72, 1)                 // millimetres
      .whole(73, 0)                 // not turned
      .whole(74, is_model ? 1 : 5)  // all that there is, or the layout
      .text(7, "")
      .whole(75, 16)  // 1:1
      .whole(76, 0)
      .whole(77, 2)
      .whole(78, 300)
      .whole(147, 1)
      .whole(148, 0)
      .whole(149, 0);
  groups.text(100, "AcDbLayout")
      .text(1, paper.name)
      .whole(70, 1)
      .whole(71, layout.number)
      .point(10, 0, 0)
      .point(11, paper.width_mm, paper.height_mm)
      .point_in_space(12, 0, 0)
      .point_in_space(14, layout.extent.left, layout.extent.bottom)
      .point_in_space(15, layout.extent.right, layout.extent.top)
      .whole(146, 0)
      .point_in_space(13, 0, 0)
      .point_in_space(16, 1, 0)
      .point_in_space(17, 0, 1)
      .whole(76, 0)
      .handle(330, paper.record);
  if (!is_model) groups.handle(331, paper.paper);
}

void append_objects(Groups& groups, const DxfDocument& document) {
  begin_section(groups, "OBJECTS");
  begin_dictionary(groups, kRoot, 0);
  const auto entry = [&](std::string_view name, Handle handle) {
    groups.text(3, name).handle(350, handle);
  };
  entry("ACAD_GROUP", kGroups);
  entry("ACAD_LAYOUT", kLayouts);
  entry("ACAD_MLINESTYLE", kLineStyles);
  entry("ACAD_PLOTSTYLENAME", kPlotStyles);
  entry("ACAD_WIPEOUT_VARS", kWipeoutVariables);
  begin_dictionary(groups, kGroups, kRoot);
  begin_dictionary(groups, kLayouts, kRoot);
  entry("Model", kModelLayout);
  for (const PaperLayout& paper : document.papers) entry(paper.name, paper.layout);
  begin_dictionary(groups, kLineStyles, kRoot);
  entry("Standard", kLineStyle);
  groups.text(0, "ACDBDICTIONARYWDFLT")
      .handle(5, kPlotStyles)
      .handle(330, kRoot)
      .text(100, "AcDbDictionary")
      .whole(281, 1);
  entry("Normal", kNormalPlotStyle);
  groups.text(100, "AcDbDictionaryWithDefault").handle(340, kNormalPlotStyle);
  groups.text(0, "ACDBPLACEHOLDER").handle(5, kNormalPlotStyle).handle(330, kPlotStyles);
  // Areas that cover what lies below are drawn without frames.
  groups.text(0, "WIPEOUTVARIABLES")
      .handle(5, kWipeoutVariables)
      .handle(330, kRoot)
      .text(100, "AcDbWipeoutVariables")
      .whole(70, 0);
  groups.text(0, "MLINESTYLE")
      .handle(5, kLineStyle)
      .handle(330, kLineStyles)
      .text(100, "AcDbMlineStyle")
      .text(2, "Standard")
      .whole(70, 0)
      .text(3, "")
      .whole(62, 256)
      .whole(51, 90)
      .whole(52, 90)
      .whole(71, 2);
  for (const double side : {0.5, -0.5}) groups.number(49, side).whole(62, 256).text(6, "BYLAYER");
  PaperLayout model = model_block();
  model.width_mm = document.papers.front().width_mm;
  model.height_mm = document.papers.front().height_mm;
  append_layout(groups, {model, 0, document.model});
  std::int64_t number = 0;
  for (const PaperLayout& paper : document.papers) {
    DxfExtent extent;
    extent.include({0, 0});
    extent.include({paper.width_mm, paper.height_mm});
    append_layout(groups, {paper, ++number, extent});
  }
  groups.text(0, "ENDSEC");
}

}  // namespace

void DxfExtent::include(const PaperPoint& point) {
  left = std::min(left, point.x);
  right = std::max(right, point.x);
  bottom = std::min(bottom, point.y);
  top = std::max(top, point.y);
}

std::string name_of_paper_block(std::size_t number) {
  return "*Paper_Space" + (number == 0 ? std::string() : std::to_string(number - 1));
}

void append_dxf_head(std::string& out, const DxfDocument& document) {
  Groups groups(out);
  append_header(groups, document);
  append_classes(groups);
  begin_section(groups, "TABLES");
  append_tables(out, document);
  groups.text(0, "ENDSEC");
  begin_section(groups, "BLOCKS");
  append_block(out, "*Model_Space", model_block(), false);
  for (std::size_t p = 0; p < document.papers.size(); ++p)
    append_block(out, name_of_paper_block(p), document.papers[p], true);
  groups.text(0, "ENDSEC");
  begin_section(groups, "ENTITIES");
}

void append_dxf_tail(std::string& out, const DxfDocument& document) {
  Groups groups(out);
  groups.text(0, "ENDSEC");
  append_objects(groups, document);
  groups.text(0, "EOF");
}

}  // namespace strake::drawing::dxf
