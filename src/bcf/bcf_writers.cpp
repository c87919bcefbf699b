// SPDX-License-Identifier: Apache-2.0
#include "bcf/bcf_writers.hpp"

#include <array>

#include "bcf/output/write_bcf.hpp"

namespace strake::bcf {
namespace {

constexpr std::array kClashWriters{
    report::ClashWriter{{".bcf", ", as topics for other programs {}"}, write_bcf},
    report::ClashWriter{{".bcfzip", " or {}"}, write_bcf},
};

}  // namespace

std::span<const report::ClashWriter> clash_writers() { return kClashWriters; }

}  // namespace strake::bcf
