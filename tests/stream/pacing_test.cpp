// Pacing, TokenBucket and Latest: the three small pieces that keep a client's share bounded.
#include "server/stream/latest.h"
#include "server/stream/pacing.h"
#include "server/stream/token_bucket.h"

#include <gtest/gtest.h>
#include <thread>

namespace farlight {
namespace {

using namespace std::chrono_literals;

constexpr Pacing::Time kFirstSent{1h};

TEST(Pacing, AllowsAWindowOfFramesAndNoMore)
{
    Pacing pacing(2);
    pacing.started();
    EXPECT_TRUE(pacing.may_start());
    pacing.started();
    EXPECT_FALSE(pacing.may_start());
    EXPECT_EQ(pacing.in_flight(), 2);

    pacing.sent(1, kFirstSent, std::nullopt);
    EXPECT_FALSE(pacing.may_start());  // sent is not acknowledged
    pacing.dropped();
    EXPECT_TRUE(pacing.may_start());
}

TEST(Pacing, AcknowledgesAFrameAndAllBeforeIt)
{
    Pacing pacing(3);
    for (std::uint32_t id = 1; id <= 3; ++id) {
        pacing.started();
        pacing.sent(id, kFirstSent + id * 1ms, id == 2 ? std::optional(kFirstSent) : std::nullopt);
    }
    const auto shown = pacing.acknowledge(2, kFirstSent + 30ms);
    ASSERT_TRUE(shown.has_value());
    EXPECT_EQ(shown->round_trip, 28ms);
    EXPECT_EQ(shown->since_asked, 30ms);
    EXPECT_EQ(pacing.in_flight(), 1);
}

TEST(Pacing, RefusesAcknowledgementsOfFramesNotInFlight)
{
    Pacing pacing(2);
    EXPECT_FALSE(pacing.acknowledge(0, kFirstSent));
    EXPECT_FALSE(pacing.acknowledge(1, kFirstSent));
    pacing.started();
    pacing.sent(1, kFirstSent, std::nullopt);
    EXPECT_FALSE(pacing.acknowledge(2, kFirstSent));
    EXPECT_FALSE(pacing.acknowledge(4294967295U, kFirstSent));
    EXPECT_EQ(pacing.in_flight(), 1);
    EXPECT_TRUE(pacing.acknowledge(1, kFirstSent));
    EXPECT_FALSE(pacing.acknowledge(1, kFirstSent));  // a second time
}

TEST(Pacing, GoesOnWhenFrameIdsWrapRound)
{
    Pacing pacing(4, 4294967293U);
    for (std::uint32_t i = 0; i < 4; ++i) {
        pacing.started();
        pacing.sent(4294967294U + i, kFirstSent, std::nullopt);  // the third is 0
    }
    EXPECT_FALSE(pacing.acknowledge(2, kFirstSent));  // never sent
    EXPECT_FALSE(pacing.acknowledge(4294967293U, kFirstSent));  // long ago
    EXPECT_TRUE(pacing.acknowledge(4294967294U, kFirstSent));
    EXPECT_EQ(pacing.in_flight(), 3);
    EXPECT_TRUE(pacing.acknowledge(1, kFirstSent));
    EXPECT_EQ(pacing.in_flight(), 0);
}

TEST(Pacing, BlamesTheClientOnlyForFramesTheSocketIsDoneWith)
{
    Pacing pacing(2);
    pacing.started();
    pacing.sent(1, kFirstSent, std::nullopt);
    EXPECT_EQ(pacing.oldest_wait(kFirstSent + 20s), 0s);
    pacing.written(1, kFirstSent + 20s);
    EXPECT_EQ(pacing.oldest_wait(kFirstSent + 23s), 3s);
    pacing.acknowledge(1, kFirstSent + 23s);
    EXPECT_EQ(pacing.oldest_wait(kFirstSent + 60s), 0s);
}

TEST(TokenBucket, LetsABurstThroughAndThenARate)
{
    TokenBucket bucket(10, 5, kFirstSent);
    for (int i = 0; i < 10; ++i)
        EXPECT_EQ(bucket.take(kFirstSent), 0s);
    EXPECT_EQ(bucket.take(kFirstSent), 200ms);  // one token in debt, five a second
    EXPECT_EQ(bucket.take(kFirstSent + 400ms), 0s);
}

TEST(TokenBucket, NeverHoldsMoreThanTheBurst)
{
    TokenBucket bucket(2, 100, kFirstSent);
    EXPECT_EQ(bucket.take(kFirstSent + 1h), 0s);
    EXPECT_EQ(bucket.take(kFirstSent + 1h), 0s);
    EXPECT_GT(bucket.take(kFirstSent + 1h), 0s);
}

TEST(Latest, KeepsTheNewestValue)
{
    Latest<int> latest;
    EXPECT_FALSE(latest.waiting());
    EXPECT_FALSE(latest.replace(1));
    latest.put(2);
    EXPECT_TRUE(latest.replace(3));
    latest.put(4);
    EXPECT_TRUE(latest.waiting());
    EXPECT_EQ(latest.take(), 4);
    EXPECT_EQ(latest.take(), std::nullopt);
}

TEST(Latest, IsSafeBetweenTwoThreadsAndNeverGoesBack)
{
    Latest<int> latest;
    constexpr int kLast = 20000;
    std::thread writer([&] {
        for (int i = 1; i <= kLast; ++i)
            latest.put(i);
    });
    int newest = 0;
    while (newest < kLast)
        if (const auto value = latest.take()) {
            ASSERT_GT(*value, newest);
            newest = *value;
        }
    writer.join();
}

}  // namespace
}  // namespace farlight
