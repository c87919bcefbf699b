// SPDX-License-Identifier: Apache-2.0
#include "cli/memory.hpp"

#include <cstdlib>  // defines __GLIBC__ where it applies

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace strake::cli {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kMapFrom = 1 << 30;  // bytes: smaller blocks come from the heap
  constexpr int kNeverTrim = -1;
  // Where either is refused the run is slower, nothing else.
  mallopt(M_MMAP_THRESHOLD, kMapFrom);
  mallopt(M_TRIM_THRESHOLD, kNeverTrim);
#endif
}

}  // namespace strake::cli
