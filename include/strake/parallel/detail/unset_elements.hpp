// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0113 says why vectors are made longer without a value for their elements.

#include <cstddef>
#include <type_traits>
#include <vector>

namespace strake::parallel::detail {

#if defined(__GLIBCXX__) && !defined(_GLIBCXX_DEBUG) && !defined(_GLIBCXX_SANITIZE_VECTOR)

/// Whether a vector can be made longer without the calling thread writing each element.
inline constexpr bool kCanLeaveUnset = true;

/// Reaches the end of a vector's elements, which libstdc++ keeps in a base class that is protected.
template <class T>
class VectorEnd : std::vector<T> {
 public:
  static void set(std::vector<T>& values, std::size_t size) {
    std::_Vector_base<T, std::allocator<T>>& base = values;
    base._M_impl._M_finish = base._M_impl._M_start + size;
  }
};

/// Says that the first `size` elements are there: somebody has begun their lifetimes, or they are
/// of a kind that has begun with the memory and is written before it is read. The vector is empty
/// and has room for them, or somebody has ended all their lifetimes and `size` is 0.
template <class T>
void set_size_unset(std::vector<T>& values, std::size_t size) {
  VectorEnd<T>::set(values, size);
}

#else

inline constexpr bool kCanLeaveUnset = false;

/// Never called.
template <class T>
void set_size_unset(std::vector<T>& values, std::size_t size) {
  values.resize(size);
}

#endif

/// Whether memory of the type is an object of it as soon as somebody writes it (an
/// implicit-lifetime type), so that nobody need do so before.
template <class T>
inline constexpr bool kIsPlain =
    std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>;

}  // namespace strake::parallel::detail
