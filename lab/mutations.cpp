// See the header.
#include "lab/mutations.h"

#include <boost/process.hpp>
#include <chrono>
#include <sstream>
#include <thread>

namespace farlight::lab {
namespace {

namespace bp = boost::process;

constexpr std::chrono::minutes kPatience{2};

/// The one case of a sheet in JSON.
std::string what_it_measured(const nlohmann::json& sheet)
{
    const nlohmann::json& one = sheet.at("cases").at(0);
    if (one.contains("failure"))
        return one.at("failure");
    for (const nlohmann::json& m : one.at("measurements"))
        if (!m.at("holds").get<bool>())
            return m.at("what").get<std::string>() + ": " + m.at("measured").dump() + ", "
                + m.at("kind").get<std::string>() + " " + m.at("bound").dump();
    return "it holds all the same";
}

}  // namespace

std::vector<std::string> cases_kept_by(const Guard& guard)
{
    std::istringstream words{std::string(guard.keeps)};
    std::vector<std::string> ids;
    for (std::string id; words >> id;)
        ids.push_back(id);
    return ids;
}

Mutation run_without(const std::filesystem::path& program, const Guard& guard,
    std::string_view case_id, const std::string& device)
{
    Mutation mutation{std::string(guard.name), std::string(case_id), false, {}};
    bp::ipstream output;
    bp::child child(program.string(), "--case", mutation.case_id, "--without", mutation.guard,
        "--device", device, "--json", bp::std_out > output, bp::std_err > bp::null);
    std::string text;
    std::thread reader([&] { text.assign(std::istreambuf_iterator<char>(output), {}); });
    const bool done = child.wait_for(kPatience);
    if (!done)
        child.terminate();
    reader.join();
    if (!done) {
        mutation.how = "it was not done after two minutes";
        return mutation;
    }
    const nlohmann::json sheet = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (sheet.is_discarded()) {
        // No number was measured: a crash proves nothing about the case's bounds.
        mutation.how = "it ended with status " + std::to_string(child.exit_code());
        return mutation;
    }
    // What does not even compile without the guard was not measured without it.
    mutation.noticed = child.exit_code() == 1 && !sheet.at("cases").at(0).contains("failure");
    mutation.how = what_it_measured(sheet);
    return mutation;
}

}  // namespace farlight::lab
