// SPDX-License-Identifier: Apache-2.0
#include "drawing/lettering/true_type.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "drawing/lettering/font_bytes.hpp"

namespace strake::drawing {

namespace {

std::string_view part(std::string_view bytes, std::size_t at, std::size_t length) {
  return at < bytes.size() ? bytes.substr(at, length) : std::string_view();
}

void append_number(std::string& out, std::uint32_t value, std::size_t length) {
  for (std::size_t i = length; i > 0; --i) out += static_cast<char>(value >> (8 * (i - 1)) & 0xFFU);
}

void set_number(std::string& out, std::size_t at, std::uint32_t value, std::size_t length) {
  std::string bytes;
  append_number(bytes, value, length);
  out.replace(at, length, bytes);
}

/// Returns the sum of the words of a table, which lies at whole words.
std::uint32_t checksum(std::string_view bytes) {
  std::uint32_t sum = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 4) sum += u32(bytes, at);
  return sum;
}

/// Returns the table of characters for Unicode: of all planes, or else of the first.
std::string_view unicode_table(std::string_view cmap) {
  std::string_view first_plane;
  for (std::size_t i = 0; i < u16(cmap, 2); ++i) {
    const std::size_t at = 4 + 8 * i;
    const std::uint32_t platform = u16(cmap, at), encoding = u16(cmap, at + 2);
    const std::string_view found = part(cmap, u32(cmap, at + 4), std::string_view::npos);
    if (platform == 3 && encoding == 10 && u16(found, 0) == 12) return found;
    if (platform == 3 && encoding == 1 && u16(found, 0) == 4) first_plane = found;
  }
  return first_plane;
}

/// Looks a character up in a table of format 12: groups of characters whose glyphs follow each
/// other.
GlyphId glyph_of_groups(std::string_view table, std::uint32_t code) {
  std::size_t low = 0, high = u32(table, 12);
  while (low < high) {
    const std::size_t middle = (low + high) / 2, at = 16 + 12 * middle;
    if (code > u32(table, at + 4))
      low = middle + 1;
    else if (code < u32(table, at))
      high = middle;
    else
      return static_cast<GlyphId>(u32(table, at + 8) + code - u32(table, at));
  }
  return kMissingGlyph;
}

/// Looks a character up in a table of format 4: segments with a shift, or with a list of glyphs.
GlyphId glyph_of_segments(std::string_view table, std::uint32_t code) {
  if (code > 0xFFFF) return kMissingGlyph;
  const std::size_t count = u16(table, 6) / 2;
  const std::size_t ends = 14, starts = ends + 2 * count + 2, shifts = starts + 2 * count,
                    lists = shifts + 2 * count;
  for (std::size_t s = 0; s < count; ++s) {
    if (code > u16(table, ends + 2 * s)) continue;
    const std::uint32_t start = u16(table, starts + 2 * s);
    if (code < start) return kMissingGlyph;
    const std::uint32_t shift = u16(table, shifts + 2 * s), list = u16(table, lists + 2 * s);
    const std::uint32_t glyph =
        list == 0 ? code : u16(table, lists + 2 * s + list + std::size_t{2} * (code - start));
    return static_cast<GlyphId>(list != 0 && glyph == 0 ? 0 : glyph + shift);
  }
  return kMissingGlyph;
}

/// A table of the new file with its name.
using NamedTable = std::pair<std::string_view, std::string>;

/// Puts tables together as a file; `tables` are in the order of their names.
std::string file_of(const std::vector<NamedTable>& tables) {
  std::uint32_t power = 1, log = 0;
  while (power * 2 <= tables.size()) power *= 2, ++log;
  const auto count = static_cast<std::uint32_t>(tables.size());
  std::string head, body;
  append_number(head, 0x00010000, 4);
  for (const std::uint32_t value : {count, power * 16, log, count * 16 - power * 16})
    append_number(head, value, 2);
  const std::size_t begin = head.size() + 16 * tables.size();
  for (const auto& [name, bytes] : tables) {
    head += name;
    append_number(head, checksum(bytes), 4);
    append_number(head, static_cast<std::uint32_t>(begin + body.size()), 4);
    append_number(head, static_cast<std::uint32_t>(bytes.size()), 4);
    body += bytes;
    body.resize((body.size() + 3) / 4 * 4, '\0');
  }
  return head + body;
}

}  // namespace

TrueTypeFont::TrueTypeFont(std::string_view file) : file_(file) {
  characters_ = unicode_table(table("cmap"));
  widths_ = table("hmtx");
  places_ = table("loca");
  outlines_ = table("glyf");
  const std::uint32_t units = u16(table("head"), 18);
  per_size_ = units == 0 ? 1 : 1000.0 / units;
  width_count_ = std::max<std::size_t>(u16(table("hhea"), 34), 1);
  long_places_ = u16(table("head"), 50) != 0;
}

std::string_view TrueTypeFont::table(std::string_view tag) const {
  for (std::size_t i = 0; i < u16(file_, 4); ++i) {
    const std::size_t at = 12 + 16 * i;
    if (part(file_, at, 4) == tag) return part(file_, u32(file_, at + 8), u32(file_, at + 12));
  }
  return {};
}

std::size_t TrueTypeFont::glyph_count() const { return u16(table("maxp"), 4); }

GlyphId TrueTypeFont::glyph_of(std::uint32_t code) const {
  return u16(characters_, 0) == 12 ? glyph_of_groups(characters_, code)
                                   : glyph_of_segments(characters_, code);
}

double TrueTypeFont::advance(GlyphId glyph) const {
  // Glyphs beyond the list are as wide as the last in it.
  const std::size_t at = std::min<std::size_t>(glyph, width_count_ - 1);
  return u16(widths_, 4 * at) * per_size_;
}

TrueTypeFont::Metrics TrueTypeFont::metrics() const {
  const std::string_view head = table("head"), lines = table("hhea");
  Metrics found;
  for (std::size_t i = 0; i < 4; ++i) found.box.at(i) = i16(head, 36 + 2 * i) * per_size_;
  found.ascent = i16(lines, 4) * per_size_;
  found.descent = i16(lines, 6) * per_size_;
  // The top of a flat capital; not all files say it in a table of their own.
  found.cap_height = i16(outline(glyph_of('H')), 8) * per_size_;
  return found;
}

std::string_view TrueTypeFont::outline(GlyphId glyph) const {
  const auto place = [&](std::size_t g) -> std::size_t {
    return long_places_ ? u32(places_, 4 * g) : std::size_t{2} * u16(places_, 2 * g);
  };
  const std::size_t first = place(glyph), last = place(std::size_t{glyph} + 1);
  return last > first ? part(outlines_, first, last - first) : std::string_view();
}

std::set<GlyphId> TrueTypeFont::with_components(const std::set<GlyphId>& glyphs) const {
  std::set<GlyphId> all{kMissingGlyph};
  std::vector<GlyphId> open(glyphs.begin(), glyphs.end());
  open.push_back(kMissingGlyph);
  while (!open.empty()) {
    const GlyphId glyph = open.back();
    open.pop_back();
    all.insert(glyph);
    const std::string_view bytes = outline(glyph);
    if (i16(bytes, 0) >= 0) continue;  // an outline of its own
    for (GlyphComponents parts(bytes); const auto component = parts.next();)
      if (all.insert(component->glyph).second) open.push_back(component->glyph);
  }
  return all;
}

std::string TrueTypeFont::widths_of(const std::set<GlyphId>& glyphs) const {
  std::string kept(widths_.size(), '\0');
  for (const GlyphId glyph : glyphs) {
    const bool listed = glyph < width_count_;
    const std::size_t at = listed ? 4 * std::size_t{glyph} : 2 * (glyph + width_count_);
    const std::size_t length = listed ? 4 : 2;
    if (at + length <= widths_.size()) kept.replace(at, length, widths_.substr(at, length));
  }
  // What the glyphs beyond the list share.
  const std::size_t last = 4 * (width_count_ - 1);
  if (last + 4 <= widths_.size()) kept.replace(last, 2, widths_.substr(last, 2));
  return kept;
}

std::string TrueTypeFont::subset(const std::set<GlyphId>& glyphs) const {
  const std::set<GlyphId> kept = with_components(glyphs);
  std::string outlines, places;
  for (std::size_t g = 0; g <= glyph_count(); ++g) {
    append_number(places, static_cast<std::uint32_t>(outlines.size()), 4);
    const auto glyph = static_cast<GlyphId>(g);
    if (g == glyph_count() || !kept.contains(glyph)) continue;
    outlines += outline(glyph);
    outlines.resize((outlines.size() + 3) / 4 * 4, '\0');
  }
  std::string head(table("head"));
  head.resize(std::max<std::size_t>(head.size(), 54), '\0');
  set_number(head, 8, 0, 4);   // the check sum of the whole, which is known at last
  set_number(head, 50, 1, 2);  // places of four bytes
  std::vector<NamedTable> tables;
  for (const std::string_view tag :
       {"cvt ", "fpgm", "glyf", "head", "hhea", "hmtx", "loca", "maxp", "prep"})
    tables.emplace_back(tag, tag == "glyf"   ? outlines
                             : tag == "head" ? head
                             : tag == "hmtx" ? widths_of(kept)
                             : tag == "loca" ? places
                                             : std::string(table(tag)));
  std::string file = file_of(tables);
  constexpr std::uint32_t kWhole = 0xB1B0AFBA;
  const std::size_t head_at = u32(file, 12 + 16 * 3 + 8);  // the fourth table
  set_number(file, head_at + 8, kWhole - checksum(file), 4);
  return file;
}

}  // namespace strake::drawing
