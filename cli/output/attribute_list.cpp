// SPDX-License-Identifier: Apache-2.0
#include "cli/output/attribute_list.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/text_encoding.hpp"
#include "model/attribute_uses.hpp"

namespace strake::cli {

namespace {

/// Longer values are cut: a description may fill a page.
constexpr std::size_t kMostValueBytes = 40;

std::string shown_value(std::string_view value) {
  const std::string text = printable(value);
  if (text.size() <= kMostValueBytes) return in_quotes(text);
  std::string cut;
  for (std::string_view rest = text; cut.size() < kMostValueBytes;)
    cut += take_character(rest).bytes;
  return in_quotes(cut + "…");
}

std::string shown_values(const model::AttributeUse& use) {
  std::string text;
  for (const std::string_view value : use.examples)
    text += (text.empty() ? "" : ", ") + shown_value(value);
  return use.examples.size() < use.values ? text + ", …" : text;
}

}  // namespace

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
