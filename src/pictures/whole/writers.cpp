// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "pictures/whole_run.hpp"

namespace strake::pictures {
namespace {

constexpr std::array kWriters{
    report::ClashWriter{{".svg", ", drawn with their numbers on the model as {}"}, write_overview},
    report::ClashWriter{{".glb", ", or as markers in a model as {}"}, write_markers},
};

}  // namespace

std::span<const report::ClashWriter> picture_writers() { return kWriters; }

}  // namespace strake::pictures
