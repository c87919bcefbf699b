// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pictures/viewpoint.hpp"

namespace strake::pictures {

/// What a picture is of, with the name that it keeps from run to run.
struct NamedSubject {
  Subject subject;
  std::string key;         ///< the id of the group, or the key of the clash
  std::string name;        ///< of the group; empty for a clash
  std::size_t number = 0;  ///< of the group in its order, from 1; of a clash its place in the list
};

/// Returns the groups of the contents, or their results where there are no groups: the worst first,
/// by class, then d, then key. Results that a rule allows or a decision settles are left out, and
/// contacts but where they are all that is requested.
[[nodiscard]] std::vector<NamedSubject> shown_subjects(const report::ClashContents& contents);

}  // namespace strake::pictures
