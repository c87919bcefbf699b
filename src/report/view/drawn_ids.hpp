// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string_view>
#include <utility>

#include "strake/report/view_document.hpp"

namespace strake::report {

/// The objects of a drawing, none at first; it must outlive this and stay where it is.
class DrawnIds {
 public:
  void add(const ViewDocument& drawing);
  [[nodiscard]] bool has(std::string_view file, std::string_view id) const {
    return ids_.contains({file, id});
  }

 private:
  std::set<std::pair<std::string_view, std::string_view>> ids_;
};

}  // namespace strake::report
