// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>

namespace strake::parallel {

class Executor;
class Progress;
class RunReport;

/// How a long computation runs; passed explicitly to everything that takes time. All parts may be
/// absent: no team means the same code on the calling thread with the same blocks and so the same
/// bytes, no progress and no report mean that nobody asked.
struct Context {
  Executor* team = nullptr;      ///< a Team, or a host's workers; null: sequential
  std::stop_token stop = {};     ///< triggered: return ErrorCode::cancelled soon
  Progress* progress = nullptr;  ///< told how far the work is
  RunReport* report = nullptr;   ///< collects time and load balance per region
};

}  // namespace strake::parallel
