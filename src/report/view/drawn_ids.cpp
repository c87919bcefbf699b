// SPDX-License-Identifier: Apache-2.0
#include "report/view/drawn_ids.hpp"

namespace strake::report {

void DrawnIds::add(const ViewDocument& drawing) {
  for (const auto list : {&ViewDocument::objects, &ViewDocument::far_objects})
    for (const ViewObject& o : drawing.*list) ids_.emplace(o.file, o.id);
}

}  // namespace strake::report
