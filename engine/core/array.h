#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace mesher {

/// Memory for large arrays, on huge pages where the system grants them: touching fresh memory in
/// pages of 4 kB costs about as much as the work that is done on it (building a mesh of 2 million
/// triangles: a third of the time). Begins on a cache line (64 bytes). Throws std::bad_alloc.
void* allocate_array(std::size_t bytes);
/// `bytes`: what it was allocated with.
void free_array(void* memory, std::size_t bytes) noexcept;

/// Whether `resize(n)` leaves elements of the type as the memory was. A type that has a constructor
/// may be declared such where its arrays are written whole before they are read (it must be
/// trivially copyable, so that it needs no constructor to begin its life).
template <class T>
inline constexpr bool kLeftAsItWas = std::is_trivially_default_constructible_v<T>;

/// Allocator that leaves trivially constructible elements (and those of kLeftAsItWas) uninitialised
/// on `resize(n)`: filling fresh pages with what is overwritten at once costs as much as the work
/// itself.
template <class T>
class DefaultInitAllocator : public std::allocator<T> {
 public:
  using std::allocator<T>::allocator;
  template <class U>
  struct rebind {
    using other = DefaultInitAllocator<U>;
  };
  T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_array(n * sizeof(T)));
  }
  void deallocate(T* p, std::size_t n) noexcept { free_array(p, n * sizeof(T)); }
  template <class U>
  void construct(U* p) noexcept(std::is_nothrow_default_constructible_v<U>) {
    if constexpr (kLeftAsItWas<U>) {
      static_assert(std::is_trivially_copyable_v<U>);
    } else {
      ::new (static_cast<void*>(p)) U;
    }
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
