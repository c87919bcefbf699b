// SPDX-License-Identifier: Apache-2.0
// A PDF of drawings: pages of paper, layers to switch, bookmarks, and texts in a font of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drawing/lettering/lettering.hpp"
#include "drawing/pdf/pdf_file.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/write.hpp"
#include "strake/model/model.hpp"

namespace strake::drawing {

using PdfLayerId = std::size_t;

/// Where a text stands on the sheet.
struct PdfTextPlace {
  PaperPoint at;       ///< a point of its base line
  double size_mm = 5;  ///< size of the font
  double anchor = 0;   ///< part of its width that lies before `at`: 0, 0.5 or 1
  model::Color color{0, 0, 0, 255};
  double turn_deg = 0;  ///< about `at`, against the clock
};

/// Writes a document page by page. Contents are operators in millimetres of the sheet, x to the
/// right, y down, with round caps and joins. What the sink throws comes out; it must outlive the
/// document.
class PdfDocument {
 public:
  /// `facts` are what the metadata say of the views, one pdf_facts() after another.
  PdfDocument(Sink sink, std::string title, std::string facts);

  /// Begins a page; the one before ends. Its title stands among the bookmarks, and above its
  /// layers where the document has several pages.
  void begin_page(const PaperSize& paper, std::string_view title);
  /// Adds a bookmark below that of the page, to a part of it.
  void add_bookmark(std::string_view title, const PaperFrame& part);

  /// Adds a layer of the page, below another one if one is given: it is seen where all above it are
  /// switched on.
  [[nodiscard]] PdfLayerId add_layer(std::string_view label,
                                     std::optional<PdfLayerId> parent = std::nullopt);
  /// Returns the operators that begin the contents of a layer, and those that end them.
  [[nodiscard]] std::string open(PdfLayerId layer) const;
  [[nodiscard]] std::string close(PdfLayerId layer) const;
  /// Returns the operator that begins contents of a layer whatever is above it; "EMC" ends them.
  [[nodiscard]] static std::string open_alone(PdfLayerId layer);

  /// Appends the operators that write a text on one line.
  void append_text(std::string& out, std::string_view text, const PdfTextPlace& place);
  /// Returns the width of a text in sizes of the font.
  [[nodiscard]] double width_of(std::string_view text);
  /// Appends the same in a place that the text matrix says: the base line begins at the origin,
  /// y up, and the font has the size 1. Returns the width.
  double append_text_at_origin(std::string& out, std::string_view text);

  /// Adds contents to the page, compressed by deflated().
  void add_deflated(std::string_view bytes);
  void add(std::string_view operators);

  /// Ends the document. Returns the characters of texts that could not be shown.
  [[nodiscard]] Diagnostics finish();

 private:
  struct Layer {
    std::string label;
    std::uint32_t number = 0;
    std::optional<PdfLayerId> parent;
    std::vector<PdfLayerId> children;
  };
  struct Bookmark {
    std::string title, target;
  };
  struct Page {
    std::string title;
    std::uint32_t number = 0;
    double scale = 1;                ///< points of the page per millimetre
    double height = 0;               ///< points
    std::vector<PdfLayerId> layers;  ///< those that no other holds
    std::vector<Bookmark> bookmarks;
    std::vector<std::uint32_t> contents;
    PaperSize paper;
  };

  void end_page();
  [[nodiscard]] std::string order_of(const std::vector<PdfLayerId>& layers) const;
  [[nodiscard]] std::string write_layers();
  [[nodiscard]] std::uint32_t write_bookmarks();
  [[nodiscard]] std::uint32_t write_metadata();

  PdfFile file_;
  Letterer letterer_;
  std::string title_, facts_;
  std::uint32_t catalog_, pages_number_, resources_, font_;
  std::vector<Layer> layers_;
  std::vector<Page> pages_;
};

}  // namespace strake::drawing
