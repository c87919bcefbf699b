// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace strake {

/// Values that never change once they are there, so that copies may share them: a copy costs one
/// count, and equal arrays that were made once lie in memory once.
///
///     const SharedArray<int> a = std::vector<int>{1, 2, 3};
///     const SharedArray<int> b = a;  // the same three values
///
/// Reading is safe from any number of threads; an object of this class is as safe as a pointer.
template <class T>
class SharedArray {
 public:
  using value_type = T;
  using const_iterator = const T*;

  SharedArray() = default;
  // Implicit: an array is what its values are.
  SharedArray(std::vector<T> values) {  // NOLINT(google-explicit-constructor)
    if (values.empty()) return;
    const auto owner = std::make_shared<const std::vector<T>>(std::move(values));
    size_ = owner->size();
    first_ = std::shared_ptr<const T>(owner, owner->data());
  }
  SharedArray(std::initializer_list<T> values) : SharedArray(std::vector<T>(values)) {}
  explicit SharedArray(std::span<const T> values)
      : SharedArray(std::vector<T>(values.begin(), values.end())) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] const T* data() const { return first_.get(); }
  [[nodiscard]] const T* begin() const { return data(); }
  [[nodiscard]] const T* end() const { return data() + size_; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return data()[i]; }
  [[nodiscard]] const T& front() const { return data()[0]; }
  [[nodiscard]] const T& back() const { return data()[size_ - 1]; }

  /// Returns a copy that may be changed.
  [[nodiscard]] std::vector<T> to_vector() const { return {begin(), end()}; }

  friend bool operator==(const SharedArray& a, const SharedArray& b) {
    return a.size_ == b.size_ &&
           (a.data() == b.data() || std::equal(a.begin(), a.end(), b.begin()));
  }
  friend bool operator<(const SharedArray& a, const SharedArray& b) {
    return a.data() != b.data() &&
           std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::shared_ptr<const T> first_;
  std::size_t size_ = 0;
};

}  // namespace strake
