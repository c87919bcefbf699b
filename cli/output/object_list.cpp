// SPDX-License-Identifier: Apache-2.0
#include "cli/output/object_list.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "cli/output/shown_text.hpp"
#include "model/attributes.hpp"

namespace strake::cli {

namespace {

std::uint32_t listed(const model::Model& model, std::uint64_t most) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(most, model.objects.size()));
}

}  // namespace

std::string object_list_text(const model::Model& model, std::uint64_t most) {
  std::string out;
  const std::uint32_t shown = listed(model, most);
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

nlohmann::ordered_json object_list_json(const model::Model& model, std::uint64_t most) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::uint32_t o = 0; o < listed(model, most); ++o) {
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

}  // namespace strake::cli
