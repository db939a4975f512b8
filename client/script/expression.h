// Expectations of a script: `relmse(svgf) <= 0.1 * relmse(none)`, `same_bytes_twice`.
//
//   expectation = sum (("<=" | "<" | ">=" | ">" | "==" | "!=") sum)?
//   sum         = product (("+" | "-") product)*
//   product     = factor (("*" | "/") factor)*
//   factor      = "-" factor | number | "(" sum ")" | name ("(" run ("," frame)? ")")?
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace farlight::client {

/// Text that is no expectation; what() says what was found at which column.
struct ExpressionError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A function of the frames that were played.
struct Function {
    std::string_view name;
    bool needs_run;  ///< Else the run may be left out: all runs together.
    bool takes_frame;  ///< A frame number may follow the run; absent: the last frame.
    bool predicate;  ///< True or false: stands alone, without comparison.
    bool needs_reference;
    std::string_view meaning;
};

constexpr Function kFunctions[] = {
    {"nonfinite", false, false, false, false,
        "NaN and infinite values in all frames, those counted on the server included"},
    {"frames", true, false, false, false, "frames received"},
    {"history_resets", true, false, false, false,
        "frames drawn without history, the first included"},
    {"samples", true, true, false, false, "accumulated samples a pixel, as the frame says"},
    {"mean", true, true, false, false, "mean of the linear values of all channels"},
    {"max", true, true, false, false, "largest linear value"},
    {"relmse", true, true, false, true, "mean((x - r)^2 / (r^2 + 0.01)) against the reference r"},
    {"rmse", true, true, false, true, "sqrt(mean((x - r)^2)) against the reference r"},
    {"not_black", false, false, true, false,
        "in the last frame more than 1 % of the pixels are above 0"},
    {"same_bytes_twice", false, false, true, false,
        "played a second time, every frame has the same bytes"},
};

/// The named one, or nullptr.
const Function* find_function(std::string_view name);

struct Call {
    const Function* function = nullptr;
    std::string run;  ///< Empty: all runs.
    std::optional<int> frame;  ///< Absent: the last.
};

struct Expression {
    enum class Kind { kNumber, kCall, kNegate, kAdd, kSubtract, kMultiply, kDivide };
    Kind kind = Kind::kNumber;
    double number = 0;
    Call call;
    std::vector<Expression> operands;
};

enum class Comparison { kNone, kLessEqual, kLess, kGreaterEqual, kGreater, kEqual, kNotEqual };

struct Expectation {
    std::string text;
    Expression left;
    Comparison comparison = Comparison::kNone;  ///< kNone: `left` is a predicate.
    Expression right;
};

/// Throws ExpressionError: unknown function, wrong arguments, a predicate compared, a number alone
/// ...
Expectation parse_expectation(const std::string& text);

/// Every call in an expectation, left to right.
std::vector<Call> calls_in(const Expectation& expectation);

double evaluate(const Expression& expression, const std::function<double(const Call&)>& value_of);
bool holds(double left, Comparison comparison, double right);
std::string_view to_string(Comparison comparison);

}  // namespace farlight::client
