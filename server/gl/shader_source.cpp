// Include resolution with #line bookkeeping, so that logs can be traced to files.
#include "server/gl/shader_source.h"

#include "server/gl/gl_error.h"

#include <algorithm>
#include <sstream>

namespace farlight {

/// Defined by the file that the build generates from shaders/.
const std::map<std::string, std::string, std::less<>>& embedded_shaders();

namespace {

std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t");
    return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

/// The path in `#include "path"`, or nothing.
std::string_view included_path(std::string_view line)
{
    const std::string_view text = trimmed(line);
    if (!text.starts_with("#include"))
        return {};
    const std::size_t open = text.find('"');
    const std::size_t close = text.find('"', open + 1);
    return close == std::string_view::npos ? std::string_view()
                                           : text.substr(open + 1, close - open - 1);
}

void append_file(
    ShaderSource& source, std::string_view path, const std::string& from, const Defines* defines)
{
    const auto file = shader_files().find(path);
    if (file == shader_files().end())
        throw ShaderError(from + ": shader file '" + std::string(path) + "' does not exist");
    const auto number = std::to_string(source.files.size());
    source.files.emplace_back(path);
    if (defines == nullptr)
        source.text += "#line 1 " + number + "\n";

    std::istringstream lines(file->second);
    int line_number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++line_number;
        const std::string_view include = included_path(line);
        if (!include.empty()) {
            if (std::find(source.files.begin(), source.files.end(), include) == source.files.end())
                append_file(source, include, std::string(path) + ":" + std::to_string(line_number),
                    nullptr);
            source.text += "#line " + std::to_string(line_number + 1) + " " + number + "\n";
        } else if (trimmed(line).starts_with("#pragma once")) {
            source.text += "\n";
        } else {
            source.text += line + "\n";
            if (defines != nullptr && trimmed(line).starts_with("#version")) {
                for (const auto& [name, value] : *defines)
                    source.text.append("#define ")
                        .append(name)
                        .append(" ")
                        .append(value)
                        .append("\n");
                source.text += "#line " + std::to_string(line_number + 1) + " " + number + "\n";
            }
        }
    }
}

}  // namespace

std::map<std::string, std::string, std::less<>>& shader_files()
{
    static std::map<std::string, std::string, std::less<>> files = embedded_shaders();
    return files;
}

ShaderSource load_shader_source(std::string_view path, const Defines& defines)
{
    ShaderSource source;
    source.name = path;
    append_file(source, path, "shader", &defines);
    return source;
}

std::string explain_log(const ShaderSource& source, const std::string& log)
{
    std::string text = source.name + ":\n" + log + "\nsource strings:";
    for (std::size_t i = 0; i < source.files.size(); ++i)
        text += " " + std::to_string(i) + "=" + source.files[i];
    return text;
}

}  // namespace farlight
