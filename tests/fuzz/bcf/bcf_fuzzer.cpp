// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string>

#include "feed_bcf.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const strake::test::TemporaryFolder folder;
  strake::test::feed_bcf({reinterpret_cast<const char*>(data), size}, folder);
  return 0;
}
