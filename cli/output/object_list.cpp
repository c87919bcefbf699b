// SPDX-License-Identifier: Apache-2.0
#include "cli/output/object_list.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "cli/output/shown_text.hpp"
#include "core/text_encoding.hpp"
#include "model/attribute_uses.hpp"
#include "model/attributes.hpp"

namespace strake::cli {
namespace {

std::uint32_t listed(const model::Model& model, std::uint64_t limit) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(limit, model.objects.size()));
}

/// Longer values are cut: a description may fill a page.
constexpr std::size_t kMaxValueBytes = 40;

std::string shown_value(std::string_view value) {
  const std::string text = printable(value);
  if (text.size() <= kMaxValueBytes) return in_quotes(text);
  std::string cut;
  for (std::string_view rest = text; cut.size() < kMaxValueBytes;)
    cut += decode_character(rest).bytes;
  return in_quotes(cut + "…");
}

std::string shown_values(const model::AttributeUse& use) {
  std::string text;
  for (const std::string_view value : use.examples)
    text += (text.empty() ? "" : ", ") + shown_value(value);
  return use.examples.size() < use.values ? text + ", …" : text;
}

}  // namespace

std::string object_list_text(const model::Model& model, std::uint64_t limit) {
  std::string out;
  const std::uint32_t shown = listed(model, limit);
  for (std::uint32_t o = 0; o < shown; ++o) {
    const model::Object& object = model.objects[o];
    const model::SelectableProperties of = model::selectable_properties(model, model::ObjectId{o});
    out += shown_line(fmt::format("name = '{}'", object.name)) + '\n';
    for (const auto& [property, value] :
         {std::pair("id", object.id), std::pair("path", of.path),
          std::pair("file", model.files[object.file].label),
          std::pair("type", fmt::format("{}", fmt::join(of.types, ", "))),
          std::pair("category", fmt::format("{}", fmt::join(of.categories, ", "))),
          std::pair("color", fmt::format("{}", fmt::join(of.colors, ", ")))})
      out += shown_line(fmt::format("  {:<10}{}", property, value)) + '\n';
    for (const auto& [attribute, value] : of.attributes)
      out += shown_line(fmt::format("  @{} = {}", attribute, value)) + '\n';
  }
  if (shown < model.objects.size())
    out += fmt::format("… and {} objects more (--objects)\n", model.objects.size() - shown);
  return out;
}

nlohmann::ordered_json object_list_json(const model::Model& model, std::uint64_t limit) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::uint32_t o = 0; o < listed(model, limit); ++o) {
    const model::Object& object = model.objects[o];
    const model::SelectableProperties of = model::selectable_properties(model, model::ObjectId{o});
    list.push_back({{"name", object.name},
                    {"id", object.id},
                    {"path", of.path},
                    {"file", model.files[object.file].label},
                    {"types", of.types},
                    {"categories", of.categories},
                    {"colors", of.colors},
                    {"attributes", of.attributes}});
  }
  return list;
}

std::string attribute_list_text(const model::Model& model, std::size_t file) {
  const std::vector<model::AttributeUse> uses = model::attribute_uses(model, file, file + 1);
  if (uses.empty()) return "  attributes  none\n";
  std::size_t width = std::string_view("attributes").size();
  for (const model::AttributeUse& use : uses)
    width = std::max(width, printable(use.name).size() + 1);
  std::string out = fmt::format("  {:<{}}  {:>8}  {:>8}  first values\n", "attributes", width,
                                "objects", "values");
  for (const model::AttributeUse& use : uses)
    out += fmt::format("  {:<{}}  {:>8}  {:>8}  {}\n", '@' + printable(use.name), width,
                       use.objects, use.values, shown_values(use));
  return out;
}

nlohmann::ordered_json attribute_list_json(const model::Model& model, std::size_t file) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const model::AttributeUse& use : model::attribute_uses(model, file, file + 1))
    list.push_back({{"name", use.name},
                    {"objects", use.objects},
                    {"values", use.values},
                    {"first_values", use.examples}});
  return list;
}

}  // namespace strake::cli
