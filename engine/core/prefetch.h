#pragma once

namespace mesher {

/// Asks the caches for what lies at an address, some time before it is read. Changes nothing but
/// time; any address will do.
inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  // Without an effect that it can see g++ 12 takes a function that only prefetches for one that
  // does nothing, and drops the calls of it.
  asm volatile("");
}

}  // namespace mesher
