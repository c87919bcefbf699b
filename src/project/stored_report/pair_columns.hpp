// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "project/codec/blob.hpp"
#include "strake/clash/clash.hpp"

namespace strake::project {

/// Writes results, all but where their regions are listed.
void write_pairs(BlobWriter& out, std::span<const clash::Pair> pairs);
/// Reads them; whether their objects and rules are there is for the caller to check.
void read_pairs(BlobReader& in, std::vector<clash::Pair>& pairs);

}  // namespace strake::project
