// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TDF_Label.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <optional>
#include <string>
#include <vector>

#include "strake/model/model.hpp"

namespace strake::import_step {

/// The labels of a document, and what is asked of them.
struct Labels {
  explicit Labels(const Handle(TDocStd_Document) & document);

  /// Returns the name of a label; empty where it has none, or one that Open CASCADE made up.
  [[nodiscard]] static std::string name_of(const TDF_Label& label);
  /// Whether an assembly is none: Open CASCADE makes one of a product that has solids beside curves
  /// or surfaces, with parts that the file does not name.
  [[nodiscard]] static bool is_product_in_pieces(const TDF_Label& assembly);
  /// Returns the name of an instance where it says more than that of its product, which exporters
  /// often repeat or number: "NAUO12".
  [[nodiscard]] static std::string instance_name(const TDF_Label& instance,
                                                 const std::string& product);
  [[nodiscard]] std::optional<model::Color> color_of_label(const TDF_Label& label) const;
  /// Returns the colour that one occurrence has of its own, whatever all others of its part have:
  /// `chain` are the instances that lead to it, the outermost first.
  [[nodiscard]] std::optional<model::Color> color_of_occurrence(
      const std::vector<TDF_Label>& chain) const;
  /// Returns the names of the layers of a label, "; " between several.
  [[nodiscard]] std::string layers_of(const TDF_Label& label) const;
  [[nodiscard]] static std::string material_of(const TDF_Label& label);

  Handle(XCAFDoc_ShapeTool) shapes;
  Handle(XCAFDoc_ColorTool) colors;
  Handle(XCAFDoc_LayerTool) layers;
};

}  // namespace strake::import_step
