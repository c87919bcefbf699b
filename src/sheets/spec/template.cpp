// SPDX-License-Identifier: Apache-2.0
// Placeholders, the check of references, and the parser of templates.
#include "sheets/spec/template.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "core/units.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "sheets/spec/xml_reader.hpp"
#include "strake/drawing/write.hpp"

namespace strake::sheets {

Result<std::vector<TextPiece>> split_placeholders(std::string_view text) {
  std::vector<TextPiece> pieces;
  for (;;) {
    const std::size_t open = text.find("{{");
    if (open == std::string_view::npos) break;
    const std::size_t close = text.find("}}", open);
    if (close == std::string_view::npos)
      return Error{ErrorCode::usage, "a '{{' is not closed", {}, "write {{name}}"};
    const std::string_view name = trimmed(text.substr(open + 2, close - open - 2), " \t\r\n");
    if (name.empty() || name.find('{') != std::string_view::npos)
      return Error{ErrorCode::usage, "'{{ }}' names nothing", {}, "write {{name}}"};
    pieces.push_back({std::string(text.substr(0, open)), std::string(name)});
    text.remove_prefix(close + 2);
  }
  pieces.push_back({std::string(text), {}});
  return pieces;
}

std::string fill_placeholders(const std::vector<TextPiece>& pieces, Lookup lookup) {
  std::string text;
  for (const TextPiece& piece : pieces) {
    text += piece.text;
    if (!piece.name.empty()) text += lookup(piece.name);
  }
  return text;
}

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// The most elements that may be drawn, counting repeats: far more than a frame and a title block
/// have, and in proportion to the template.
constexpr std::uint64_t kMaxDrawn = 100000, kMaxTimes = 10;

Error reference_error(std::size_t line, std::string message, std::string mend) {
  return {ErrorCode::input, std::move(message), "line " + std::to_string(line), std::move(mend)};
}

}  // namespace

std::vector<std::string> url_targets(std::string_view text) {
  const std::string lower = lowered(text);
  constexpr std::string_view kUrl = "url(";
  std::vector<std::string> targets;
  for (std::size_t at = lower.find(kUrl); at != std::string::npos; at = lower.find(kUrl, at)) {
    at += kUrl.size();
    at = std::min(lower.find_first_not_of(' ', at), lower.size());
    const bool quoted = at < lower.size() && (lower[at] == '\'' || lower[at] == '"');
    const std::string_view last = quoted ? std::string_view(lower).substr(at, 1) : " )";
    if (quoted) at = std::min(lower.find_first_not_of(' ', at + 1), lower.size());
    if (at == lower.size() || lower[at] != '#') continue;
    const std::size_t end = std::min(lower.find_first_of(last, at), lower.size());
    targets.emplace_back(text.substr(at + 1, end - at - 1));
  }
  return targets;
}

void References::open(std::string_view name, std::string_view id) {
  const auto element = static_cast<std::uint32_t>(elements_.size());
  if (!open_.empty()) elements_[open_.back()].children.push_back(element);
  open_.push_back(element);
  elements_.push_back(
      {std::string(id), name == "linearGradient" || name == "radialGradient", {}, {}});
}

void References::refer(std::string target, std::size_t line) {
  elements_[open_.back()].references.push_back({std::move(target), line});
}

void References::refer_in_style(std::string target, std::size_t line) {
  in_style_.push_back({std::move(target), line});
}

/// Counts drawn elements, each as often as it is referred to. It has a stack of its own, since
/// references lead deeper than elements are nested.
class References::ReferenceVisitor {
 public:
  explicit ReferenceVisitor(const std::vector<Element>& elements)
      : elements_(elements), drawn_(elements.size(), kUnknown) {
    for (std::uint32_t e = 0; e < elements.size(); ++e)
      if (!elements[e].id.empty()) by_id_.emplace(elements[e].id, e);
    limit_ = kMaxDrawn + kMaxTimes * elements.size();
  }

  [[nodiscard]] Status run() {
    if (!elements_.empty()) enter(0);
    while (!path_.empty()) {
      if (const Status status = step(); !status) return status;
    }
    return {};
  }

  /// Finds the element of a reference; kNone where there is none: then nothing is drawn. Error
  /// where programs would not agree which element it is.
  [[nodiscard]] Result<std::uint32_t> find(const Reference& reference) const {
    const std::string& id = reference.target;
    // An escaped character can spell the name of another element, and programs strip blanks.
    if (const std::size_t at = id.find_first_of("% "); at != std::string::npos)
      return reference_error(reference.line,
                             std::string(id[at] == '%' ? "'%' stands" : "a blank stands") +
                                 " in the reference '#" + id + "'",
                             "give the element a name of letters and digits");
    if (by_id_.count(id) > 1)
      return reference_error(reference.line,
                             "'#" + id + "' is referred to, but several elements have that id",
                             "give each its own");
    const auto at = by_id_.find(id);
    return at == by_id_.end() ? kNone : at->second;
  }

 private:
  static constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::uint64_t kOpen = kUnknown - 1;

  struct Step {
    std::uint32_t element = 0;
    std::size_t next = 0;  ///< index into its children, then into its references
    std::uint64_t drawn = 1;
  };

  void enter(std::uint32_t element) {
    drawn_[element] = kOpen;
    path_.push_back({element, 0, 1});
  }

  [[nodiscard]] Status step() {
    Step& at = path_.back();
    const Element& element = elements_[at.element];
    if (at.next == element.children.size() + element.references.size()) {
      drawn_[at.element] = at.drawn;
      path_.pop_back();
      return {};
    }
    const bool child = at.next < element.children.size();
    const Reference* const reference =
        child ? nullptr : &element.references[at.next - element.children.size()];
    const Result<std::uint32_t> found = child ? element.children[at.next] : find(*reference);
    if (!found) return found.error();
    const std::uint32_t to = *found;
    if (to != kNone && drawn_[to] == kUnknown) {
      enter(to);
      return {};
    }
    ++at.next;
    if (to == kNone) return {};
    if (drawn_[to] == kOpen) return circle(*reference);
    at.drawn += drawn_[to];
    return at.drawn > limit_ ? too_much(element, reference) : Status();
  }

  [[nodiscard]] static Status circle(const Reference& reference) {
    return reference_error(reference.line, "'#" + reference.target + "' is drawn within itself",
                           "take the reference out, or let it lead to something else");
  }

  [[nodiscard]] Status too_much(const Element& element, const Reference* reference) const {
    if (reference == nullptr)  // its children draw that much: one of them refers
      for (const std::uint32_t child : element.children)
        if (!elements_[child].references.empty()) reference = &elements_[child].references.front();
    return reference_error(
        reference == nullptr ? 1 : reference->line,
        "the references draw more than " + std::to_string(limit_) + " elements",
        "refer to less, or less often: what is drawn by reference counts each time");
  }

  const std::vector<Element>& elements_;
  std::multimap<std::string_view, std::uint32_t> by_id_;
  std::vector<std::uint64_t> drawn_;  ///< per element, itself included
  std::uint64_t limit_ = 0;
  std::vector<Step> path_;
};

Status References::check() const {
  ReferenceVisitor walk(elements_);
  for (const Reference& reference : in_style_) {
    const Result<std::uint32_t> target = walk.find(reference);
    if (!target) return target.error();
    if (*target != kNone && !elements_[*target].is_gradient)
      return reference_error(
          reference.line,
          "'url(#" + reference.target + ")' has no place in the style of a template",
          "write it as an attribute of the elements that it is for: fill=\"url(#" +
              reference.target + ")\"");
  }
  return walk.run();
}

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

Error fault(std::size_t line, std::string message, std::string mend) {
  return {ErrorCode::input, std::move(message), "line " + std::to_string(line), std::move(mend)};
}

/// Returns why a value or a style sheet is more than drawing; empty where it is not.
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

/// Returns the id of an element as it will be written.
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

/// Writes the elements of a drawing anew: content that is not understood cannot pass.
class SvgSanitizer {
 public:
  explicit SvgSanitizer(std::string_view svg) : reader_(svg) {}

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

  /// Writes the four numbers of the viewBox anew.
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

  /// Checks all text of a style element at once: a word may come in pieces, with comments in
  /// between.
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
    const Result<std::vector<TextPiece>> pieces = split_placeholders(line);
    if (!pieces) return fault(event.line, pieces.error().message, pieces.error().mend);
    for (const TextPiece& piece : *pieces) {
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
  std::string style_;  ///< text of the style element that is open
  int skipped_ = 0;    ///< open elements that are skipped
};

}  // namespace

std::vector<std::string> Template::fields() const {
  std::vector<std::string> names;
  for (const TextPiece& piece : pieces)
    if (!piece.name.empty() && std::find(names.begin(), names.end(), piece.name) == names.end())
      names.push_back(piece.name);
  return names;
}

Result<Template> parse_template(std::string_view svg) { return SvgSanitizer(svg).run(); }

}  // namespace strake::sheets
