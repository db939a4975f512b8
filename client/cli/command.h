// What the commands of `farlight` have in common.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace farlight::client {

/// Exit status of every command.
constexpr int kDone = 0;
constexpr int kFailed = 1;  ///< The measured thing failed.
constexpr int kWrongUse = 2;  ///< Wrong usage or input.

/// A subcommand and what it does once its options are read.
struct Command {
    CLI::App* app;
    std::function<int()> run;
};

Command add_info(CLI::App& farlight);
Command add_record(CLI::App& farlight);
Command add_script(CLI::App& farlight);
Command add_bench(CLI::App& farlight);
Command add_compare(CLI::App& farlight);
Command add_accuracy(CLI::App& farlight);
Command add_hard_cases(CLI::App& farlight);

/// A line for people, on stderr: stdout is for results.
void say(const std::string& line);
/// Results for programs, on stdout.
void print_json(const nlohmann::json& json);

/// `values` need not be sorted; `share` in [0, 1]. 0 of no values.
double quantile(std::vector<double> values, double share);

}  // namespace farlight::client
