// SPDX-License-Identifier: Apache-2.0
#include "fuzz_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  strake::test::feed(*strake::io::make_ply_reader(), "fuzz.ply", data, size);
  return 0;
}
