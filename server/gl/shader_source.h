// Shader text: the files of shaders/, embedded in the binary at build time, with `#include "path"`
// resolved.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace farlight {

/// Macros put right after #version, in order: name and value ("" for a plain define).
using Defines = std::vector<std::pair<std::string, std::string>>;

/// One shader ready for the compiler. `files[n]` is the path that `#line` source string n stands
/// for.
struct ShaderSource {
    std::string name;
    std::string text;
    std::vector<std::string> files;
};

/// The embedded files, path relative to shaders/ -> text. Tests may add their own.
std::map<std::string, std::string, std::less<>>& shader_files();

/// Reads `path`, resolves each include once (every file is included at most once, as with #pragma
/// once), puts `defines` after #version. Throws ShaderError naming the file and line of an include
/// that does not exist.
ShaderSource load_shader_source(std::string_view path, const Defines& defines = {});

/// `log` with the driver's source-string numbers explained by `source.files`.
std::string explain_log(const ShaderSource& source, const std::string& log);

}  // namespace farlight
