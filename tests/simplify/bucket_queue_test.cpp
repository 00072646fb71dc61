#include "engine/simplify/bucket_queue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace mesher::test {
namespace {

TEST(BucketQueue, BucketsIncreaseWithCostAndAreNarrow) {
  EXPECT_EQ(simplify::BucketQueue::bucket_of(0.0F), simplify::BucketQueue::bucket_of(-0.0F));
  EXPECT_LT(simplify::BucketQueue::bucket_of(std::numeric_limits<float>::infinity()),
            simplify::BucketQueue::kBuckets);
  std::uint32_t last = 0;
  for (float cost = 1e-30F; cost < 1e30F; cost *= 1.01F) {
    const std::uint32_t bucket = simplify::BucketQueue::bucket_of(cost);
    EXPECT_GE(bucket, last);
    EXPECT_GT(simplify::BucketQueue::bucket_of(cost * 1.04F), bucket);
    EXPECT_LT(simplify::BucketQueue::highest_below(bucket), cost);
    EXPECT_EQ(simplify::BucketQueue::bucket_of(simplify::BucketQueue::highest_below(bucket)) + 1,
              bucket);
    last = bucket;
  }
  EXPECT_LT(simplify::BucketQueue::highest_below(0), 0.0F);
}

TEST(BucketQueue, EqualCostsLeaveInInsertionOrder) {
  std::vector<simplify::QueueEntry> entries(10);
  simplify::BucketQueue queue(entries);
  for (const std::uint32_t v : {7U, 2U, 9U, 4U})
    queue.push(Vertex(v), 1.0F);
  queue.remove(Vertex(9));
  for (const std::uint32_t v : {7U, 2U, 4U}) {
    EXPECT_EQ(queue.front(), Vertex(v));
    queue.remove(Vertex(v));
  }
  EXPECT_FALSE(queue.front().is_valid());
  queue.remove(Vertex(3));  // not in the queue, so nothing happens
  EXPECT_FALSE(queue.contains(Vertex(3)));
}

TEST(BucketQueue, BehindReturnsTheNextVertexOfTheBucket) {
  std::vector<simplify::QueueEntry> entries(10);
  simplify::BucketQueue queue(entries);
  for (const std::uint32_t v : {7U, 2U, 9U})
    queue.push(Vertex(v), 1.0F);
  queue.push(Vertex(4), 8.0F);
  EXPECT_EQ(queue.behind(Vertex(7)), Vertex(2));
  queue.remove(Vertex(2));
  EXPECT_EQ(queue.behind(Vertex(7)), Vertex(9));
  EXPECT_FALSE(queue.behind(Vertex(9)).is_valid());  // the next vertex is in another bucket
  EXPECT_EQ(queue.bucket(Vertex(4)), simplify::BucketQueue::bucket_of(8.0F));
  EXPECT_EQ(queue.bucket(Vertex(2)), kNone);
}

TEST(BucketQueue, AgreesWithSortedSetOnRandomOperations) {
  std::mt19937 random(11);
  constexpr std::uint32_t kVertices = 500;
  std::vector<simplify::QueueEntry> entries(kVertices);
  simplify::BucketQueue queue(entries);
  std::set<std::pair<std::uint32_t, std::uint32_t>> oracle;  // bucket, vertex
  for (int step = 0; step < 20'000; ++step) {
    const Vertex v(static_cast<std::uint32_t>(random() % kVertices));
    if (queue.contains(v)) {
      oracle.erase({entries[v.index()].bucket, v.index()});
      queue.remove(v);
    } else {
      const float cost = std::ldexp(static_cast<float>(random() % 1000), int(random() % 40) - 20);
      queue.push(v, cost);
      oracle.insert({simplify::BucketQueue::bucket_of(cost), v.index()});
    }
    const Vertex front = queue.front();
    ASSERT_EQ(front.is_valid(), !oracle.empty());
    if (front.is_valid()) {
      ASSERT_EQ(entries[front.index()].bucket, oracle.begin()->first);
    }
  }
}

}  // namespace
}  // namespace mesher::test
