// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace strake::page {

/// Returns the policy (Content-Security-Policy) that the head of a page states; empty where there
/// is none.
[[nodiscard]] std::string_view policy_in(std::string_view head);

/// Returns the head of a page whose policy lets it ask the server that it comes from. A page that
/// is a file asks nobody.
[[nodiscard]] std::string with_served_policy(std::string_view head);

}  // namespace strake::page
