// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/scene.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

namespace strake::io::gltf {
namespace {

Error refused(std::string pointer, std::string message,
              std::string mend = "mend the hierarchy: every node has at most one parent") {
  return {ErrorCode::input, std::move(message), std::move(pointer), std::move(mend)};
}

Result<std::vector<std::uint32_t>> parents_of(const std::vector<Node>& nodes) {
  std::vector<std::uint32_t> parents(nodes.size(), kNoVisit);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const std::uint64_t child : nodes[i].children) {
      const auto pointer = [i] { return fmt::format("/nodes/{}/children", i); };
      if (child >= nodes.size()) return refused(pointer(), "names a node that does not exist");
      if (parents[child] != kNoVisit)
        return refused(pointer(),
                       fmt::format("node {} has two parents, {} and {}", child, parents[child], i));
      parents[child] = static_cast<std::uint32_t>(i);
    }
  return parents;
}

/// With one parent at most for each, nodes that no root leads to go round in a circle.
Status check_cycles(const std::vector<Node>& nodes, const std::vector<std::uint32_t>& parents) {
  std::vector<std::uint32_t> open;
  std::vector<bool> reached(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (parents[i] == kNoVisit) open.push_back(static_cast<std::uint32_t>(i));
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    reached[node] = true;
    for (const std::uint64_t child : nodes[node].children)
      open.push_back(static_cast<std::uint32_t>(child));
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!reached[i]) return refused(fmt::format("/nodes/{}", i), "the node is its own ancestor");
  return {};
}

Result<std::vector<std::uint32_t>> roots_of(const Json& root, const std::vector<Node>& nodes,
                                            const std::vector<std::uint32_t>& parents) {
  std::vector<std::uint32_t> roots;
  const std::vector<Json> scenes = root["scenes"].items();
  if (scenes.empty()) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (parents[i] == kNoVisit) roots.push_back(static_cast<std::uint32_t>(i));
    return roots;
  }
  const Json scene_json = root["scene"];
  const std::uint64_t scene = scene_json.exists() ? scene_json.index().value_or(UINT64_MAX) : 0;
  if (scene >= scenes.size()) return refused("/scene", "names a scene that does not exist");
  const std::string pointer = fmt::format("/scenes/{}/nodes", scene);
  std::vector<bool> listed(nodes.size());
  for (const Json& item : scenes[scene]["nodes"].items()) {
    const std::uint64_t node = item.index().value_or(UINT64_MAX);
    if (node >= nodes.size()) return refused(pointer, "names a node that does not exist");
    if (parents[node] != kNoVisit || listed[node])
      return refused(pointer, fmt::format("node {} is listed but is a child of another or is "
                                          "listed twice",
                                          node));
    listed[node] = true;
    roots.push_back(static_cast<std::uint32_t>(node));
  }
  return roots;
}

}  // namespace

Result<std::vector<Visit>> visit_order(const Json& root, const std::vector<Node>& nodes) {
  const Result<std::vector<std::uint32_t>> parents = parents_of(nodes);
  if (!parents) return parents.error();
  if (const Status acyclic = check_cycles(nodes, *parents); !acyclic) return acyclic.error();
  const Result<std::vector<std::uint32_t>> roots = roots_of(root, nodes, *parents);
  if (!roots) return roots.error();

  struct Open {
    Visit visit;
    std::uint32_t depth = 0;
  };
  std::vector<Visit> order;
  std::vector<Open> open;
  for (auto node = roots->rbegin(); node != roots->rend(); ++node)
    open.push_back({{*node, kNoVisit}, 0});
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    if (next.depth == kMaxNodeDepth)
      return refused(fmt::format("/nodes/{}", next.visit.node),
                     fmt::format("nodes are nested more than {} deep", kMaxNodeDepth),
                     "export the model with a flatter hierarchy");
    const auto self = static_cast<std::uint32_t>(order.size());
    order.push_back(next.visit);
    const std::vector<std::uint64_t>& children = nodes[next.visit.node].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      open.push_back({{static_cast<std::uint32_t>(*child), self}, next.depth + 1});
  }
  return order;
}

}  // namespace strake::io::gltf
