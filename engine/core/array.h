#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace mesher {

/// Allocator that leaves trivially constructible elements uninitialised on `resize(n)`: filling
/// fresh pages with zeros that are overwritten at once costs as much as the work itself.
template <class T>
class DefaultInitAllocator : public std::allocator<T> {
 public:
  using std::allocator<T>::allocator;
  template <class U>
  struct rebind {
    using other = DefaultInitAllocator<U>;
  };
  template <class U>
  void construct(U* p) noexcept(std::is_nothrow_default_constructible_v<U>) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    std::allocator_traits<std::allocator<T>>::construct(static_cast<std::allocator<T>&>(*this), p,
                                                        std::forward<Args>(args)...);
  }
};

/// A vector whose `resize(n)` does not zero-fill. `assign(n, value)` fills as usual.
template <class T>
using Array = std::vector<T, DefaultInitAllocator<T>>;

}  // namespace mesher
