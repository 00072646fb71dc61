#pragma once

namespace mesher {

/// Prefetches the cache line at an address, to be called some time before the address is read. It
/// only affects timing; any address is allowed.
inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  // Without this visible side effect, g++ 12 treats a function that only prefetches as one without
  // effect and removes the calls to it.
  asm volatile("");
}

}  // namespace mesher
