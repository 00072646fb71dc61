#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace mesher {

/// Returns memory for a large array, on huge pages where the system grants them. It begins on a
/// cache line (64 bytes). Touching fresh memory in pages of 4 kB costs about as much as the work
/// done on it (a third of the time to build a mesh of 2 million triangles). Throws std::bad_alloc.
void* allocate_array(std::size_t bytes);
/// Frees memory from `allocate_array`. Pre: `bytes` is the size passed there.
void free_array(void* memory, std::size_t bytes) noexcept;

/// Whether `resize(n)` leaves new elements of type T uninitialized. A type with a constructor may
/// declare a static member `kLeftUninitialized` if its arrays are always written completely before
/// they are read. It must be trivially copyable: its lifetime begins without a constructor call.
template <class T>
concept LeftUninitialized = std::is_trivially_default_constructible_v<T> || requires {
  T::kLeftUninitialized;
};

/// An allocator whose `resize(n)` leaves elements of a LeftUninitialized type uninitialized.
/// Filling fresh pages with values that are overwritten at once costs as much as the work itself.
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
    if constexpr (LeftUninitialized<U>) {
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
