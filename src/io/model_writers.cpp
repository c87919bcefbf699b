// SPDX-License-Identifier: Apache-2.0
#include "io/model_writers.hpp"

#include <array>

namespace strake::io {
namespace {

constexpr std::array kWriters{
    ModelWriter{{".glb", " as {}"}, write_glb},
    ModelWriter{{".obj", " or {}"}, write_obj},
};

}  // namespace

std::span<const ModelWriter> model_writers() { return kWriters; }

}  // namespace strake::io
