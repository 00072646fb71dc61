#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/assert.h"
#include "engine/core/progress.h"
#include "engine/mesh/change_log.h"

namespace mesher {

/// The direction in which a difference is applied.
enum class Direction : std::uint8_t { forward, back };

/// A value to write to one element of an array.
template <class T>
struct ElementWrite {
  std::uint32_t index = 0;
  T value;
};

/// The bitwise difference between two states of an array of plain values: the ranges that differ,
/// with their old and new contents. Equal elements take no memory.
class ArrayDelta {
 public:
  ArrayDelta() = default;
  /// Compares the two states. O(n) at memory bandwidth, parallel. Throws Cancelled.
  template <class T>
  ArrayDelta(std::span<const T> before, std::span<const T> after, Progress* progress = nullptr)
      : ArrayDelta(std::as_bytes(before), std::as_bytes(after), sizeof(T), progress) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(std::uint32_t) == 0);
  }

  /// Returns the difference that single writes make, as if both states had been compared, in
  /// O(writes). Pre: the indices ascend and are within the array.
  template <class T>
  static ArrayDelta of_elements(std::span<const T> before,
                                std::span<const ElementWrite<T>> writes) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(std::uint32_t) == 0);
    ArrayDelta delta;
    delta.element_bytes_ = sizeof(T);
    delta.old_count_ = delta.new_count_ = before.size();
    for (const ElementWrite<T>& write : writes) {
      delta.add_element(write.index, std::as_bytes(before.subspan(write.index, 1)),
                        std::as_bytes(std::span(&write.value, 1)));
    }
    return delta;
  }

  /// Compares two states of an array whose elements have `element_bytes` bytes. As the constructor.
  static ArrayDelta of_bytes(std::span<const std::byte> before, std::span<const std::byte> after,
                             std::size_t element_bytes, Progress* progress = nullptr) {
    return {before, after, element_bytes, progress};
  }

  bool is_empty() const { return old_count_ == new_count_ && ranges_.empty(); }
  /// Returns the number of bytes that the difference occupies.
  std::size_t memory_bytes() const;

  /// Reserves memory in `array` for either state, so that `write` cannot fail. Throws
  /// std::bad_alloc.
  template <class T>
  void make_room(Array<T>& array) const {
    array.reserve(std::max(old_count_, new_count_));
  }
  /// Changes `array` from one state to the other. O(differences), apart from resizing. Pre: it is
  /// in the state that `direction` starts from.
  template <class T>
  void write(Array<T>& array, Direction direction) const {
    MESHER_ASSERT(array.size() == count(reverse(direction)));
    array.resize(count(direction));
    write_bytes(std::as_writable_bytes(std::span(array)), direction);
  }
  /// The same two for a delta made by `of_bytes`.
  void make_room_for_bytes(Array<std::byte>& array) const {
    array.reserve(std::max(old_count_, new_count_) * element_bytes_);
  }
  void write_to_bytes(Array<std::byte>& array, Direction direction) const {
    MESHER_ASSERT(array.size() == count(reverse(direction)) * element_bytes_);
    array.resize(count(direction) * element_bytes_);
    write_bytes(array, direction);
  }
  /// Calls `visit` once per range of elements that `write` changes or adds, in order.
  template <class Visit>
  void for_each_written(Direction direction, Visit&& visit) const {
    for (const ChangedRange range : ranges_)
      visit(range);
    if (count(direction) > common()) {
      visit(ChangedRange{static_cast<std::uint32_t>(common()),
                         static_cast<std::uint32_t>(count(direction))});
    }
  }

 private:
  ArrayDelta(std::span<const std::byte> before, std::span<const std::byte> after,
             std::size_t element_bytes, Progress* progress);

  void add_element(std::uint32_t index, std::span<const std::byte> before,
                   std::span<const std::byte> after);
  static Direction reverse(Direction direction) {
    return direction == Direction::forward ? Direction::back : Direction::forward;
  }
  /// Returns the number of elements in the state that `direction` leads to.
  std::size_t count(Direction direction) const {
    return direction == Direction::forward ? new_count_ : old_count_;
  }
  std::size_t common() const { return std::min(old_count_, new_count_); }
  /// Returns the contents of the changed ranges one after the other, then the elements past the
  /// common ones.
  Array<std::byte> gather(std::span<const std::byte> bytes, Progress* progress) const;
  void write_bytes(std::span<std::byte> bytes, Direction direction) const;

  std::size_t element_bytes_ = 0;
  std::size_t old_count_ = 0;
  std::size_t new_count_ = 0;
  std::vector<ChangedRange> ranges_;  ///< among the elements that both states have
  Array<std::byte> before_;
  Array<std::byte> after_;
};

}  // namespace mesher
