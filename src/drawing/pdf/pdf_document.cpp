// SPDX-License-Identifier: Apache-2.0
#include "drawing/pdf/pdf_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "drawing/pdf/pdf_font.hpp"
#include "drawing/pdf/pdf_syntax.hpp"
#include "geometry/numeric/trig.hpp"

namespace strake::drawing {

namespace {

constexpr double kPointsPerMm = 72 / 25.4;
/// The longest side of a page that programs accept, points; what is larger has larger units.
constexpr double kLongestSide = 14400;

std::string number_text(double value, int decimals = 6) {
  std::string out;
  append_pdf_number(out, value, decimals);
  return out;
}

/// Returns by how much the units of a page are larger than points: 1 for all usual paper.
double unit_of(const PaperSize& paper) {
  const double longest = std::max(paper.width_mm, paper.height_mm) * kPointsPerMm;
  return std::max(1.0, std::ceil(longest / kLongestSide));
}

}  // namespace

PdfDocument::PdfDocument(Sink sink, std::string title, std::string facts)
    : file_(sink),
      title_(std::move(title)),
      facts_(std::move(facts)),
      catalog_(file_.reserve()),
      pages_number_(file_.reserve()),
      resources_(file_.reserve()),
      font_(file_.reserve()) {}

void PdfDocument::begin_page(const PaperSize& paper, std::string_view title) {
  end_page();
  const double scale = kPointsPerMm / unit_of(paper);
  pages_.push_back({.title = std::string(title),
                    .number = file_.reserve(),
                    .scale = scale,
                    .height = paper.height_mm * scale,
                    .layers = {},
                    .bookmarks = {},
                    .contents = {},
                    .paper = paper});
  const std::string s = number_text(scale, 12);
  add("q\n" + s + " 0 0 -" + s + " 0 " + number_text(pages_.back().height) + " cm\n1 J 1 j\n");
}

void PdfDocument::end_page() {
  if (pages_.empty()) return;
  add("Q\n");
  const Page& page = pages_.back();
  std::string contents;
  for (const std::uint32_t number : page.contents) contents += pdf_reference(number) + "\n";
  const double unit = unit_of(page.paper);
  file_.write_object(
      page.number,
      fmt::format("<</Type/Page/Parent {}/MediaBox[0 0 {} {}]{}/Resources {}/Contents[{}]>>",
                  pdf_reference(pages_number_), number_text(page.paper.width_mm * page.scale),
                  number_text(page.height), unit > 1 ? "/UserUnit " + number_text(unit) : "",
                  pdf_reference(resources_), contents));
}

void PdfDocument::add_bookmark(std::string_view title, const PaperFrame& part) {
  Page& page = pages_.back();
  std::string target = "/FitR ";
  for (const double side : {part.left * page.scale, page.height - part.bottom * page.scale,
                            part.right * page.scale, page.height - part.top * page.scale})
    target += number_text(side, 3) + " ";
  page.bookmarks.push_back({std::string(title), std::move(target)});
}

PdfLayerId PdfDocument::add_layer(std::string_view label, std::optional<PdfLayerId> parent) {
  const PdfLayerId id = layers_.size();
  layers_.push_back({std::string(label), file_.reserve(), parent, {}});
  (parent ? layers_[*parent].children : pages_.back().layers).push_back(id);
  return id;
}

std::string PdfDocument::open(PdfLayerId layer) const {
  const std::string above = layers_[layer].parent ? open(*layers_[layer].parent) : std::string();
  return above + open_alone(layer);
}

std::string PdfDocument::open_alone(PdfLayerId layer) {
  return fmt::format("/OC/L{} BDC\n", layer);
}

std::string PdfDocument::close(PdfLayerId layer) const {
  const std::string above = layers_[layer].parent ? close(*layers_[layer].parent) : std::string();
  return "EMC\n" + above;
}

double PdfDocument::width_of(std::string_view text) { return letterer_.set(text).width; }

double PdfDocument::append_text_at_origin(std::string& out, std::string_view text) {
  const LetteredText set = letterer_.set(text);
  // Who copies the text gets what it says, whatever is shown of it.
  if (set.lacking) out += "/Span<</ActualText " + pdf_text(set.text) + ">>BDC\n";
  out += "/F1 1 Tf <";
  for (const GlyphId glyph : set.glyphs) out += fmt::format("{:04X}", glyph);
  out += "> Tj\n";
  if (set.lacking) out += "EMC\n";
  return set.width;
}

void PdfDocument::append_text(std::string& out, std::string_view text, const PdfTextPlace& place) {
  if (text.empty()) return;
  std::string letters;
  const double width = append_text_at_origin(letters, text) * place.size_mm;
  out += "BT\n" + pdf_color(place.color) + "rg\n";
  const double before = place.anchor * width;
  if (place.turn_deg == 0) {
    const std::string size = number_text(place.size_mm, 3);
    out += size + " 0 0 -" + size + " ";
    append_pdf_point(out, {place.at.x - before, place.at.y});
  } else {
    const auto turn = geometry::sin_cos(place.turn_deg * geometry::kPi / 180);
    const double x = place.size_mm * turn.cos, y = place.size_mm * turn.sin;
    for (const double part : {x, -y, -y, -x}) {
      append_pdf_number(out, part, 6);
      out += ' ';
    }
    append_pdf_point(out, {place.at.x - before * turn.cos, place.at.y + before * turn.sin});
  }
  out += "Tm\n" + letters + "ET\n";
}

void PdfDocument::add_deflated(std::string_view bytes) {
  const std::uint32_t number = file_.reserve();
  file_.write_stream(number, "", bytes);
  pages_.back().contents.push_back(number);
}

void PdfDocument::add(std::string_view operators) { add_deflated(deflated(operators)); }

std::string PdfDocument::order_of(const std::vector<PdfLayerId>& layers) const {
  std::string order;
  for (const PdfLayerId id : layers) {
    order += pdf_reference(layers_[id].number) + "\n";
    if (!layers_[id].children.empty()) order += "[" + order_of(layers_[id].children) + "]\n";
  }
  return order;
}

/// Writes the layers; returns what the catalog says of them.
std::string PdfDocument::write_layers() {
  if (layers_.empty()) return {};
  std::string all, order;
  for (const Layer& layer : layers_) {
    file_.write_object(layer.number, "<</Type/OCG/Name" + pdf_text(layer.label) + ">>");
    all += pdf_reference(layer.number) + "\n";
  }
  for (const Page& page : pages_) {
    const std::string layers = order_of(page.layers);
    if (pages_.size() == 1 || layers.empty())
      order += layers;
    else
      order += "[" + pdf_text(page.title) + layers + "]\n";
  }
  return fmt::format("/OCProperties<</OCGs[{}]/D<</Name(Layers)/Order[{}]/ListMode/AllPages>>>>",
                     all, order);
}

/// Writes the bookmarks: one for each page, below it those of its parts.
std::uint32_t PdfDocument::write_bookmarks() {
  const std::uint32_t root = file_.reserve();
  std::vector<std::uint32_t> numbers;
  std::size_t open = pages_.size();
  for (const Page& page : pages_) {
    numbers.push_back(file_.reserve());
    open += page.bookmarks.size();
  }
  const auto item = [&](std::uint32_t number, std::string_view title, std::uint32_t parent,
                        const std::string& rest) {
    file_.write_object(number, fmt::format("<</Title{}/Parent {}{}>>", pdf_text(title),
                                           pdf_reference(parent), rest));
  };
  const auto neighbours = [](const std::vector<std::uint32_t>& row, std::size_t i) {
    std::string text;
    if (i > 0) text += "/Prev " + pdf_reference(row[i - 1]);
    if (i + 1 < row.size()) text += "/Next " + pdf_reference(row[i + 1]);
    return text;
  };
  for (std::size_t p = 0; p < pages_.size(); ++p) {
    const Page& page = pages_[p];
    std::vector<std::uint32_t> below;
    for (std::size_t b = 0; b < page.bookmarks.size(); ++b) below.push_back(file_.reserve());
    std::string rest = neighbours(numbers, p) + "/Dest[" + pdf_reference(page.number) + "/Fit]";
    if (!below.empty())
      rest += fmt::format("/First {}/Last {}/Count {}", pdf_reference(below.front()),
                          pdf_reference(below.back()), below.size());
    item(numbers[p], page.title, root, rest);
    for (std::size_t b = 0; b < below.size(); ++b)
      item(below[b], page.bookmarks[b].title, numbers[p],
           neighbours(below, b) + "/Dest[" + pdf_reference(page.number) + page.bookmarks[b].target +
               "]");
  }
  file_.write_object(
      root, fmt::format("<</Type/Outlines/First {}/Last {}/Count {}>>",
                        pdf_reference(numbers.front()), pdf_reference(numbers.back()), open));
  return root;
}

std::uint32_t PdfDocument::write_metadata() {
  const std::uint32_t number = file_.reserve();
  file_.write_stream(
      number, "/Type/Metadata/Subtype/XML",
      deflated(fmt::format(
          "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
          "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
          "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
          "<rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\" "
          "xmlns:strake=\"urn:strake:drawing:1\">\n"
          "<dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">{}</rdf:li></rdf:Alt></dc:title>\n"
          "<strake:views><rdf:Seq>\n{}</rdf:Seq></strake:views>\n</rdf:Description>\n</rdf:RDF>\n</"
          "x:xmpmeta>\n<?xpacket end=\"r\"?>\n",
          xml_escaped(title_), facts_)));
  return number;
}

Diagnostics PdfDocument::finish() {
  end_page();
  std::string kids, properties;
  for (const Page& page : pages_) kids += pdf_reference(page.number) + "\n";
  for (PdfLayerId id = 0; id < layers_.size(); ++id)
    properties += fmt::format("/L{} {}\n", id, pdf_reference(layers_[id].number));
  file_.write_object(pages_number_,
                     fmt::format("<</Type/Pages/Count {}/Kids[{}]>>", pages_.size(), kids));
  write_pdf_font(file_, font_, letterer_);
  file_.write_object(resources_, fmt::format("<</Font<</F1 {}>>/Properties<<{}>>>>",
                                             pdf_reference(font_), properties));
  const std::string layers = write_layers();
  const std::uint32_t bookmarks = write_bookmarks(), metadata = write_metadata();
  const std::uint32_t info = file_.reserve();
  file_.write_object(info, "<</Title" + pdf_text(title_) + "/Creator(Strake)/Producer(Strake)>>");
  file_.write_object(
      catalog_,
      fmt::format("<</Type/Catalog/Pages {}/Outlines {}/PageMode/{}/Metadata {}"
                  "/ViewerPreferences<</DisplayDocTitle true>>{}>>",
                  pdf_reference(pages_number_), pdf_reference(bookmarks),
                  pages_.size() > 1 ? "UseOutlines" : "UseOC", pdf_reference(metadata), layers));
  file_.finish(catalog_, info);
  return letterer_.diagnostics();
}

}  // namespace strake::drawing
