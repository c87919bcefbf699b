// SPDX-License-Identifier: Apache-2.0
// A DXF file round its entities: header, tables and blocks before them, layouts behind.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "drawing/dxf/groups.hpp"
#include "drawing/dxf/handles.hpp"
#include "drawing/dxf/layer_style.hpp"
#include "strake/drawing/drawing.hpp"

namespace strake::drawing::dxf {

/// A box with y upwards; empty where left is greater than right.
struct DxfExtent {
  double left = 1e20, bottom = 1e20, right = -1e20, top = -1e20;
  [[nodiscard]] bool empty() const { return left > right; }
  [[nodiscard]] double width() const { return right - left; }
  [[nodiscard]] double height() const { return top - bottom; }
  [[nodiscard]] PaperPoint middle() const { return {(left + right) / 2, (bottom + top) / 2}; }
  void include(const PaperPoint& point);
};

/// A layout of paper, with the handles of what it takes.
struct PaperLayout {
  std::string name;  ///< that no other layout has, whatever the case of its letters
  double width_mm = 420, height_mm = 297;
  Handle record = kPaperSpace, begin = kPaperBlock, end = kPaperBlockEnd, layout = kPaperLayout;
  Handle paper = kFirstEntity;  ///< the viewport that is the paper itself
  /// Its entities, where it is not the first layout, whose entities stand with those of model
  /// space.
  std::string_view entities = {};
};

/// Returns the name of the block of the layout of that number, counted from 0.
[[nodiscard]] std::string name_of_paper_block(std::size_t number);

/// What a file says of itself before its first entity.
struct DxfDocument {
  std::vector<LayerStyle> layers;
  std::vector<PaperLayout> papers;  ///< one at least
  bool opens_on_paper = false;      ///< shows the first sheet first, not model space
  DxfExtent model;                  ///< of all that lies in model space
  Handle next = kFirstEntity;       ///< greater than every handle of an entity
};

/// Appends what stands before the entities, and the beginning of their section.
void append_dxf_head(std::string& out, const DxfDocument& document);

/// Appends the end of their section, and what stands behind.
void append_dxf_tail(std::string& out, const DxfDocument& document);

}  // namespace strake::drawing::dxf
