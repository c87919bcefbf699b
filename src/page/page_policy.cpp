// SPDX-License-Identifier: Apache-2.0
#include "page/page_policy.hpp"

#include <cstddef>

namespace strake::page {

std::string_view policy_in(std::string_view head) {
  constexpr std::string_view kBefore = "http-equiv=\"Content-Security-Policy\" content=\"";
  const std::size_t at = head.find(kBefore);
  if (at == std::string_view::npos) return {};
  const std::size_t from = at + kBefore.size();
  return head.substr(from, head.find('"', from) - from);
}

std::string with_served_policy(std::string_view head) {
  const std::string_view policy = policy_in(head);
  const auto end = static_cast<std::size_t>(policy.data() + policy.size() - head.data());
  std::string served(head.substr(0, end));
  served += "; connect-src 'self'";
  served += head.substr(end);
  return served;
}

}  // namespace strake::page
