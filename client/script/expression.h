// Expectations of a script: `relmse(svgf) <= 0.1 * relmse(none)`, `same_bytes_twice`.
//
//   expectation = sum (("<=" | "<" | ">=" | ">" | "==" | "!=") sum)?
//   sum         = product (("+" | "-") product)*
//   product     = factor (("*" | "/") factor)*
//   factor      = "-" factor | number | "(" sum ")" | name ("(" run ("," frame)? ")")?
#pragma once

#include "client/metrics/metric_table.h"

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

/// What a function is of, and so what may stand in its parentheses.
enum class Of : std::uint8_t {
    kRunOrAll,  ///< A run, or nothing: all runs together.
    kRun,
    kFrame,  ///< A run and perhaps a frame number, else its last frame.
    kFramesFrom,  ///< A run and perhaps a frame number: that frame, else 0, and all after it.
    kAllRuns,  ///< Nothing; the runs are taken for one picture with different seeds.
};
std::string_view to_string(Of of);

/// A function of the frames that were played.
struct Function {
    std::string_view name;
    Of of;
    bool predicate;  ///< True or false: stands alone, without comparison.
    bool needs_reference;
    std::string_view meaning;

    bool takes_frame() const { return of == Of::kFrame || of == Of::kFramesFrom; }
};

/// A metric's row among the functions; what it means is said once, in metric_table.h.
constexpr Function metric_function(std::string_view name, Of of, bool needs_reference)
{
    return {name, of, false, needs_reference, find_metric(name)->formula};
}

constexpr Function kFunctions[] = {
    {"nonfinite", Of::kRunOrAll, false, false,
        "NaN and infinite values in all frames, those counted on the server included"},
    {"frames", Of::kRun, false, false, "frames received"},
    {"history_resets", Of::kRun, false, false, "frames drawn without history, the first included"},
    {"samples", Of::kFrame, false, false, "accumulated samples a pixel, as the frame says"},
    {"mean", Of::kFrame, false, false, "mean of the linear values of all channels"},
    {"max", Of::kFrame, false, false, "largest linear value"},
    metric_function("relmse", Of::kFrame, true),
    metric_function("relmse999", Of::kFrame, true),
    metric_function("mse", Of::kFrame, true),
    metric_function("rmse", Of::kFrame, true),
    metric_function("psnr", Of::kFrame, true),
    metric_function("smape", Of::kFrame, true),
    metric_function("ssim", Of::kFrame, true),
    metric_function("flip", Of::kFrame, true),
    metric_function("hdr_flip", Of::kFrame, true),
    metric_function("fireflies", Of::kFrame, true),
    metric_function("flicker", Of::kFramesFrom, false),
    metric_function("difference", Of::kFramesFrom, false),
    metric_function("lag", Of::kFramesFrom, true),
    metric_function("ghost", Of::kRun, true),
    metric_function("bias", Of::kAllRuns, true),
    metric_function("variance", Of::kAllRuns, true),
    {"not_black", Of::kRunOrAll, true, false,
        "in the last frame more than 1 % of the pixels are above 0"},
    {"same_bytes_twice", Of::kRunOrAll, true, false,
        "played a second time, every frame has the same bytes"},
};

/// The named one, or nullptr.
const Function* find_function(std::string_view name);

struct Call {
    const Function* function = nullptr;
    std::string run;  ///< Empty: all runs.
    std::optional<int> frame;  ///< Absent: see Of.
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
