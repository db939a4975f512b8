// Expectations: what parses, what it means, what is refused.
#include "client/script/expression.h"

#include <cmath>
#include <gmock/gmock.h>

namespace farlight {
namespace {

using namespace client;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Calls are worth the length of their run's name, times 100 plus the frame where one is given.
double toy_value(const Call& call)
{
    return static_cast<double>(call.run.size()) + (call.frame ? 100.0 * *call.frame : 0.0);
}

bool verdict(const std::string& text)
{
    const Expectation e = parse_expectation(text);
    return holds(evaluate(e.left, toy_value), e.comparison, evaluate(e.right, toy_value));
}

TEST(Expression, Arithmetic)
{
    for (const char* truth : {"1 + 2 * 3 == 7", "(1 + 2) * 3 == 9", "2 - 3 - 4 == -5",
             "8 / 4 / 2 == 1", "-2 * -3 == 6", "1e-3 * 1000 == 1", ".5 == 0.5", "- - 2 == 2", "1<2",
             "2>=2", "2 != 3", "mean(abc) == 3", "mean( abc , 2 ) == 203", "nonfinite == 0",
             "nonfinite(ab) == 2", "relmse(ab) <= 0.5 * relmse(abcd)", "bias + variance == 0",
             "flicker(abc, 2) == 203", "ghost(ab) == 2"})
        EXPECT_TRUE(verdict(truth)) << truth;
    for (const char* lie : {"1 < 1", "2 <= 1", "1 > 1", "1 >= 2", "1 == 2", "1 != 1", "not_black"})
        EXPECT_FALSE(verdict(lie)) << lie;
}

TEST(Expression, NothingHoldsForNan)
{
    for (const Comparison comparison :
        {Comparison::kLessEqual, Comparison::kLess, Comparison::kGreaterEqual, Comparison::kGreater,
            Comparison::kEqual, Comparison::kNotEqual}) {
        EXPECT_FALSE(holds(std::nan(""), comparison, 1)) << to_string(comparison);
        EXPECT_FALSE(holds(1, comparison, std::nan(""))) << to_string(comparison);
    }
    EXPECT_FALSE(verdict("0 / 0 != 1"));
}

TEST(Expression, CallsAreFoundInOrder)
{
    const auto calls = calls_in(parse_expectation("relmse(a) + mean(b, 3) <= -max(c)"));
    ASSERT_EQ(calls.size(), 3U);
    EXPECT_EQ(calls[0].run, "a");
    EXPECT_EQ(calls[1].frame, 3);
    EXPECT_EQ(calls[2].function->name, "max");
}

struct BadExpectation {
    const char* name;
    const char* text;
    const char* complaint;
};
class ParseRefuses : public testing::TestWithParam<BadExpectation> { };

TEST_P(ParseRefuses, SayingWhereAndWhy)
{
    EXPECT_THAT([] { parse_expectation(GetParam().text); },
        ThrowsMessage<ExpressionError>(HasSubstr(GetParam().complaint)));
}

INSTANTIATE_TEST_SUITE_P(Expectations, ParseRefuses,
    testing::Values(
        BadExpectation{"Empty", "", "column 1: found the end, expected a number or a function"},
        BadExpectation{"UnknownFunction", "1 < beauty(a)",
            "column 5: found 'beauty(a)', expected one of nonfinite,"},
        BadExpectation{"NoComparison", "mean(a)", "column 8: found the end, expected a comparison"},
        BadExpectation{"NumberAlone", "1", "expected a comparison"},
        BadExpectation{"PredicateCompared", "not_black == 1", "expected it alone"},
        BadExpectation{"PredicateInASum", "1 + not_black == 1", "expected it alone"},
        BadExpectation{"TwoComparisons", "1 < 2 < 3",
            "column 7: found '< 3', expected the end or an operator"},
        BadExpectation{"RunMissing", "relmse <= 1",
            "column 8: found '<= 1', expected '(' and the name of a run"},
        BadExpectation{
            "RunEmpty", "relmse() <= 1", "column 8: found ') <= 1', expected the name of a run"},
        BadExpectation{
            "FrameNotTaken", "frames(a, 1) == 2", "column 9: found ', 1) == 2', expected ')'"},
        BadExpectation{"FrameNotANumber", "mean(a, b) == 2", "expected a number"},
        BadExpectation{"RunNotTaken", "bias(a) < 1", "column 5: found '(a) < 1', expected the end"},
        BadExpectation{"Unclosed", "(1 + 2 == 3", "expected ')'"},
        BadExpectation{"Dot", ". == 1", "expected a number"},
        BadExpectation{"TrailingOperator", "1 + == 2", "column 5: found '== 2'"}),
    [](const auto& tested) { return tested.param.name; });

TEST(Expression, EndlessNestingIsRefused)
{
    EXPECT_THROW(parse_expectation(std::string(100'000, '(')), ExpressionError);
    EXPECT_THROW(parse_expectation(std::string(100'000, '-') + "1 == 1"), ExpressionError);
}

}  // namespace
}  // namespace farlight
