// SPDX-License-Identifier: Apache-2.0
#include "rules/object_facts.hpp"

#include <cstdint>

#include "rules/rule_context.hpp"
#include "rules/rule_file.hpp"
#include "strake/model/selection.hpp"
#include "strake/rules/rules.hpp"

namespace strake::rules {

void ObjectFacts::append(const ObjectFacts& more) {
  picked.resize(more.picked.size());
  for (std::size_t s = 0; s < picked.size(); ++s)
    picked[s].insert(picked[s].end(), more.picked[s].begin(), more.picked[s].end());
  if (more.ends) {
    if (!ends) ends.emplace();
    for (model::ObjectEnd end : *more.ends) {
      end.object += static_cast<std::uint32_t>(objects);
      ends->push_back(end);
    }
  }
  obstructions = obstructions || more.obstructions;
  insulation = insulation || more.insulation;
  objects += more.objects;
}

void detect_categories(const model::Model& model, ObjectFacts& facts) {
  for (const model::Body& body : model.bodies) {
    facts.obstructions = facts.obstructions || body.category == model::Category::obstruction;
    facts.insulation = facts.insulation || body.category == model::Category::insulation;
  }
}

Result<ObjectFacts> Rules::facts(const model::Scene& scene,
                                 const parallel::Context& context) const {
  ObjectFacts facts;
  facts.objects = scene.model->objects.size();
  auto picked = picked_by(choosers_of(*file_), scene, context);
  if (!picked) return picked.error();
  facts.picked = std::move(*picked);
  detect_categories(*scene.model, facts);
  for (const ExemptingRule& rule : file_->exempting)
    if (std::holds_alternative<EndsRule>(rule.rule) && !facts.ends)
      facts.ends = model::ends_of(scene, std::vector<bool>(facts.objects, true));
  return facts;
}

}  // namespace strake::rules
