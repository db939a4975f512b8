// Guards in C++: on until the laboratory takes one out, and rows and guards name the same.
#include "lab/host_guards.h"

#include "server/host_guard.h"

#include <gmock/gmock.h>

namespace farlight::lab {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const HostGuard of_this_test("of_this_test");
const HostGuard other("other");

TEST(HostGuardsTest, IsOnUntilItIsTakenOut)
{
    EXPECT_THAT(HostGuards::names(), Contains("of_this_test"));
    EXPECT_TRUE(of_this_test);
    EXPECT_TRUE(HostGuards::take_out("of_this_test"));
    EXPECT_FALSE(of_this_test);
    EXPECT_TRUE(other);
    EXPECT_FALSE(HostGuards::take_out("of_no_test"));
}

TEST(HostGuardsTest, RowsAndGuardsNameTheSame)
{
    constexpr Guard kShader{"in_a_shader", "1", "lib/a.glsl", "text", ""};
    constexpr Guard kHost{"in_host", "2"};
    const Guard both[] = {kShader, kHost};
    EXPECT_THAT(disagreement(both, {"in_host"}), IsEmpty());
    EXPECT_THAT(disagreement(both, {}), HasSubstr("no C++ of this process has"));
    EXPECT_THAT(disagreement(both, {"in_host", "more"}), HasSubstr("'more' in C++ keeps"));
    EXPECT_THAT(disagreement(both, {"in_host", "in_host"}), HasSubstr("two places in C++"));
    // A shader's row is not a row of the C++ that is called so.
    EXPECT_THAT(disagreement(both, {"in_host", "in_a_shader"}), HasSubstr("'in_a_shader' in C++"));
    const Guard twice[] = {kHost, kHost};
    EXPECT_THAT(disagreement(twice, {"in_host"}), HasSubstr("two guards are called 'in_host'"));
}

}  // namespace
}  // namespace farlight::lab
