// SPDX-License-Identifier: Apache-2.0
#include "report/exchange/review_status.hpp"

namespace strake::report {

Review review_of(const ClashContents& contents, std::size_t test, const clash::Pair& pair) {
  if (contents.decided == nullptr) return {};
  const DecidedResult* const decided = contents.decided->of(test, pair);
  if (decided == nullptr) return {};
  if (decided->reopened != Reopened::no) return {DecisionStatus::active, decided};
  return {decided->decision->status, decided};
}

}  // namespace strake::report
