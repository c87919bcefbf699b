// SPDX-License-Identifier: Apache-2.0
#include "page/results/page_objects.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "page/blocks/columns.hpp"
#include "report/clash/contents.hpp"

namespace strake::page {
namespace {

enum ObjectFlag : std::uint8_t { kPositional = 1, kNamedById = 2 };

/// Returns the discipline of each object, by the first test that knows one.
std::vector<std::uint16_t> disciplines_of(const PageObjects& objects,
                                          const clash::Findings& findings, const PageNames& names) {
  std::vector<std::uint16_t> all(objects.objects.size(), kNoName);
  for (std::size_t t = 0; t < findings.tests.size(); ++t) {
    const std::vector<std::uint32_t>& of_object = findings.tests[t].discipline;
    if (findings.tests[t].disciplines.empty()) continue;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::uint32_t label = of_object[model::index(objects.objects[i])];
      if (all[i] == kNoName && label != clash::kNoLabel) all[i] = names.discipline_of[t][label];
    }
  }
  return all;
}

void add_attributes(Columns& columns, const model::Model& model, const PageObjects& objects,
                    const std::vector<std::string>& attributes) {
  NumberedTexts texts;
  (void)texts.number({});
  for (std::size_t a = 0; a < attributes.size(); ++a) {
    std::vector<std::uint32_t> stated;
    stated.reserve(objects.objects.size());
    for (const model::ObjectId object : objects.objects)
      stated.push_back(
          texts.number(report::stated_text(model, object, attributes[a]).value_or(std::string())));
    columns.numbers<std::uint32_t>(
        "attribute_" + std::to_string(a), objects.objects.size(),
        [stated = std::move(stated)](std::size_t i) { return stated[i]; });
  }
  columns.texts(
      "texts", texts.all().size(),
      [all = texts.all()](std::size_t i, std::string&) -> std::string_view { return all[i]; });
}

}  // namespace

PageObjects page_objects(const std::vector<bool>& wanted) {
  PageObjects objects;
  std::vector<std::uint32_t> number_of(wanted.size(), kNotInPage);
  for (std::uint32_t o = 0; o < wanted.size(); ++o) {
    if (!wanted[o]) continue;
    number_of[o] = static_cast<std::uint32_t>(objects.objects.size());
    objects.objects.push_back(model::ObjectId{o});
  }
  objects.number_of = std::make_shared<const std::vector<std::uint32_t>>(std::move(number_of));
  return objects;
}

Block objects_block(const model::Model& model, const std::shared_ptr<const PageObjects>& objects,
                    const report::ClashContents* clash, const PageNames& names) {
  const std::size_t n = objects->objects.size();
  const auto object = [&model, objects](std::size_t i) -> const model::Object& {
    return model.object(objects->objects[i]);
  };
  Columns columns("strake-objects");
  columns.texts("id", n,
                [object](std::size_t i, std::string&) -> std::string_view { return object(i).id; });
  columns.texts("name", n, [object](std::size_t i, std::string&) -> std::string_view {
    return object(i).name == object(i).id ? std::string_view() : object(i).name;
  });
  columns.numbers<std::uint32_t>("file", n, [object](std::size_t i) { return object(i).file; });
  columns.numbers<std::uint8_t>("flags", n, [object](std::size_t i) {
    return static_cast<std::uint8_t>((object(i).positional_id ? kPositional : 0) |
                                     (object(i).name == object(i).id ? kNamedById : 0));
  });
  if (clash != nullptr && !names.disciplines.empty())
    columns.numbers<std::uint16_t>(
        "discipline", n,
        [all = disciplines_of(*objects, clash->findings, names)](std::size_t i) { return all[i]; });
  if (clash != nullptr && !clash->columns.empty())
    add_attributes(columns, model, *objects, clash->columns);
  return std::move(columns).finish();
}

}  // namespace strake::page
