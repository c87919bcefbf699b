// SPDX-License-Identifier: Apache-2.0
#include "sheets/template.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "sheets/lettering.hpp"
#include "sheets/references.hpp"
#include "sheets/xml_reader.hpp"
#include "strake/core/number.hpp"
#include "strake/core/units.hpp"
#include "strake/drawing/write.hpp"

namespace strake::sheets {

namespace {

constexpr std::array<std::string_view, 26> kElements{
    "svg",     "g",    "defs",  "symbol",         "use",           "title", "desc",
    "style",   "path", "rect",  "circle",         "ellipse",       "line",  "polyline",
    "polygon", "text", "tspan", "textPath",       "clipPath",      "mask",  "pattern",
    "marker",  "stop", "image", "linearGradient", "radialGradient"};
constexpr std::array<std::string_view, 5> kWithFields{"text", "tspan", "textPath", "title", "desc"};
constexpr std::array<std::string_view, 5> kAttributePrefixes{
    "xlink:href", "xml:space", "inkscape:label", "inkscape:groupmode", "xml:lang"};

template <std::size_t N>
bool among(const std::array<std::string_view, N>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string lowered(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

Error fault(std::size_t line, std::string message, std::string mend) {
  return {ErrorCode::input, std::move(message), "line " + std::to_string(line), std::move(mend)};
}

/// Why a value or a style sheet is more than drawing; empty where it is none.
std::string reaches_out(std::string_view text) {
  const std::string lower = lowered(text);
  for (const std::string_view word : {"@import", "javascript:", "expression(", "image-set("})
    if (lower.find(word) != std::string::npos) return std::string(word);
  for (std::size_t at = lower.find("url("); at != std::string::npos;
       at = lower.find("url(", at + 4)) {
    const std::size_t target = lower.find_first_not_of(" '\"", at + 4);
    if (target == std::string::npos || lower[target] != '#') return "url(...)";
  }
  return {};
}

/// As it will be written.
std::string id_of(const XmlEvent& event) {
  for (const auto& [key, value] : event.attributes)
    if (key == "id") return on_one_line(value);
  return {};
}

bool is_inside_reference(std::string_view element, std::string_view value) {
  if (value.starts_with('#')) return true;
  return element == "image" && (value.starts_with("data:image/png;base64,") ||
                                value.starts_with("data:image/jpeg;base64,"));
}

/// Writes the elements of a drawing anew: what is not understood cannot pass.
class Cleaner {
 public:
  explicit Cleaner(std::string_view svg) : reader_(svg) {}

  Result<Template> run() {
    for (;;) {
      Result<XmlEvent> event = reader_.next();
      if (!event) return event.error();
      if (event->kind == XmlEvent::Kind::finish) break;
      if (const Status status = take(*event); !status) return status.error();
    }
    if (const Status status = references_.check(); !status) return status.error();
    found_.pieces.push_back({std::move(text_), {}});
    return std::move(found_);
  }

 private:
  Status take(const XmlEvent& event) {
    switch (event.kind) {
      case XmlEvent::Kind::start:
        return start(event);
      case XmlEvent::Kind::end:
        return end(event);
      case XmlEvent::Kind::text:
        return skipped_ > 0 ? Status() : characters(event);
      case XmlEvent::Kind::finish:
        break;
    }
    return {};
  }

  Status start(const XmlEvent& event) {
    const bool foreign = event.name.find(':') != std::string::npos || event.name == "metadata";
    if (open_.empty()) return root(event);
    if (skipped_ > 0 || foreign) {
      ++skipped_;
      return {};
    }
    if (!among(kElements, event.name))
      return fault(event.line, "<" + event.name + "> has no place in a template",
                   "take it out; a template is lines, texts and pictures");
    text_ += '<' + event.name;
    references_.open(event.name, id_of(event));
    for (const auto& [key, value] : event.attributes)
      if (const Status status = attribute(event, key, value); !status) return status;
    text_ += '>';
    open_.push_back(event.name);
    return {};
  }

  Status root(const XmlEvent& event) {
    if (event.name != "svg")
      return fault(event.line, "the outermost element is <" + event.name + ">, not <svg>",
                   "give a plain SVG file");
    open_.push_back(event.name);
    references_.open(event.name, {});  // an id of its own is not written
    for (const auto& [key, value] : event.attributes) {
      if (key == "viewBox") found_.view_box = on_one_line(value);
      if (lowered(key).starts_with("on"))
        return fault(event.line, "'" + key + "' has no place in a template", "take it out");
      if (key != "width" && key != "height") continue;
      const Result<double> length = parse_length_mm(value);
      if (!length || !(*length > 0))
        return fault(event.line, "the " + key + " of the template is '" + value + "'",
                     "write " + key + "=\"297mm\", or whatever the sheet has");
      (key == "width" ? found_.width_mm : found_.height_mm) = *length;
    }
    if (!(found_.width_mm > 0 && found_.height_mm > 0))
      return fault(event.line, "the template does not say its size",
                   "write width=\"420mm\" height=\"297mm\" in <svg>");
    return view_box(event);
  }

  /// Four numbers, written anew.
  Status view_box(const XmlEvent& event) {
    std::string_view text = found_.view_box;
    std::string numbers;
    int count = 0;
    bool good = true;
    while (good) {
      const std::size_t first = text.find_first_not_of(" ,");
      if (first == std::string_view::npos) break;
      text.remove_prefix(first);
      const std::size_t end = std::min(text.find_first_of(" ,"), text.size());
      const auto number = parse_number(text.substr(0, end));
      good = number && (count < 2 || *number > 0);
      if (good) numbers += (count == 0 ? "" : " ") + shortest(*number);
      text.remove_prefix(end);
      ++count;
    }
    if (!good || count != 4)
      return fault(event.line, "the template has no viewBox of four numbers",
                   "write viewBox=\"0 0 420 297\" in <svg>, the size in the units of the drawing");
    found_.view_box = numbers;
    return {};
  }

  Status attribute(const XmlEvent& event, const std::string& key, const std::string& value) {
    const std::string lower = lowered(key);
    const auto refuse = [&](const std::string& what) {
      return fault(event.line, what + " of <" + event.name + "> has no place in a template",
                   "take it out; a template is lines, texts and pictures, all in one file");
    };
    if (lower.starts_with("on")) return refuse("'" + key + "'");
    const bool prefixed = key.find(':') != std::string::npos;
    if (lower == "xmlns" || (prefixed && !among(kAttributePrefixes, key))) return {};
    if (lower == "href" || lower == "xlink:href") {
      if (!is_inside_reference(event.name, value))
        return refuse("the reference '" + value.substr(0, 60) + "'");
      if (value.starts_with('#')) references_.refer(on_one_line(value).substr(1), event.line);
    } else if (const std::string what = reaches_out(value); !what.empty()) {
      return refuse("'" + what + "'");
    }
    for (std::string& target : url_targets(on_one_line(value)))
      references_.refer(std::move(target), event.line);
    // Attributes are read as style sheets are, where an escape can spell url.
    if (!prefixed && value.find('\\') != std::string::npos) return refuse("'\\' in '" + key + "'");
    if (key == "id" && (value.starts_with("view-") || value.starts_with("sheet-")))
      return fault(event.line, "the id '" + value + "' is one of the drawing's own",
                   "call it something that does not begin with view- or sheet-");
    text_ += ' ' + key + "=\"" + drawing::xml_escaped(on_one_line(value)) + '"';
    return {};
  }

  Status end(const XmlEvent& event) {
    if (skipped_ > 0) {
      --skipped_;
      return {};
    }
    if (open_.back() == "style") {
      if (const Status status = style(event); !status) return status;
    }
    open_.pop_back();
    references_.close();
    if (!open_.empty()) text_ += "</" + event.name + '>';
    return {};
  }

  /// All that the element holds: a word may come in pieces, with comments in between.
  Status style(const XmlEvent& event) {
    const std::string sheet = std::exchange(style_, {});
    if (const std::string what = reaches_out(sheet); !what.empty())
      return fault(event.line, "'" + what + "' has no place in the style of a template",
                   "take it out; all of a template stands in one file");
    if (sheet.find('\\') != std::string::npos)
      return fault(event.line, "'\\' has no place in the style of a template", "take it out");
    const std::string line = on_one_line(sheet);
    for (std::string& target : url_targets(line))
      references_.refer_in_style(std::move(target), event.line);
    text_ += drawing::xml_escaped(line);
    return {};
  }

  Status characters(const XmlEvent& event) {
    const std::string& element = open_.back();
    const std::string line = on_one_line(event.text);
    const bool blank = line.find_first_not_of(' ') == std::string::npos;
    if (element == "style") {
      style_ += event.text;
    } else if (among(kWithFields, element)) {
      return with_fields(event, line);
    } else if (!blank) {
      return fault(event.line, "text stands in <" + element + ">", "text belongs in <text>");
    }
    return {};
  }

  Status with_fields(const XmlEvent& event, const std::string& line) {
    const Result<std::vector<Piece>> pieces = split_placeholders(line);
    if (!pieces) return fault(event.line, pieces.error().message, pieces.error().mend);
    for (const Piece& piece : *pieces) {
      text_ += drawing::xml_escaped(piece.text);
      if (piece.name.empty()) continue;
      found_.pieces.push_back({std::exchange(text_, {}), piece.name});
    }
    return {};
  }

  XmlReader reader_;
  Template found_;
  std::string text_;
  std::vector<std::string> open_;
  References references_;
  std::string style_;  ///< of the style element that is open
  int skipped_ = 0;    ///< elements that are open and passed over
};

}  // namespace

std::vector<std::string> Template::fields() const {
  std::vector<std::string> names;
  for (const Piece& piece : pieces)
    if (!piece.name.empty() && std::find(names.begin(), names.end(), piece.name) == names.end())
      names.push_back(piece.name);
  return names;
}

Result<Template> parse_template(std::string_view svg) { return Cleaner(svg).run(); }

}  // namespace strake::sheets
