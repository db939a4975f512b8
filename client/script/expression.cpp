// Parsing by recursive descent, evaluation by walking the tree.
#include "client/script/expression.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>

namespace farlight::client {
namespace {

constexpr int kMaxNesting = 64;  // deeper parentheses are refused, not recursed into

/// In the order to try them: longer ones first.
constexpr std::pair<std::string_view, Comparison> kComparisons[] = {{"<=", Comparison::kLessEqual},
    {">=", Comparison::kGreaterEqual}, {"==", Comparison::kEqual}, {"!=", Comparison::kNotEqual},
    {"<", Comparison::kLess}, {">", Comparison::kGreater}};

bool is_predicate(const Expression& expression)
{
    return expression.kind == Expression::Kind::kCall && expression.call.function->predicate;
}

class Parser {
public:
    explicit Parser(const std::string& text) : text_(text) { }

    Expectation parse()
    {
        Expectation result{.text = text_, .left = sum()};
        for (const auto& [symbol, comparison] : kComparisons) {
            if (!take(symbol))
                continue;
            result.comparison = comparison;
            result.right = sum();
            break;
        }
        skip_space();
        if (at_ != text_.size())
            fail("the end or an operator");
        if (result.comparison == Comparison::kNone && !is_predicate(result.left))
            fail("a comparison");
        if (result.comparison != Comparison::kNone
            && (holds_predicate(result.left) || holds_predicate(result.right)))
            throw ExpressionError(
                "'" + text_ + "': found a yes-or-no function in a comparison, expected it alone");
        return result;
    }

private:
    using Kind = Expression::Kind;

    static bool holds_predicate(const Expression& expression)
    {
        return is_predicate(expression)
            || std::any_of(expression.operands.begin(), expression.operands.end(), holds_predicate);
    }

    [[noreturn]] void fail(const std::string& expected) const
    {
        const std::string found =
            at_ < text_.size() ? "'" + text_.substr(at_, 20) + "'" : std::string("the end");
        throw ExpressionError("'" + text_ + "', column " + std::to_string(at_ + 1) + ": found "
            + found + ", expected " + expected);
    }

    void skip_space()
    {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0)
            ++at_;
    }

    bool take(std::string_view symbol)
    {
        skip_space();
        if (text_.compare(at_, symbol.size(), symbol) != 0)
            return false;
        at_ += symbol.size();
        return true;
    }

    static Expression combined(Kind kind, Expression a, Expression b)
    {
        Expression result{.kind = kind};
        result.operands.push_back(std::move(a));
        result.operands.push_back(std::move(b));
        return result;
    }

    Expression sum()
    {
        Expression result = product();
        while (true) {
            if (take("+"))
                result = combined(Kind::kAdd, std::move(result), product());
            else if (take("-"))
                result = combined(Kind::kSubtract, std::move(result), product());
            else
                return result;
        }
    }

    Expression product()
    {
        Expression result = factor();
        while (true) {
            if (take("*"))
                result = combined(Kind::kMultiply, std::move(result), factor());
            else if (take("/"))
                result = combined(Kind::kDivide, std::move(result), factor());
            else
                return result;
        }
    }

    Expression factor()
    {
        if (++nesting_ > kMaxNesting)
            fail("less nesting");
        Expression result = unnested_factor();
        --nesting_;
        return result;
    }

    Expression unnested_factor()
    {
        if (take("-")) {
            Expression result{.kind = Kind::kNegate};
            result.operands.push_back(factor());
            return result;
        }
        if (take("(")) {
            Expression result = sum();
            if (!take(")"))
                fail("')'");
            return result;
        }
        skip_space();
        if (at_ < text_.size()
            && (std::isdigit(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '.'))
            return {.kind = Kind::kNumber, .number = number<double>()};
        return call();
    }

    template <typename Number> Number number()
    {
        Number value{};
        const char* begin = text_.data() + at_;
        const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
        if (error != std::errc())
            fail("a number");
        at_ += static_cast<std::size_t>(end - begin);
        return value;
    }

    std::string name(const std::string& expected)
    {
        skip_space();
        const std::size_t start = at_;
        while (at_ < text_.size()
            && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
            ++at_;
        if (start == at_)
            fail(expected);
        return text_.substr(start, at_ - start);
    }

    Expression call()
    {
        skip_space();
        const std::size_t start = at_;
        const std::string function = name("a number or a function");
        Expression result{.kind = Kind::kCall};
        result.call.function = find_function(function);
        if (result.call.function == nullptr) {
            at_ = start;
            std::string known;
            for (const Function& candidate : kFunctions)
                known += (known.empty() ? "" : ", ") + std::string(candidate.name);
            fail("one of " + known);
        }
        const Of of = result.call.function->of;
        if (of != Of::kAllRuns && take("(")) {
            result.call.run = name("the name of a run");
            if (result.call.function->takes_frame() && take(",")) {
                skip_space();
                result.call.frame = number<int>();
            }
            if (!take(")"))
                fail("')'");
        } else if (of != Of::kAllRuns && of != Of::kRunOrAll) {
            fail("'(' and the name of a run");
        }
        return result;
    }

    const std::string& text_;
    std::size_t at_ = 0;
    int nesting_ = 0;
};

void collect_calls(const Expression& expression, std::vector<Call>& calls)
{
    if (expression.kind == Expression::Kind::kCall)
        calls.push_back(expression.call);
    for (const Expression& operand : expression.operands)
        collect_calls(operand, calls);
}

}  // namespace

std::string_view to_string(Of of)
{
    switch (of) {
    case Of::kRunOrAll: return "a run, or all";
    case Of::kRun: return "a run";
    case Of::kFrame: return "a run, a frame";
    case Of::kFramesFrom: return "a run, a first frame";
    case Of::kAllRuns: return "all runs";
    }
    return "";
}

const Function* find_function(std::string_view name)
{
    const auto* const found = std::find_if(std::begin(kFunctions), std::end(kFunctions),
        [&](const Function& f) { return f.name == name; });
    return found == std::end(kFunctions) ? nullptr : found;
}

Expectation parse_expectation(const std::string& text)
{
    return Parser(text).parse();
}

std::vector<Call> calls_in(const Expectation& expectation)
{
    std::vector<Call> calls;
    collect_calls(expectation.left, calls);
    collect_calls(expectation.right, calls);
    return calls;
}

double evaluate(const Expression& expression, const std::function<double(const Call&)>& value_of)
{
    const auto operand = [&](std::size_t i) { return evaluate(expression.operands[i], value_of); };
    switch (expression.kind) {
    case Expression::Kind::kNumber: return expression.number;
    case Expression::Kind::kCall: return value_of(expression.call);
    case Expression::Kind::kNegate: return -operand(0);
    case Expression::Kind::kAdd: return operand(0) + operand(1);
    case Expression::Kind::kSubtract: return operand(0) - operand(1);
    case Expression::Kind::kMultiply: return operand(0) * operand(1);
    case Expression::Kind::kDivide: return operand(0) / operand(1);
    }
    return std::nan("");
}

bool holds(double left, Comparison comparison, double right)
{
    switch (comparison) {
    case Comparison::kNone: return left != 0;
    case Comparison::kLessEqual: return left <= right;
    case Comparison::kLess: return left < right;
    case Comparison::kGreaterEqual: return left >= right;
    case Comparison::kGreater: return left > right;
    case Comparison::kEqual: return left == right;
    case Comparison::kNotEqual:
        return left < right || left > right;  // false for NaN, as all the others
    }
    return false;
}

std::string_view to_string(Comparison comparison)
{
    for (const auto& [symbol, value] : kComparisons)
        if (value == comparison)
            return symbol;
    return "";
}

}  // namespace farlight::client
