// SPDX-License-Identifier: Apache-2.0
#include "cli/run/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>  // defines __GLIBC__ where it applies
#include <exception>
#include <new>

#include "cli/output/console.hpp"
#include "cli/run/exit_code.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace strake::cli {

#ifdef __GLIBC__
namespace {

/// Bytes by which a heap grows beyond what is requested, and of which a worker's heap that is empty
/// is not given back: their pages would be taken again in the next region (decision 0113). It is
/// little of memory that has a limit, all of which may be needed.
int room_of_heaps() {
  constexpr rlim_t kRoom = rlim_t{64} << 20U, kShare = 64;
  rlim_t room = kRoom;
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA})
    if (rlimit space{}; getrlimit(resource, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
      room = std::min(room, space.rlim_cur / kShare);
  return static_cast<int>(room);
}

}  // namespace
#endif

void keep_freed_memory() {
#ifdef __GLIBC__
  // A ship of a million objects takes a tenth to a fifth less CPU time so (decision 0010).
  constexpr int kMapFrom = 1 << 30;  // bytes: smaller blocks come from the heap
  constexpr int kNeverTrim = -1;
  // Where either is refused the run is slower, nothing else.
  mallopt(M_MMAP_THRESHOLD, kMapFrom);
  mallopt(M_TRIM_THRESHOLD, kNeverTrim);
  mallopt(M_TOP_PAD, room_of_heaps());
#endif
}

namespace {

/// Whether the program ends for want of memory. An exception that finds no memory for itself is
/// never created: then there is none, and no memory to be had.
bool memory_ran_out() {
  constexpr std::size_t kLittle = std::size_t{1} << 16U;
  const std::exception_ptr thrown = std::current_exception();
  if (!thrown) {
    void* const block = std::malloc(kLittle);
    std::free(block);
    return block == nullptr;
  }
  try {
    std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
    return false;
  }
}

[[noreturn]] void end_program() {
  if (!memory_ran_out()) std::abort();
  print_out_of_memory();
  ::_exit(static_cast<int>(ExitCode::memory));
}

}  // namespace

void end_well_without_memory() { std::set_terminate(end_program); }

}  // namespace strake::cli
