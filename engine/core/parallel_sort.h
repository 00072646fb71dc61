#pragma once

#ifdef MESHER_STD_THREADS
#include <algorithm>
#else
#include <tbb/parallel_sort.h>
#endif

namespace mesher {

/// Sorts in parallel. Pre: `less` is a total order without equal elements, so that the result does
/// not depend on the number of threads.
template <class Iterator, class Less>
void parallel_sort(Iterator begin, Iterator end, const Less& less) {
#ifdef MESHER_STD_THREADS
  std::sort(begin, end, less);
#else
  tbb::parallel_sort(begin, end, less);
#endif
}

}  // namespace mesher
