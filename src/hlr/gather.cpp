// SPDX-License-Identifier: Apache-2.0
#include "hlr/job.hpp"

namespace strake::hlr {

Status solve_gather(const Job& job, const parallel::Context& context, Drawing& drawing) {
  return solve_brute_force(job, context, drawing);
}

}  // namespace strake::hlr
