#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_guard.py SCRIPTS: check_house.py, from that folder, catches threads, locks, atomics and hidden state in an
engine, however they are written, and lets pass what only looks so, each entry a file of its own; and rooms that
include each other or hold too much."""
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import check_house  # noqa: E402: from the folder that the command names

# In an engine and in the program alike.
CAUGHT = r"""
std::mutex m;
::std::mutex m;
std :: mutex m;
std::recursive_mutex m;
std::scoped_lock lock(m);
std::lock(a, b);
std::try_lock(a, b);
std::thread t;
std::jthread t;
std::this_thread::yield();
auto f = std::async(work);
std::shared_future<int> f;
std::promise<int> p;
std::packaged_task<int()> task(f);
std::memory_order_relaxed;
std::condition_variable_any c;
std::once_flag once;
std::call_once(once, f);
std::lock_guard guard(m);
std::latch done(8);
std::barrier done(8);
std::counting_semaphore<8> s(8);
std::syncbuf b;
std::atomic<int> n;
std::atomic_ref n(i);
std::atomic_load(&p);
std::stop_callback callback(token, [] {});
std::osyncstream(out) << 1;
std::sort(std::execution::par, a, b);
std::experimental::latch l;
using std::atomic;
using namespace std;
using namespace ::std;
namespace s = std;
namespace s = ::std;
__gnu_parallel::sort(a, b);
tbb::parallel_for(r, f);
oneapi::dpl::sort(a, b);
__gthread_mutex_t m;
pthread_create(&t, 0, f, 0);
mtx_lock(&m);
thrd_create(&t, f, 0);
cnd_signal(&c);
tss_set(key, &x);
sem_wait(&s);
omp_set_num_threads(1);
_Atomic int x;
__atomic_fetch_add(&x, 1, 5);
__sync_synchronize();
__c11_atomic_store(&x, 1, 5);
syscall(SYS_futex, &x, 0, 0);
if (fork() == 0) run();
if (vfork() == 0) run();
call_once(flag, f);
auto now = atomic_load(&shared);
asm("lock; incl %0" : "+m"(x));
__asm__("pause");
__asm ("pause");
__volatile__ int x;
volatile bool done = false;
thread_local int x;
#pragma omp parallel for
#  pragma omp parallel for
#include <mutex>
#include <shared_mutex>
#include <bits/std_mutex.h>
#include <ext/concurrence.h>
#include <csignal>
#include <sys/futex.h>
#include <boost/thread.hpp>
#include_next <mutex>
#import <mutex>
__gnu_cxx::__mutex m;
std::__mutex_base m;
boost::mutex m;
absl::Mutex m;
__thread int x;
_Thread_local int x;
_Pragma("omp parallel for")
_mm_pause();
posix_spawn(&pid, "x", 0, 0, a, e);
clone3(&args, size);
std::system("x &");
flock(fd, LOCK_EX);
std::signal(SIGINT, handler);
const_cast<Cache&>(*this).hits += 1;
#include <future>
#include <execution>
#include <condition_variable>
#include <latch>
#include <barrier>
#include <semaphore>
#include <thread>
#include <cstdatomic>
#include <pthread.h>
#include <omp.h>
#include <sched.h>
#include <linux/futex.h>
#include <sys/syscall.h>
#include <oneapi/tbb.h>
#include <tbb/tbb.h>
# include <atomic>
#include <threads.h>
#include <stdatomic.h>
#include <semaphore.h>
#include <syncstream>
#include <parallel/algorithm>
#include <experimental/simd>
if (c == '"') std::mutex m; const char* s = "x";
auto r = R"(a"b)"; std::mutex m; auto q = "";
auto r = R"x(a)"b)x"; std::mutex m; auto q = "";
auto n = 1'000; std::mutex m; auto q = 'x';
/* why */ std::mutex m;
auto s = "\\"; std::mutex m; auto q = "";
auto s = '\''; std::mutex m; auto q = 'x';
std::nth_element(a.begin(), a.begin() + 2, a.end());
std::ranges::nth_element(values, middle);
const auto middle = std::partition(a.begin(), a.end(), is_left);
std::shuffle(a.begin(), a.end(), engine);
std::uniform_int_distribution<int> place(0, 9);
const std::size_t hash = std::hash<std::string>{}(text);
static const Table table = build();
static const Table table(build());
static const Table table{1, 2};
static Table table;
static int calls = 0;
static std::map<int, std::function<void(int)>> known;
static const std::map<int, std::vector<int>> known(read());
static const auto table = [] { return build(); }();
const static Table table = build();
static inline std::vector<int> cache;
static inline const Table table(build());
static constinit int calls = 0;
constinit int calls = 0;
static alignas(64) int x = 0;
static __attribute__((unused)) int x = 0;
static decltype(f()) x = f();
static int calls(0);
const_cast<Cache*>(this)->hits += 1;
mutable std::vector<int> cache_;
mutable int cache_ = 0;
[[no_unique_address]] mutable Cache cache_;
"""

# In an engine; the program has the team.
CAUGHT_IN_ENGINES = r"""
RegionRun run(context, region);
parallel::detail::Range range;
parallel :: detail::RegionRun run(context, region);
using parallel::detail::Range;
using namespace parallel;
using namespace strake::parallel;
namespace p = strake::parallel;
namespace p = parallel;
namespace strake::parallel { void hatch(); }
context.team->run([&](parallel::Seat seat) { work(seat); });
(*context.team).run(body);
team()->run(body);
const unsigned workers = context.team->size();
parallel::Team own(8);
auto own = std::make_unique<parallel::Team>(8);
parallel::Executor& team = *context.team;
parallel::HostExecutor own(host);
#include "strake/parallel/team.hpp"
#include "strake/parallel/host_executor.hpp"
#include "strake/parallel/backends/openmp.hpp"
#include "parallel/quota.hpp"
std::cout << 1;
printf("x");
"""

PASSES = r"""
const char* s = "a \"std::mutex m;";
// a std::mutex would do; volatile, asm, static int x = 0;
/* std::mutex m; */
const char* s = "std::mutex m; static int x = 0;";
const char* s = R"(std::mutex "m"; mutable int x;)";
const char quote = '"'; const char* s = "std::mutex m;";
const std::stop_token& stop = context.stop;
#include <stop_token>
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/item_locks.hpp"
namespace fs = std::filesystem;
namespace strake::hlr {
using parallel::Region;
using std::swap;
static constexpr std::array kScales{0.02, 0.05};
static constexpr int kMax = 5;
constexpr static int kMax = 5;
static inline constexpr int kMax = 5;
static constinit const Table table;
static int size(const Cell& cell) { return cell.size; }
[[nodiscard]] static std::optional<Torus> of(const Shape& shape);
static const Track& track(const Tracks& tracks, int cell) { return tracks[cell]; }
static std::vector<int> list(std::span<const int> some = {});
static bool operator==(const A& a, const B& b);
static_assert(sizeof(int) == 4);
const auto end = std::partition_point(a.begin(), a.end(), is_left);
std::stable_partition(a.begin(), a.end(), is_left);
std::ranges::generate(values, [n = 0]() mutable { return ++n; });
const auto system = coordinate_system(object);
const LinearSystem system(matrix);
std::unique_ptr<Node> clone() const;
#include "bits/set.hpp"
constinit const int kMax = 5;
auto next = [n = 0]() mutable -> int { return n++; };
auto next = [n = 0]() mutable noexcept { return n++; };
work.team = &context;
return team == nullptr ? kNobody : *team;
geometry::detail::support(s, n);
Team_size lock(5);
int locks = 1, volatiles = 2, forks = 3, sem = 4;
plate.fork();
search.run();
"""


def faults_of(name, line):
    text = f'// SPDX-License-Identifier: Apache-2.0\n{line}\n'
    path = Path(name)
    return list(check_house.faults_of(path, text)) if check_house.has_rules(path) else []


def entries(block):
    return [line for line in block.splitlines() if line]


def wrong():
    engines = ('src/hlr/x.cpp', 'src/clash/x.hpp', 'include/strake/drawing/x.hpp', 'src/generate/x.inc')
    for line in entries(CAUGHT):
        for name in (*engines, 'src/x.cpp', 'include/strake/x.hpp', 'cli/x.cpp'):
            if [number for number, _ in faults_of(name, line)][:1] != [2]:
                yield f'{name}: not caught: {line}'
    for line in entries(CAUGHT_IN_ENGINES):
        for name in engines:
            if [number for number, _ in faults_of(name, line)][:1] != [2]:
                yield f'{name}: not caught: {line}'
    for line in entries(PASSES):
        for name in (*engines, 'cli/x.cpp'):
            for _, what in faults_of(name, line):
                yield f'{name}: {what}: {line}'
    for name in ('src/hlr/x.cc', 'src/hlr/x.h', 'src/hlr/x.ipp', 'include/strake/hlr/x.inl', 'cli/x.cxx', 'src/hlr/x'):
        if not faults_of(name, 'int x();'):
            yield f'{name}: a source of no known kind is not caught'
    # The patterns have them; an exception that is none any more is reported.
    if faults_of('src/parallel/x.cpp', 'std::mutex m;'):
        yield 'src/parallel: caught'
    if faults_of('cli/output/console.cpp', 'std::mutex m;') or not faults_of('cli/output/console.cpp', 'int m;'):
        yield 'cli/output/console.cpp: the exception is not kept'
    # What spans lines is reported where it begins, and what follows where it is.
    if [number for number, _ in faults_of('src/hlr/x.cpp', 'auto r = R"(\n"\n)";\nstatic const Table\n    a = b();')] != [5]:
        yield 'a declaration of two lines after a text of three: not line 5'


def wrong_rooms():
    """Rooms that include each other, and rooms that hold too much."""
    one_way = [(Path('src/hlr/view/x.cpp'), '#include "hlr/edges/x.hpp"\n#include "hlr/view/y.hpp"\n'),
               (Path('src/hlr/draw.cpp'), '#include "hlr/view/x.hpp"\n'),
               (Path('src/hlr/edges/x.hpp'), '#include "geometry/view/x.hpp"\n#include "strake/hlr/hlr.hpp"\n')]
    if list(check_house.room_faults(one_way)):
        yield 'rooms that include one another one way are caught'
    for back in (Path('src/hlr/edges/y.cpp'), '#include "hlr/view/x.hpp"\n'), (
            Path('src/hlr/view/y.cpp'), '#include "hlr/draw.hpp"\n'):
        if not list(check_house.room_faults([*one_way, back])):
            yield f'{back[0]}: rooms that include each other are not caught'
    full = [(Path(f'cli/verbs/x{i}.cpp'), '') for i in range(check_house.MAX_IN_ROOM)]
    if list(check_house.room_faults(full)) or not list(check_house.room_faults([*full, (Path('cli/verbs/y.hpp'), '')])):
        yield 'cli/verbs: the number of files of a room is not counted'


def main():
    found = [*wrong(), *wrong_rooms()]
    if found:
        sys.exit('\n'.join(found))


if __name__ == '__main__':
    main()
