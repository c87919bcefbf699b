// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>

#include "strake/model/model.hpp"

namespace strake::model {

/// The equipment, structures and branches of a model whose hierarchy is that of AVEVA:
///
///     SITE  ZONE  EQUI        SUBE
///                 STRU        SUBS, FRMW  SBFR
///                 PIPE, HVAC  BRAN
///
/// The attribute `Type` tells what a group is, or the name of an element below that has none of its
/// own: "BOX 2 of EQUIPMENT /P-101" makes "/P-101" an equipment. As levels are fixed, one group of
/// a known type tells at which level all equipment, structures and pipes of its site stand, also
/// where a zone or a branch was exported alone. Where groups tell different levels the outermost
/// counts: some types may be nested, and no level may be left out.
class Assemblies {
 public:
  explicit Assemblies(const Model& model);

  /// Whether nothing shows what any group is: the model is not from AVEVA.
  [[nodiscard]] bool empty() const { return level_.empty(); }

  /// Returns how many groups of a path, outermost first, lead to the equipment, the structure or
  /// the branch; 0 if there is none or nothing shows.
  [[nodiscard]] std::size_t depth(std::span<const GroupId> path) const;

 private:
  std::map<GroupId, std::int64_t> level_;  ///< of equipment, by outermost group
  std::set<GroupId> items_;                ///< the groups that are equipment or structures
};

}  // namespace strake::model
