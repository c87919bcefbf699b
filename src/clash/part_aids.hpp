// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "clash/narrow_part.hpp"
#include "clash/parts.hpp"
#include "strake/parallel/precomputed.hpp"

namespace strake::clash {

/// What is worked out about a part once for all pairs that it is in, as far as they asked for it:
/// its frame, its tree, its support planes. Made by the team between stages, only read within them.
class PartAids {
 public:
  /// `list` and `model` must outlive this.
  PartAids(const PartList& list, const model::Model& model) : list_(list), model_(model) {}

  /// Make those that are wanted, by unique part, and not there yet. Errors: cancelled.
  [[nodiscard]] Status want_frames(const std::vector<bool>& wanted,
                                   const parallel::Context& context);
  [[nodiscard]] Status want_trees(const std::vector<bool>& wanted,
                                  const parallel::Context& context);
  [[nodiscard]] Status want_planes(const std::vector<bool>& wanted,
                                   const parallel::Context& context);

  /// The part with nothing, with its frame, with its tree too, and with its planes too. What was
  /// not made is null; a tree, empty.
  [[nodiscard]] NarrowPart bare(const PartRef& part) const;
  [[nodiscard]] NarrowPart framed(const PartRef& part) const;
  [[nodiscard]] NarrowPart treed(const PartRef& part) const;
  [[nodiscard]] NarrowPart planed(const PartRef& part) const;

 private:
  template <class T, class Make>
  Status add(parallel::Precomputed<T>& kind, const std::vector<bool>& wanted, std::string_view name,
             const parallel::Context& context, Make&& make);

  const PartList& list_;
  const model::Model& model_;
  parallel::Precomputed<geometry::PartFrame> frames_;  ///< by unique part, as the others
  parallel::Precomputed<geometry::PartTree> trees_;
  parallel::Precomputed<geometry::SupportPlanes> planes_;
};

}  // namespace strake::clash
