// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "pictures/clash_picture.hpp"
#include "pictures/output/png.hpp"
#include "strake/drawing/write.hpp"

namespace strake::pictures {
namespace {

constexpr int kDecimals = 3;  // of a millimetre

std::string number(double mm) {
  std::string text = fixed(mm, kDecimals);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string hex(const Colour& colour) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out = "#";
  for (const unsigned channel : {colour.red, colour.green, colour.blue}) {
    out += kDigits[channel >> 4U];
    out += kDigits[channel & 0xfU];
  }
  return out;
}

class SvgWriter {
 public:
  SvgWriter(const ClashPicture& picture, report::Sink sink) : picture_(picture), sink_(sink) {}

  Status write() {
    head();
    if (const Status status = shade(); !status) return status;
    lines();
    for (const PictureRing& ring : picture_.rings) add(ring);
    for (const PictureBlock& block : picture_.blocks) add(block);
    for (const PictureText& text : picture_.texts) add(text);
    out_ += "</svg>\n";
    sink_(out_);
    return {};
  }

 private:
  void attribute(std::string_view name, double mm) {
    out_ += ' ';
    out_ += name;
    out_ += "=\"" + number(mm) + '"';
  }

  void head() {
    const std::string width = number(picture_.width_mm), height = number(picture_.height_mm);
    out_ += "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "mm\" height=\"" +
            height + "mm\" viewBox=\"0 0 " + width + ' ' + height + "\">\n<title>" +
            drawing::xml_escaped(picture_.title) + "</title>\n<rect width=\"" + width +
            "\" height=\"" + height + "\" fill=\"#ffffff\"/>\n";
  }

  Status shade() {
    const Shade& shade = picture_.shade;
    if (shade.points.empty()) return {};
    std::vector<std::uint8_t> bytes;
    bytes.reserve(shade.points.size() * 3);
    for (const Colour& c : shade.points) bytes.insert(bytes.end(), {c.red, c.green, c.blue});
    const Result<std::string> png = encode_png(shade.width, shade.height, bytes);
    if (!png) return png.error();
    out_ += "<image preserveAspectRatio=\"none\"";
    attribute("width", picture_.width_mm);
    attribute("height", picture_.view_mm);
    out_ += " href=\"data:image/png;base64,";
    append_base64(out_, std::span(reinterpret_cast<const std::uint8_t*>(png->data()), png->size()));
    out_ += "\"/>\n";
    return {};
  }

  /// Writes lines of one look as one path; one that begins where the last ended goes on from there.
  void lines() {
    const std::vector<PictureLine>& lines = picture_.lines;
    const auto alike = [](const PictureLine& a, const PictureLine& b) {
      return a.width_mm == b.width_mm && a.colour == b.colour && a.dashed == b.dashed;
    };
    for (std::size_t first = 0, end = 0; first < lines.size(); first = end) {
      const PictureLine& style = lines[first];
      out_ += "<path fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\" stroke=\"" +
              hex(style.colour) + '"';
      attribute("stroke-width", style.width_mm);
      if (style.dashed) out_ += " stroke-dasharray=\"1.4 1\"";
      out_ += " d=\"";
      std::string at;
      for (; end < lines.size() && alike(style, lines[end]); ++end) {
        const std::string from = number(lines[end].a.x) + ' ' + number(lines[end].a.y);
        const std::string to = number(lines[end].b.x) + ' ' + number(lines[end].b.y);
        if (from != at) out_ += 'M' + from;
        out_ += 'L' + to;
        at = to;
      }
      out_ += "\"/>\n";
    }
  }

  void add(const PictureRing& ring) {
    out_ += "<circle";
    attribute("cx", ring.at.x);
    attribute("cy", ring.at.y);
    attribute("r", ring.radius_mm);
    if (ring.filled) {
      out_ += " fill=\"" + hex(ring.colour) + "\"/>\n";
      return;
    }
    attribute("stroke-width", ring.width_mm);
    out_ += " fill=\"none\" stroke=\"" + hex(ring.colour) + "\"/>\n";
  }

  void add(const PictureBlock& block) {
    out_ += "<rect";
    attribute("x", block.at.x);
    attribute("y", block.at.y);
    attribute("width", block.width_mm);
    attribute("height", block.height_mm);
    out_ += " fill=\"" + hex(block.colour) + "\"/>\n";
  }

  void add(const PictureText& text) {
    // The capitals of common fonts are so much lower than the font's size.
    constexpr double kCapitals = 0.72;
    out_ +=
        "<text xml:space=\"preserve\" font-family=\"Arial, Helvetica, 'DejaVu Sans', sans-serif\"";
    attribute("x", text.at.x);
    attribute("y", text.at.y);
    attribute("font-size", text.height_mm / kCapitals);
    if (text.centred) out_ += " text-anchor=\"middle\"";
    if (text.bold) out_ += " font-weight=\"bold\"";
    out_ += " fill=\"" + hex(text.colour) + "\">" + drawing::xml_escaped(text.text) + "</text>\n";
  }

  const ClashPicture& picture_;
  report::Sink sink_;
  std::string out_;
};

}  // namespace

Status write_svg(const ClashPicture& picture, report::Sink sink) {
  return SvgWriter(picture, sink).write();
}

}  // namespace strake::pictures
