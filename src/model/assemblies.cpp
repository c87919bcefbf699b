// SPDX-License-Identifier: Apache-2.0
#include "model/assemblies.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "model/attributes.hpp"

namespace strake::model {
namespace {

/// A type of AVEVA's hierarchy. A pipe or a duct is known by its branches: its own word may mean a
/// whole discipline elsewhere.
struct ElementType {
  std::string_view code;   ///< as attributes have it
  std::string_view word;   ///< as names have it
  std::int64_t below = 0;  ///< how many levels it stands below equipment and structures
  bool item = false;       ///< whether it is, or is part of, an equipment or a structure
};

constexpr std::array<ElementType, 7> kTypes{{{"EQUI", "EQUIPMENT", 0, true},
                                             {"STRU", "STRUCTURE", 0, true},
                                             {"SUBE", "SUBEQUIPMENT", 1, true},
                                             {"SUBS", "SUBSTRUCTURE", 1, true},
                                             {"FRMW", "FRMWORK", 1, true},
                                             {"BRAN", "BRANCH", 1, false},
                                             {"SBFR", "SBFRAMEWORK", 2, true}}};

const ElementType* type_called(std::string_view text, std::string_view ElementType::* column) {
  const auto* const found = std::ranges::find(kTypes, text, column);
  return found == kTypes.end() ? nullptr : found;
}

/// Returns what the name of an unnamed element, "BOX 2 of EQUIPMENT /P-101", tells of the type of
/// `owner`, the name of the group right above; null if it tells nothing.
const ElementType* owner_type(std::string_view name, std::string_view owner) {
  constexpr std::string_view kOf = " of ";
  const std::size_t of = name.find(kOf);
  if (of == std::string_view::npos || of == 0 || name[of - 1] < '0' || name[of - 1] > '9')
    return nullptr;
  const std::string_view owner_text = name.substr(of + kOf.size());
  const std::size_t blank = owner_text.find(' ');
  if (blank == std::string_view::npos) return nullptr;
  // An owner without a name of its own is called by all of the text.
  if (owner_text != owner && owner_text.substr(blank + 1) != owner) return nullptr;
  return type_called(owner_text.substr(0, blank), &ElementType::word);
}

/// A group whose type is known, by its place in the hierarchy.
struct KnownGroup {
  std::vector<GroupId> path;  ///< outermost first, the group itself last
  const ElementType* type = nullptr;
};

class KnownGroups {
 public:
  explicit KnownGroups(const Model& model) : model_(model) {}

  std::vector<KnownGroup> all() {
    for (std::uint32_t g = 0; g < model_.groups.size(); ++g) {
      const Group& group = model_.groups[g];
      if (group.attributes < model_.group_attributes.size())
        for (const std::string_view value :
             values_of(model_.group_attributes[group.attributes], "Type"))
          add(GroupId{g}, type_called(value, &ElementType::code));
      add_owner(group.parent, group.name);
    }
    for (const Object& object : model_.objects) add_owner(object.parent, object.name);
    return std::move(known_);
  }

 private:
  [[nodiscard]] bool exists(GroupId g) const {
    return g != GroupId::none && index(g) < model_.groups.size();
  }

  void add_owner(GroupId owner, std::string_view name) {
    if (exists(owner)) add(owner, owner_type(name, model_.groups[index(owner)].name));
  }

  void add(GroupId group, const ElementType* type) {
    if (type == nullptr || !added_.insert({group, type}).second) return;
    KnownGroup& known = known_.emplace_back();
    known.type = type;
    for (GroupId g = group; exists(g) && known.path.size() <= model_.groups.size();
         g = model_.groups[index(g)].parent)
      known.path.push_back(g);
    std::ranges::reverse(known.path);
  }

  const Model& model_;
  std::set<std::pair<GroupId, const ElementType*>> added_;
  std::vector<KnownGroup> known_;
};

/// Returns how many groups lead to a level; what was exported from below it counts as one whole.
std::size_t groups_to(std::int64_t level) {
  return static_cast<std::size_t>(std::max<std::int64_t>(1, level));
}

}  // namespace

Assemblies::Assemblies(const Model& model) {
  const std::vector<KnownGroup> known = KnownGroups(model).all();
  for (const KnownGroup& group : known) {
    const std::int64_t level = static_cast<std::int64_t>(group.path.size()) - group.type->below;
    const auto [at, added] = level_.try_emplace(group.path.front(), level);
    if (!added) at->second = std::min(at->second, level);
  }
  for (const KnownGroup& group : known) {
    if (!group.type->item) continue;
    const bool whole = group.type->below == 0;
    items_.insert(whole ? group.path.back()
                        : group.path[groups_to(level_.at(group.path.front())) - 1]);
  }
}

std::size_t Assemblies::depth(std::span<const GroupId> path) const {
  const auto level = path.empty() ? level_.end() : level_.find(path.front());
  if (level == level_.end()) return 0;
  for (std::size_t depth = path.size(); depth > 0; --depth)
    if (items_.contains(path[depth - 1])) return depth;
  const std::size_t branch = groups_to(level->second + 1);
  return branch <= path.size() ? branch : 0;
}

}  // namespace strake::model
