// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/report/clash_document.hpp"

namespace strake::report {

/// Checks a document that is otherwise complete against its own counts, keys, elements and hash.
/// Its results must be of its tests. Throws DocumentFault for the first thing that contradicts the
/// rest.
void check_against_itself(const ClashDocument& document);

}  // namespace strake::report
