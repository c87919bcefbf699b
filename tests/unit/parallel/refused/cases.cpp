// SPDX-License-Identifier: Apache-2.0
// Each case is misuse that would compile to a wrong result or a page of errors: it must not
// compile, and must say why. CASE is the number of the one that is compiled, 0 of none;
// check_refused.py compares the words after "refused:".
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/find.hpp"
#include "strake/parallel/pipeline.hpp"
#include "strake/parallel/precomputed.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/reservations.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::parallel {

void all(const Context& context, const Region& region) {
  [[maybe_unused]] const auto no_answer = [](std::size_t) { return Result<bool>(false); };
  [[maybe_unused]] const auto no_value = [](std::size_t) { return Status(); };
  // Not refused.
  const std::function<std::size_t(std::size_t)> function = [](std::size_t i) { return i; };
  (void)transform(context, region, function);
  (void)transform(context, region, +[](std::size_t i) { return static_cast<int>(i); });
  (void)transform(context, region, [p = std::make_unique<int>(3)](auto i) { return i + *p; });
  (void)reduce(
      context, region, 0, [](auto& sum, auto i) { sum += static_cast<int>(i); },
      [](auto& into, auto sum) { into += sum; });
  (void)collect<int>(context, region, [](auto, auto& out) { out.push_back(1); });
  int shared = 0;
  (void)for_each_with(
      context, region, [&] { return std::ref(shared); }, [](const auto&, std::size_t) {});
  std::vector<bool> flags(3);
  (void)all_of(context, region, [&](std::size_t i) -> decltype(auto) { return flags[i]; });
#if CASE == 1  // refused: workers call it at the same time
  (void)for_each(context, region, [n = 0](std::size_t) mutable { ++n; });
#elif CASE == 2   // refused: workers call it at the same time
  (void)transform(context, region, [n = 0](std::size_t) mutable { return ++n; });
#elif CASE == 3   // refused: workers call it at the same time
  (void)for_each_with(context, region, [n = 0]() mutable { return ++n; }, [](int&, std::size_t) {});
#elif CASE == 4   // refused: the test returns bool
  (void)find_first(context, region, no_answer);
#elif CASE == 5   // refused: the test returns bool
  (void)all_of(context, region, no_answer);
#elif CASE == 6   // refused: the body returns a value, not a Result or Status
  (void)transform_until(context, region, no_value, [](const Status&) { return false; });
#elif CASE == 7   // refused: the test returns bool
  (void)distinct(
      context, "kinds", 3, [](std::size_t i) { return std::uint64_t{i}; },
      [&](std::size_t i, std::size_t) { return no_answer(i); });
#elif CASE == 8   // refused: claim returns void or bool
  (void)for_each_reserved(
      context, region, 3, [&](std::size_t i, Claims&) { return no_answer(i); }, [](std::size_t) {});
#elif CASE == 9   // refused: combine changes its first argument
  (void)reduce(context, region, 0, [](int& sum, std::size_t) { ++sum; }, std::plus<>());
#elif CASE == 10  // refused: the body takes its partial by reference
  (void)reduce(
      context, region, 0, [](int sum, std::size_t) { ++sum; },
      [](int& into, int sum) { into += sum; });
#elif CASE == 11  // refused: the body takes out by reference
  (void)collect<int>(context, region, [](std::size_t, auto out) { out.push_back(1); });
#elif CASE == 12  // refused: it returns a value, or a Result of one
  (void)transform(context, region, no_value);
#elif CASE == 13  // refused: it returns a value, or a Result of one
  (void)transform(context, region, [](std::size_t) {});
#elif CASE == 14  // refused: it returns a value, or a Result of one
  (void)pipeline(
      context, {}, [] { return std::optional<int>(); }, [](int) { return Status(); }, [](int) {});
#elif CASE == 15  // refused: make() returns a worker context
  (void)for_each_with(context, region, [] {}, [](int&, std::size_t) {});
#elif CASE == 16  // refused: return uint8_t
  (void)transform(context, region, [](std::size_t i) { return i > 3; });
#elif CASE == 17  // refused: workers call it at the same time
  (void)Precomputed<int>(3).fill(context, region, {}, [n = 0](std::size_t) mutable { return ++n; });
#elif CASE == 18  // refused: workers call it at the same time
  (void)count_fill<int>(
      context, region, [n = 0U](std::size_t) mutable { return ++n; },
      [](std::size_t, std::span<int>) {});
#elif CASE == 19  // refused: make() returns a worker context
  (void)transform_with(context, region, [] {}, [](int&, std::size_t i) { return i; });
#elif CASE == 20  // refused: the body returns a value
  (void)transform_until(context, region, [](std::size_t) {}, [](int) { return false; });
#endif
}

}  // namespace strake::parallel
