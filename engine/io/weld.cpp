#include "engine/io/weld.h"

#include <cstring>
#include <numeric>
#include <span>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/parallel_sort.h"
#include "engine/mesh/ids.h"

namespace mesher::io {
namespace {

constexpr std::size_t kWeldGrain = std::size_t{1} << 14;
constexpr std::size_t kItemsBetweenReports = std::size_t{1} << 16;
constexpr std::uint32_t kBucketBits = 10;
constexpr std::size_t kBuckets = std::size_t{1} << kBucketBits;
/// Times of distributing, sorting and numbering, measured with 4 and 40 million items.
constexpr double kWeldWeights[] = {0.2, 0.77, 0.03};

struct Entry {
  std::uint32_t hash;
  std::uint32_t item;
};

std::uint32_t hash_of(const std::uint32_t* item, std::size_t words) {
  std::uint64_t hash = 0x9E3779B97F4A7C15U;
  for (std::size_t i = 0; i < words; ++i) {
    hash = (hash ^ item[i]) * 0xD6E8FEB86659FD93U;
    hash ^= hash >> 32;
  }
  return static_cast<std::uint32_t>(hash);
}

/// Entries by the highest bits of their hash.
struct Buckets {
  Array<Entry> entries;
  std::vector<std::size_t> start = std::vector<std::size_t>(kBuckets + 1, 0);

  std::span<Entry> entries_of(std::size_t bucket) {
    return {entries.data() + start[bucket], start[bucket + 1] - start[bucket]};
  }
};

std::size_t bucket_of(std::uint32_t hash) {
  return hash >> (32 - kBucketBits);
}

/// Within a bucket, entries keep the order of their items.
Buckets distributed(const std::uint32_t* items, std::size_t words, std::size_t count,
                    Progress* progress) {
  Stages stages(progress, {0.33, 0.67});
  stages.next();
  Array<std::uint32_t> hashes(count);
  parallel_chunks(count, kWeldGrain, progress, [&](std::size_t, IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      hashes[i] = hash_of(items + i * words, words);
  });
  stages.next();
  Buckets buckets;
  for (const std::uint32_t hash : hashes)
    ++buckets.start[bucket_of(hash) + 1];
  std::partial_sum(buckets.start.begin(), buckets.start.end(), buckets.start.begin());
  std::vector<std::size_t> next(buckets.start.begin(), buckets.start.end() - 1);
  buckets.entries.resize(count);
  ordered_chunks(count, kItemsBetweenReports, progress, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      buckets.entries[next[bucket_of(hashes[i])]++] = {hashes[i], static_cast<std::uint32_t>(i)};
  });
  return buckets;
}

/// Sets the lowest equal item of each item of a bucket.
void find_lowest(const std::uint32_t* items, std::size_t words, std::span<Entry> entries,
                 Array<std::uint32_t>& lowest_of) {
  const auto compare = [&](const Entry& a, const Entry& b) {
    return std::memcmp(items + a.item * words, items + b.item * words,
                       words * sizeof(std::uint32_t));
  };
  // The hash only speeds up most comparisons. Equal hashes are resolved by comparing the items. A
  // bucket is large only if many items are equal, so it is sorted in parallel too.
  parallel_sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
    if (a.hash != b.hash) return a.hash < b.hash;
    const int order = compare(a, b);
    return order != 0 ? order < 0 : a.item < b.item;
  });
  std::uint32_t lowest = kNone;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool is_same =
        i > 0 && entries[i].hash == entries[i - 1].hash && compare(entries[i], entries[i - 1]) == 0;
    if (!is_same) lowest = entries[i].item;
    lowest_of[entries[i].item] = lowest;
  }
}

}  // namespace

Weld weld(const std::uint32_t* items, std::size_t words, std::size_t count, Progress* progress) {
  Stages stages(progress, kWeldWeights);
  stages.next();
  Buckets buckets = distributed(items, words, count, progress);
  stages.next();
  Weld result;
  result.index.resize(count);
  parallel_chunks(kBuckets, 1, progress, [&](std::size_t bucket, IndexRange) {
    find_lowest(items, words, buckets.entries_of(bucket), result.index);
  });
  stages.next();
  // The lowest of equal items comes first, so its number is known when the others need it.
  ordered_chunks(count, kItemsBetweenReports, progress, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (result.index[i] == i) {
        result.index[i] = static_cast<std::uint32_t>(result.first.size());
        result.first.push_back(static_cast<std::uint32_t>(i));
      } else {
        result.index[i] = result.index[result.index[i]];
      }
    }
  });
  return result;
}

Weld weld_positions(const Array<glm::vec3>& positions, Progress* progress) {
  Array<glm::vec3> keys(positions.size());
  parallel_for(positions.size(), kWeldGrain, [&](IndexRange range) {
    // Adding 0 turns -0 into 0 and changes nothing else.
    for (std::size_t i = range.begin; i < range.end; ++i)
      keys[i] = positions[i] + 0.0F;
  });
  return weld(reinterpret_cast<const std::uint32_t*>(keys.data()), 3, keys.size(), progress);
}

}  // namespace mesher::io
