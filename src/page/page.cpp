// SPDX-License-Identifier: Apache-2.0
#include "page/page.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "page/blocks/block_writer.hpp"
#include "page/geometry/model_blocks.hpp"
#include "page/geometry/shown_objects.hpp"
#include "page/page_head.hpp"
#include "page/page_template.hpp"
#include "page/results/page_objects.hpp"
#include "page/results/result_blocks.hpp"

namespace strake::page {
namespace {

/// Takes the pairs of the classes that are wanted and calls visit(pair) for each, with the severest
/// first.
template <class Visit>
void visit_pairs(const clash::Findings& findings, clash::Class cls, const Visit& visit) {
  for (const clash::Report& test : findings.tests)
    for (const clash::Pair& pair : test.pairs)
      if (pair.cls == cls && pair.allowed < 0) visit(pair);
}

/// Returns which objects are shown first: what clashes, then what is near; contacts are mostly
/// meant, and come last.
ShowPriorities show_priorities(const PageContents& contents) {
  ShowPriorities priorities{.how = contents.shown};
  if (contents.clash == nullptr) {
    priorities.drawn = contents.drawn;
    for (std::uint32_t o = 0; o < contents.model.objects.size(); ++o)
      priorities.last.push_back(model::ObjectId{o});
    return priorities;
  }
  const clash::Findings& findings = contents.clash->findings;
  for (const clash::Class cls : {clash::Class::hit, clash::Class::clearance_violation})
    visit_pairs(findings, cls, [&](const clash::Pair& pair) {
      priorities.first.insert(priorities.first.end(), {pair.a, pair.b});
      priorities.places_mm.push_back(pair.point_mm);
    });
  visit_pairs(findings, clash::Class::contact, [&](const clash::Pair& pair) {
    priorities.last.insert(priorities.last.end(), {pair.a, pair.b});
  });
  return priorities;
}

/// Returns which objects the page names: those of results, and those that it shows.
std::vector<bool> named_objects(const PageContents& contents, const ShownObjects& shown) {
  std::vector<bool> named(contents.model.objects.size(), false);
  for (std::size_t o = 0; o < shown.of.size(); ++o) named[o] = shown.of[o] != ShownAs::nothing;
  if (contents.clash == nullptr) return named;
  for (const clash::Report& test : contents.clash->findings.tests)
    for (const clash::Pair& pair : test.pairs)
      named[model::index(pair.a)] = named[model::index(pair.b)] = true;
  return named;
}

/// Writes the page once everything in it is known.
Status put_out(const std::vector<Block>& blocks, bool is_served, report::Sink sink,
               const parallel::Context& context) {
  // The policy stands in the first piece.
  const std::string first = is_served ? with_served_policy(kBeforePayload[0]) : std::string();
  for (std::size_t i = 0; i < kBeforePayload.size(); ++i)
    sink(i == 0 && is_served ? std::string_view(first) : kBeforePayload[i]);
  for (const Block& block : blocks)
    if (const Status status = write_block(block, sink, context); !status) return status;
  for (const std::string_view piece : kAfterPayload) sink(piece);
  return {};
}

/// "ship.glb", "ship.glb and 3 more".
std::string title_of(const model::Model& model) {
  if (model.files.empty()) return "Strake";
  std::string title = model.files.front().label;
  if (model.files.size() > 1) title += " and " + std::to_string(model.files.size() - 1) + " more";
  return title;
}

}  // namespace

Status write_page(const PageContents& contents, report::Sink sink,
                  const parallel::Context& context) {
  ShownObjects shown;
  if (contents.scene != nullptr && contents.shown != report::ModelShown::nothing) {
    Result<ShownObjects> chosen = choose_shown(*contents.scene, show_priorities(contents), context);
    if (!chosen) return chosen.error();
    shown = std::move(*chosen);
  }
  const auto objects =
      std::make_shared<const PageObjects>(page_objects(named_objects(contents, shown)));
  const clash::Findings none;
  const clash::Findings& findings = contents.clash != nullptr ? contents.clash->findings : none;
  const PageNames names = page_names(findings);
  const PageRows rows(findings);
  std::vector<Block> blocks;
  if (!objects->objects.empty())
    blocks.push_back(objects_block(contents.model, objects, contents.clash, names));
  if (contents.clash != nullptr)
    std::ranges::move(result_blocks({*contents.clash, rows, names, *objects, contents.assignee}),
                      std::back_inserter(blocks));
  ModelBlocks model;
  if (!shown.of.empty()) {
    Result<ModelBlocks> made = model_blocks(*contents.scene, shown, objects->number_of, context);
    if (!made) return made.error();
    model = std::move(*made);
    std::ranges::move(model.blocks, std::back_inserter(blocks));
  }
  for (std::size_t d = 0; d < contents.drawings.size(); ++d)
    blocks.push_back(view_block("strake-drawing-" + std::to_string(d), contents.drawings[d].svg));
  const clash::Grouping* const grouping =
      contents.clash != nullptr ? contents.clash->grouping : nullptr;
  Result<std::string> head =
      page_head(contents,
                {rows.size(), grouping != nullptr ? grouping->groups.size() : 0,
                 objects->objects.size(), names, blocks, model.scene},
                context);
  if (!head) return head.error();
  blocks.insert(blocks.begin(), text_block("strake-head", std::move(*head)));
  return put_out(blocks, contents.served.has_value(), sink, context);
}

std::string served_policy() {
  return std::string(policy_in(with_served_policy(kBeforePayload[0]))) + "; frame-ancestors 'none'";
}

Status write_clash_page(const report::ClashContents& contents, report::Sink sink,
                        const parallel::Context& context) {
  return write_page({.title = title_of(contents.model),
                     .model = contents.model,
                     .clash = &contents,
                     .scene = contents.scene,
                     .shown = contents.shown},
                    sink, context);
}

}  // namespace strake::page
