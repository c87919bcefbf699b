// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "feed_view_document.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  strake::test::feed_view_document({reinterpret_cast<const char*>(data), size});
  return 0;
}
