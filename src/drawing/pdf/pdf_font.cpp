// SPDX-License-Identifier: Apache-2.0
#include "drawing/pdf/pdf_font.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "drawing/pdf/pdf_syntax.hpp"
#include "strake/core/hash.hpp"

namespace strake::drawing {

namespace {

std::set<GlyphId> glyphs_of(const Letterer& letterer) {
  std::set<GlyphId> glyphs{kMissingGlyph};
  for (const auto& [glyph, code] : letterer.used()) glyphs.insert(glyph);
  return glyphs;
}

/// Returns the six capitals that a subset's name begins with, which tell subsets of other glyphs
/// apart.
std::string tag_of(const std::set<GlyphId>& glyphs) {
  WordHash hash;
  for (const GlyphId glyph : glyphs) hash.add(glyph);
  std::uint64_t rest = hash.value().low;
  std::string tag;
  for (int i = 0; i < 6; ++i, rest /= 26) tag += static_cast<char>('A' + rest % 26);
  return tag;
}

/// Returns the widths by glyph: "[3 [318] 36 [684]]".
std::string widths_of(const TrueTypeFont& font, const std::set<GlyphId>& glyphs) {
  std::string text;
  for (const GlyphId glyph : glyphs) {
    text += fmt::format("{}[", glyph);
    append_pdf_number(text, font.advance(glyph), 3);
    text += "]\n";
  }
  return text;
}

/// Returns a character as the hexadecimal digits of UTF-16.
std::string utf16_digits(std::uint32_t code) {
  if (code < 0x10000) return fmt::format("{:04X}", code);
  return fmt::format("{:04X}{:04X}", 0xD800U + ((code - 0x10000U) >> 10U),
                     0xDC00U + ((code - 0x10000U) & 0x3FFU));
}

/// Returns the map from glyphs to characters, by which programs search and copy.
std::string to_unicode(const Letterer& letterer) {
  std::vector<std::string> rows;
  for (const auto& [glyph, code] : letterer.used())
    rows.push_back(fmt::format("<{:04X}> <{}>\n", glyph, utf16_digits(code)));
  std::string text =
      "/CIDInit /ProcSet findresource begin\n12 dict begin\nbegincmap\n"
      "/CIDSystemInfo <</Registry (Adobe) /Ordering (UCS) /Supplement 0>> def\n"
      "/CMapName /Adobe-Identity-UCS def\n/CMapType 2 def\n"
      "1 begincodespacerange\n<0000> <FFFF>\nendcodespacerange\n";
  constexpr std::size_t kMaxRows = 100;  // that one block may have
  for (std::size_t i = 0; i < rows.size(); i += kMaxRows) {
    const std::size_t n = std::min(kMaxRows, rows.size() - i);
    text += fmt::format("{} beginbfchar\n", n);
    for (std::size_t r = i; r < i + n; ++r) text += rows[r];
    text += "endbfchar\n";
  }
  return text + "endcmap\nCMapName currentdict /CMap defineresource pop\nend\nend\n";
}

}  // namespace

void write_pdf_font(PdfFile& file, std::uint32_t number, const Letterer& letterer) {
  const TrueTypeFont& font = letterer.font();
  const std::set<GlyphId> glyphs = glyphs_of(letterer);
  const std::string name = tag_of(glyphs) + "+DejaVuSans";
  const std::uint32_t descendant = file.reserve(), descriptor = file.reserve(),
                      program = file.reserve(), unicode = file.reserve();
  file.write_object(number, fmt::format("<</Type/Font/Subtype/Type0/BaseFont/{}/Encoding/Identity-H"
                                        "/DescendantFonts[{}]/ToUnicode {}>>",
                                        name, pdf_reference(descendant), pdf_reference(unicode)));
  file.write_object(descendant,
                    fmt::format("<</Type/Font/Subtype/CIDFontType2/BaseFont/{}/CIDToGIDMap/Identity"
                                "/CIDSystemInfo<</Registry(Adobe)/Ordering(Identity)/Supplement 0>>"
                                "/FontDescriptor {}/DW 1000/W[{}]>>",
                                name, pdf_reference(descriptor), widths_of(font, glyphs)));
  const TrueTypeFont::Metrics metrics = font.metrics();
  std::string box;
  for (const double side : metrics.box) append_pdf_number(box, side, 0), box += ' ';
  std::string measures;
  for (const auto& [key, value] : {std::pair{"/Ascent ", metrics.ascent},
                                   {"/Descent ", metrics.descent},
                                   {"/CapHeight ", metrics.cap_height}}) {
    measures += key;
    append_pdf_number(measures, value, 0);
  }
  file.write_object(descriptor,
                    fmt::format("<</Type/FontDescriptor/FontName/{}/Flags 4/FontBBox[{}]"
                                "/ItalicAngle 0{}/StemV 80/FontFile2 {}>>",
                                name, box, measures, pdf_reference(program)));
  const std::string subset = font.subset(glyphs);
  file.write_stream(program, fmt::format("/Length1 {}", subset.size()), deflated(subset));
  file.write_stream(unicode, "", deflated(to_unicode(letterer)));
}

}  // namespace strake::drawing
