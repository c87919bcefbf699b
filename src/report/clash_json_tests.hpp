// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "strake/clash/clash.hpp"
#include "strake/model/model.hpp"

namespace strake::report {

/// The members `elements` and `tests` of the clash document: what was looked at, by which rules and
/// tolerances, and how much was found.
void append_tests(std::string& out, const clash::Findings& findings, const model::Model& model);

}  // namespace strake::report
