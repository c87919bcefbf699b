// SPDX-License-Identifier: Apache-2.0
#include "sheets/output/artwork/svg_element.hpp"

#include <utility>

#include "sheets/spec/xml_reader.hpp"

namespace strake::sheets {

std::string_view SvgElement::value(std::string_view attribute) const {
  const auto found = attributes.find(attribute);
  return found == attributes.end() ? std::string_view() : std::string_view(found->second);
}

Result<SvgElements> parse_elements(std::string_view elements) {
  const std::string whole = "<svg>" + std::string(elements) + "</svg>";
  XmlReader reader(whole);
  SvgElements found;
  std::vector<std::size_t> open;
  const auto add = [&](SvgElement element) {
    if (!open.empty()) found.all[open.back()].children.push_back(found.all.size());
    found.all.push_back(std::move(element));
  };
  for (;;) {
    Result<XmlEvent> event = reader.next();
    if (!event) return event.error();
    if (event->kind == XmlEvent::Kind::finish) return found;
    if (event->kind == XmlEvent::Kind::end) {
      open.pop_back();
    } else if (event->kind == XmlEvent::Kind::text) {
      add({{}, std::move(event->text), {}, {}});
    } else {
      SvgElement element{std::move(event->name), {}, {}, {}};
      for (auto& [key, value] : event->attributes)
        element.attributes.emplace(std::move(key), std::move(value));
      if (const std::string_view id = element.value("id"); !id.empty())
        found.by_id.emplace(id, found.all.size());
      add(std::move(element));
      open.push_back(found.all.size() - 1);
    }
  }
}

}  // namespace strake::sheets
